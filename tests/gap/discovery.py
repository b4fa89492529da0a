# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs `algest discover` as a program does, and reads what it leaves: the JSON, and the doubts from its report."""
import html
import json
import re
import subprocess
from pathlib import Path

from environment import ALGEST


def no_constant(name):
    raise AssertionError(f"{name} is no JSON")


def attempt(model, recording, directory, *options, timeout=900):
    """The run, whatever comes of it."""
    words = [ALGEST, "discover", model, recording, "-o", directory, "--json", *options]
    return subprocess.run([str(word) for word in words], stdin=subprocess.DEVNULL, text=True, capture_output=True, timeout=timeout)


def discover(model, recording, directory, *options):
    """A run that must end well: its JSON, with `doubts` beside it, a list of sentences."""
    done = attempt(model, recording, directory, *options)
    if done.returncode != 0:
        raise AssertionError(f"exit {done.returncode}\n{done.stdout}{done.stderr}")
    found = json.loads(done.stdout, parse_constant=no_constant)
    page = Path(found["report"]).read_text(encoding="utf-8")
    found["doubts"] = [html.unescape(d) for d in re.findall(r"<li>(.*?)</li>", section(page, "Doubts"), flags=re.DOTALL)]
    return found


def section(page, heading):
    found = re.search(rf"<h2>{heading}</h2>(.*?)</section>", page, flags=re.DOTALL)
    return found[1] if found else ""


def chosen(found):
    """Effects that the search put into the model, in order: also where the verdict withholds their names."""
    evidence = section(Path(found["report"]).read_text(encoding="utf-8"), "Evidence")
    rows = re.findall(r'<tr class="chosen">(.*?)</tr>', evidence, flags=re.DOTALL)
    return [re.sub(r"<[^>]+>", "", row.split("</td>")[1]).strip() for row in rows]


def names(found):
    return [effect["name"] for effect in found["effects"]]


def values(found):
    """Parameters of the named effects, by name."""
    return {p["name"]: p["value"] for effect in found["effects"] for p in effect["parameters"]}


def show(title, found):
    """What a reader of the test's log should know."""
    print(f"== {title}: {found['verdict']}")
    for effect in found["effects"]:
        numbers = ", ".join(f"{p['name']} = {p['value']:.4g} +- {p['sd']:.2g} {p['unit']}" for p in effect["parameters"])
        print(f"   {effect['name']} in {effect['equation']}: {effect['term']}: {numbers}")
    for alternative in found["alternatives"]:
        print("   the data allow:", ", ".join(alternative))
    for output in found["outputs"]:
        print("   {signal}: nrmse {nrmse_before:.3g} before, {nrmse_after:.3g} after, floor {noise_floor:.2g}".format(**output))
    for doubt in found["doubts"]:
        print("   doubt:", doubt)
