# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes fresh cases with a hidden effect, runs `algest discover` on them and prints how it fared.

    python3 tests/gap/cases/score.py --cases BUILD/tests/gap/cases/gap_cases --algest BUILD/algest -o DIR [--kind terms|structural] [--family dc,pm] [--hidden TEXT]
                                     [--seeds 1:3] [--count 40] [--jobs 2] [--truth]

Columns: `expected` is the gap after the generator's own refit of the nominal model, over the floor; `before` and `after` are discover's.
`before` far above `expected`: its fit of the nominal model is caught in a false minimum. What `judged` may say: scoring.py.
A case that is in DIR already is not made again, so that two programs can be compared on the same cases. `--truth` checks the generator
instead: the model with the true values and the true terms, simulated by `algest simulate`, must reproduce the recording.
"""
import argparse
import json
import random
import subprocess
import sys
import time
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent))
import scoring

COLUMNS = "{:<9} {:<48} {:<9} {:<52} {:<10} {:>6} {:>8} {:>8} {:>7} {:>6}"


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--cases", required=True, help="the program gap_cases")
    parser.add_argument("--algest", required=True)
    parser.add_argument("-o", "--output", required=True, type=Path)
    parser.add_argument("--kind", choices=["terms", "structural"], default="terms")
    parser.add_argument("--family", default="", help="only these, with commas between")
    parser.add_argument("--hidden", default="", help="only what contains this text")
    parser.add_argument("--seeds", default="1:2", help="A:B, B left out")
    parser.add_argument("--count", type=int, help="that many of them, chosen at random, always the same")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--truth", action="store_true")
    parser.add_argument("--effects", type=Path, default=Path(__file__).resolve().parents[4] / "shared" / "cases" / "effects.json")
    return parser.parse_args()


def plan(options):
    """(family, hidden, seed) of every case asked for."""
    listed = subprocess.run([options.cases, "--" + options.kind], text=True, capture_output=True, check=True).stdout.split("\n")
    first, last = (int(s) for s in options.seeds.split(":"))
    families = options.family.split(",") if options.family else []
    chosen = [(*line.split(), seed) for line in listed if line for seed in range(first, last)]
    chosen = [c for c in chosen if (not families or c[0] in families) and options.hidden in c[1]]
    if options.count and options.count < len(chosen):
        chosen = sorted(random.Random(1).sample(chosen, options.count), key=chosen.index)
    return chosen


def make(options, family, hidden, seed):
    """The folder of a case; None where this seed gives none."""
    folder = options.output / f"{family}-{hidden}-{seed}"
    if not (folder / "answer.json").exists():
        done = subprocess.run([options.cases, family, hidden, str(seed), folder], text=True, capture_output=True)
        if done.returncode:
            return None, done.stderr.strip()
    return folder, ""


def expected(answer):
    """The gap that the generator's own refit of the nominal model leaves, as a multiple of the floor: what `before` should come near."""
    return max(answer["refitted_nominal_nrmse"][s] / floor for s, floor in answer["noise_floor_nrmse"].items())


def check_truth(options, folder):
    """The largest of simulated error over floor, and whether it is 1 within 1.3."""
    # Where the model's language cannot say what is hidden (a delay, a sensor), the recording has it taken out.
    recording = folder / ("truth.csv" if (folder / "truth.csv").exists() else "measured.csv")
    done = subprocess.run([options.algest, "simulate", folder / "truth.toml", recording, "--json"], text=True, capture_output=True)
    if done.returncode:
        return {"judged": "refused", "error": done.stderr.strip()[-300:]}
    answer = json.loads((folder / "answer.json").read_text())
    floor = answer["noise_floor_nrmse"]
    ratio = max(o["nrmse"] / floor[o["signal"]] for o in json.loads(done.stdout)["outputs"] if o["signal"] in floor)
    return {"judged": "same" if ratio < 1.3 else "differs", "after": ratio, "expected": expected(answer)}


def discover(options, folder, names):
    answer = json.loads((folder / "answer.json").read_text())
    start = time.monotonic()
    done = subprocess.run([options.algest, "discover", folder / "model.toml", folder / "measured.csv", "-o", folder / "found", "--json",
                           "--train", "{}:{}".format(*answer["train_s"]), "--test", "{}:{}".format(*answer["test_s"])],
                          text=True, capture_output=True)
    seconds = time.monotonic() - start
    (folder / "discover.json").write_text(done.stdout)
    if done.returncode:
        return {"judged": "refused", "error": done.stderr.strip()[-300:], "seconds": seconds, "expected": expected(answer), "truth": answer["verdict"],
                "allowed": answer["may_stay_ambiguous"]}
    found = json.loads(done.stdout)
    before, after = scoring.gap(found, answer)
    named = ", ".join(f"{e['name']} ({e['equation'].split(' of ')[-1]})" for e in found["effects"])
    others = [a for a in found["alternatives"] if a != [e["name"] for e in found["effects"]]]
    if found["verdict"] == "ambiguous":
        named += " or " + " or ".join("+".join(a) for a in others)
    return {"judged": scoring.judge(found, answer, names), "verdict": found["verdict"], "named": named, "expected": expected(answer), "before": before,
            "after": after, "error": scoring.parameter_error(found, answer, names), "seconds": seconds, "truth": answer["verdict"],
            "allowed": answer["may_stay_ambiguous"]}


def line(case, result):
    error = result.get("error")
    percent = f"{100 * error:.1f}%" if isinstance(error, float) else "" if not error else "!"
    numbers = [f"{result[key]:.2f}" if key in result else "" for key in ("expected", "before", "after", "seconds")]
    text = COLUMNS.format(f"{case[0]}-{case[2]}", case[1], result.get("verdict", ""), result.get("named", "")[:52], result["judged"], percent, *numbers)
    if result.get("allowed") and result["judged"] not in ("right", "same"):
        text += "  may be " + ",".join(result["allowed"])
    return text + (f"\n    {error}" if isinstance(error, str) else "")


def results(options, chosen):
    """(case, result) in order, each when it is there."""
    names = scoring.aliases(options.effects) if options.effects.exists() else {}

    def one(case):
        folder, why = make(options, *case)
        if folder is None:
            return case, {"judged": "no case", "error": why}
        return case, check_truth(options, folder) if options.truth else discover(options, folder, names)

    with ThreadPoolExecutor(options.jobs) as pool:
        yield from pool.map(one, chosen)


def main():
    options = arguments()
    print(COLUMNS.format("case", "hidden", "verdict", "named", "judged", "error", "expected", "before", "after", "s"))
    totals, strengths = Counter(), []
    for case, result in results(options, plan(options)):
        print(line(case, result), flush=True)
        totals[result["judged"]] += 1
        if result["judged"] == "right" and isinstance(result.get("error"), float):
            strengths.append(result["error"])
    judged = sum(totals.values()) - totals["no case"]
    print(f"\n{judged} cases: " + ", ".join(f"{count} {word}" for word, count in totals.most_common()))
    if strengths:
        print(f"strengths of {len(strengths)} effects rightly named: within 5 percent {sum(e <= 0.05 for e in strengths)}, "
              f"within 10 percent {sum(e <= 0.1 for e in strengths)}")


if __name__ == "__main__":
    main()
