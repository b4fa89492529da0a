# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures opened in a browser: nothing overlaps or is cut, every axis has its unit. For pages with figures, and for single SVG files."""
import html
import itertools
import json
import re
import shutil
import subprocess
import tempfile
from pathlib import Path

from environment import skip

BROWSER = shutil.which("chromium")
if BROWSER is None:
    skip("no chromium")
if shutil.which("gnuplot") is None:
    skip("no gnuplot")

NUMBER = re.compile(r"-?\d+(\.\d+)?")
UNIT = re.compile(r".+ \[[^\]]+\]")
MEASURE = """<script>
const figures = [...document.querySelectorAll('figure')].map(figure => {
  const svg = figure.querySelector('svg');
  if (!svg) return {panels: Number(figure.dataset.panels), box: null, texts: []};
  const box = element => { const r = element.getBoundingClientRect(); return [r.left, r.top, r.right, r.bottom]; };
  return {panels: Number(figure.dataset.panels), box: box(svg),
          texts: [...svg.querySelectorAll('text')].map(t => ({text: t.textContent.trim(), box: box(t), upright: t.getCTM().b !== 0}))
                 .filter(t => t.text !== '')};   // numbers that an axis does not show
});
const page = document.documentElement;
const out = document.createElement('pre');
out.id = 'measured';
const cut = [...document.querySelectorAll('#command pre')].some(e => e.scrollWidth > e.clientWidth);
out.textContent = JSON.stringify({figures, cut, width: page.scrollWidth, shown: page.clientWidth, height: page.scrollHeight});
document.body.append(out);
</script>"""


def browse(page, width, height, *options):
    """Chromium on a page; its standard output. Its profile is thrown away; as root it has no sandbox."""
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as profile:
        command = [BROWSER, "--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage", "--hide-scrollbars", "--no-first-run",
                   f"--user-data-dir={profile}", f"--window-size={width},{height}", *options, page.as_uri()]
        return subprocess.run(command, text=True, capture_output=True, timeout=300, check=True).stdout


def measured(page, width=1100):
    """Boxes of all texts of all figures, in px, as the browser lays them out; the size of the page."""
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder) / "page.html"
        copy.write_text(page.read_text(encoding="utf-8").replace("</body>", MEASURE + "</body>"), encoding="utf-8")
        dom = browse(copy, width, 1000, "--dump-dom")
    return json.loads(html.unescape(re.search(r'<pre id="measured">(.*?)</pre>', dom, flags=re.DOTALL)[1]))


def overlap(a, b, slack=0.5):
    return min(a[2], b[2]) - max(a[0], b[0]) > slack and min(a[3], b[3]) - max(a[1], b[1]) > slack


def faults(page, plain, width=1100):
    """What is wrong with the figures of a page, a sentence each. `plain`: texts that are neither a number nor the label of an axis."""
    found = []
    sizes = measured(page, width)
    if sizes["width"] > sizes["shown"]:
        found.append(f"the page is {sizes['width']} px wide where {sizes['shown']} are shown")
    if sizes["cut"]:
        found.append("the command is cut")
    for number, figure in enumerate(sizes["figures"], 1):
        texts = figure["texts"]
        for one, other in itertools.combinations(texts, 2):
            if overlap(one["box"], other["box"]):
                found.append(f"figure {number}: '{one['text']}' lies over '{other['text']}'")
        edge = figure["box"]
        for text in texts:
            left, top, right, bottom = text["box"]
            if left < edge[0] or top < edge[1] or right > edge[2] or bottom > edge[3]:
                found.append(f"figure {number}: '{text['text']}' is cut")
        labels = [t for t in texts if not NUMBER.fullmatch(t["text"]) and t["text"] not in plain]
        found += [f"figure {number}: '{t['text']}' has no unit" for t in labels if not UNIT.fullmatch(t["text"])]
        if sum(t["upright"] for t in labels) != figure["panels"]:
            found.append(f"figure {number}: {figure['panels']} panels, and other labels: {[t['text'] for t in labels]}")
        if not any(not t["upright"] for t in labels):
            found.append(f"figure {number}: no label across")
    return found


def page_of(pictures, page):
    """A page of SVG files, {file: its number of panels}, for faults()."""
    def drawing(file):
        text = file.read_text(encoding="utf-8")
        return text[text.index("<svg"):]
    figures = "\n".join(f'<figure data-panels="{panels}">{drawing(file)}</figure>' for file, panels in pictures.items())
    page.write_text(f'<!DOCTYPE html><html><head><meta charset="utf-8"></head><body>{figures}</body></html>\n', encoding="utf-8")
    return page


def screenshot(page, picture, width=1100, *options):
    """A picture of the whole page, for a person to look at; says where it is."""
    browse(page, width, measured(page, width)["height"], f"--screenshot={picture}", *options)
    if picture.stat().st_size <= 10000:
        raise AssertionError(f"{picture} is all but empty")
    print("picture:", picture)
