#!/usr/bin/env python3
"""Keeps the history of the benchmarks and draws it. `./dev bench --history` runs this.

usage: history.py tree               checks the file, then prints the commit of the tree ("+": the tree differs from it)
       history.py add RESULTS TREE   adds the figures in RESULTS (of ./dev bench --json) under that commit, then draws
       history.py plot               draws
"""
import json
import math
import os
import platform
import re
import subprocess
import sys
from datetime import datetime, timezone
from html import escape
from pathlib import Path

sys.dont_write_bytecode = True
from table import bound_of, figure, measured

ROOT = Path(__file__).resolve().parents[2]
FILE = "tests/bench/history.json"
PLOT = "out/bench_history.html"
MARKED = 10  # [%] changes above this are marked
COLORS = ("#1f5fa8", "#c2410c", "#0f7b4f", "#9d2f7e", "#7a5c00", "#4b5563", "#0e7490", "#b91c1c")
DASHES = ("none", "7 3", "2 3", "8 3 2 3")  # once the colours are used up
LEFT, WIDTH, TOP, BOTTOM, ROW = 56, 300, 8, 74, 13  # of a panel [px]; ROW: height of a label
STYLE = """body{font:14px/1.4 sans-serif;margin:1.5em;color:#111;background:#fff}
.panels{display:flex;flex-wrap:wrap;gap:1em 2em}figure{margin:0}figcaption{font-weight:bold}figcaption span{font-weight:normal}
svg text{font:11px sans-serif}.grid{stroke:#ddd}.axis{fill:#444}
.line path{fill:none;stroke-width:1.5}.line .leader{stroke-width:.6;stroke-dasharray:1 2}
.line:hover path{stroke-width:3}.line:hover text{font-weight:bold}table{border-collapse:collapse;margin:1em 0}
td,th{padding:1px 10px;border-bottom:1px solid #ddd;text-align:right}td:first-child,th:first-child{text-align:left}
.slower{background:#fde0d9;font-weight:bold}.faster{background:#d9f0e1;font-weight:bold}"""


def stop(message):
    sys.exit(f"error: {message}")


# ---- the file ------------------------------------------------------------------------------------------------------

def check_entry(entry, text, begin, end):
    """Stops when the entry, which is there in the text, lacks something or has a time that is none."""
    def broken(word, message):
        at = text.find(json.dumps(word) + ":", begin, end)  # where the word is missing, the line where the entry begins
        stop(f"{FILE}:{text.count(chr(10), 0, max(begin, at)) + 1}: {message}")

    if not isinstance(entry, dict) or not isinstance(entry.get("us"), dict):
        broken("us", 'an entry is an object with the times under "us"')
    for key in ("commit", "compiler", "date", "machine"):
        if not isinstance(entry.get(key), str):
            broken(key, f'this entry has no text "{key}"')
    for name, time in entry["us"].items():
        if type(time) not in (int, float) or not 0 <= time < math.inf:
            broken(name, f'the time of "{name}" is not a number from 0 on: {json.dumps(time)}')


def load():
    """The entries, oldest first. Stops with the line of whatever is wrong with the file."""
    data = (ROOT / FILE).read_bytes()
    try:
        text = data.decode()
        entries = json.loads(text)
    except UnicodeDecodeError as error:
        stop(f"{FILE}:{data.count(10, 0, error.start) + 1}: this is not UTF-8")
    except json.JSONDecodeError as error:
        stop(f"{FILE}:{error.lineno}: this is not JSON: {error.msg}")
    if not isinstance(entries, list):
        stop(f"{FILE}:1: the file is to be a list of entries")
    at = text.index("[") + 1
    for entry in entries:
        begin = re.compile(r"[\s,]*").match(text, at).end()
        at = json.JSONDecoder().raw_decode(text, begin)[1]
        check_entry(entry, text, begin, at)
    return entries


def rounded(value):
    """To three digits, so that the file and its differences stay short."""
    value = float(f"{value:.3g}")
    return int(value) if value.is_integer() else value


def tree():
    """The commit of the tree, with "+" when the tree differs from it in more than the history."""
    def git(*words):
        ran = subprocess.run(["git", *words], cwd=ROOT, capture_output=True, text=True)
        return ran.stdout.strip() if ran.returncode == 0 else stop(f"git {words[0]}: {ran.stderr.strip()}")

    return git("rev-parse", "--short", "HEAD") + ("+" if git("status", "--porcelain", "--", ".", f":!{FILE}") else "")


def machine():
    """Model and number of the processor's cores."""
    model, cores, socket = platform.machine(), set(), ""
    for line in Path("/proc/cpuinfo").read_text().splitlines():
        key, _, value = (word.strip() for word in line.partition(":"))
        model = value if key == "model name" else model
        socket = value if key == "physical id" else socket
        if key == "core id":
            cores.add((socket, value))
    return f"{model}, {len(cores) or os.cpu_count()} cores"


def compiler():
    """What the compiler of the build says of its version."""
    found = re.search(r"^CMAKE_CXX_COMPILER:\w+=(.+)$", (ROOT / "build/CMakeCache.txt").read_text(), re.M)
    return subprocess.run([found[1], "--version"], check=True, capture_output=True, text=True).stdout.splitlines()[0]


def add(results, commit):
    """Appends one entry with the figures in this file."""
    entries = load() if (ROOT / FILE).exists() else []
    times = {name: figure(benchmark) for name, benchmark in measured(results).items()}
    if not times:
        stop(f"no benchmark in {results} reports a median")
    entries.append({"commit": commit, "compiler": compiler(), "machine": machine(),
                    "date": datetime.now(timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ"),
                    "us": {name: rounded(time) for name, time in times.items() if math.isfinite(time)}})
    fresh = ROOT / (FILE + ".new")  # an interrupted run leaves the old file whole
    fresh.write_text(json.dumps(entries, indent=1, sort_keys=True) + "\n")
    fresh.replace(ROOT / FILE)
    print(f"{FILE}: entry {len(entries)}, {commit}, {len(times)} benchmarks")


# ---- the plot ------------------------------------------------------------------------------------------------------

def written(value):
    return f"{rounded(value):.12g}"


def by_number(name):
    """Sorts sphere_20480 before sphere_1310720."""
    return [(int(part), "") if part.isdigit() else (-1, part) for part in re.split(r"(\d+)", name)]


def ticks(low, high):
    """Round numbers within a logarithmic axis."""
    steps = (1, 2, 5) if high / low < 1000 else (1,)
    decades = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    return [step * 10.0**decade for decade in decades for step in steps if low <= step * 10.0**decade <= high]


def apart(heights, top, bottom):
    """Moves labels at these increasing heights so that they do not overlap, within top and bottom."""
    placed = []
    for height in heights:
        placed.append(max(height, placed[-1] + ROW if placed else top))
    for i in reversed(range(len(placed))):
        placed[i] = min(placed[i], placed[i + 1] - ROW if i + 1 < len(placed) else bottom)
    return placed


def panel(family, lines, labels, unit):
    """One plot of a family: a line for each benchmark, over the entries; a missing time leaves a gap."""
    drawn = {name: [(i, v) for i, v in enumerate(values) if v] for name, values in lines.items()}
    drawn = {name: points for name, points in drawn.items() if points}  # 0 has no place on a logarithmic axis
    if not drawn:
        return ""
    every = [v for points in drawn.values() for _, v in points]
    middle = math.sqrt(min(every) * max(every))  # at least a factor of three, so that noise looks like noise
    low, high = min(min(every) / 1.1, middle / math.sqrt(3)), max(max(every) * 1.1, middle * math.sqrt(3))
    height = max(150, ROW * (len(drawn) + 1))

    def x(i):
        return LEFT + 8 + (WIDTH - 16) * i / max(1, len(labels) - 1)

    def y(value):
        return TOP + height * math.log(high / value) / math.log(high / low)

    svg = [f'<line class="grid" x1="{LEFT}" x2="{LEFT + WIDTH}" y1="{y(t):.1f}" y2="{y(t):.1f}"/><text class="axis" '
           f'x="{LEFT - 5}" y="{y(t) + 4:.1f}" text-anchor="end">{written(t)}</text>' for t in ticks(low, high)]
    every_nth = math.ceil(len(labels) / 16)  # always the last
    svg += [f'<text class="axis" text-anchor="end" transform="translate({x(i) + 4:.1f} {TOP + height + 14}) rotate(-50)">'
            f'{escape(label[0])}<title>{escape(label[1])}</title></text>'
            for i, label in enumerate(labels) if (len(labels) - 1 - i) % every_nth == 0]
    order = sorted(drawn, key=lambda name: y(drawn[name][-1][1]))
    places = dict(zip(order, apart([y(drawn[name][-1][1]) for name in order], TOP + 6, TOP + height - 4)))
    right = 0
    for i, (name, points) in enumerate(drawn.items()):
        color, dash = COLORS[i % len(COLORS)], DASHES[i // len(COLORS) % len(DASHES)]
        path = "".join(f"{'L' if k and points[k - 1][0] == e - 1 else 'M'}{x(e):.1f} {y(v):.1f}" for k, (e, v) in enumerate(points))
        last, values = points[-1], [v for _, v in points]
        text = f"{name.partition('/')[2] or name} {written(last[1])}" + ("" if last[0] == len(labels) - 1 else " (gone)")
        right = max(right, 6.8 * len(text))
        reach = f"{name}: min {written(min(values))}, max {written(max(values))}, last {written(last[1])} {unit}"
        svg.append(f'<g class="line" stroke="{color}"><path d="{path}" stroke-dasharray="{dash}"><title>{escape(reach)}</title></path>'
                   f'<path class="leader" d="M{x(last[0]):.1f} {y(last[1]):.1f}L{LEFT + WIDTH + 14} {places[name]:.1f}"/>')
        svg += [f'<circle cx="{x(e):.1f}" cy="{y(v):.1f}" r="2.5" fill="{color}"><title>{escape(name)}: {written(v)} {unit}\n'
                f'{escape(labels[e][1])}</title></circle>' for e, v in points]
        svg.append(f'<text x="{LEFT + WIDTH + 17}" y="{places[name] + 4:.1f}" fill="{color}" stroke="none">{escape(text)}'
                   f'<title>{escape(reach)}</title></text></g>')
    ends = sorted((written(points[-1][1]) for points in drawn.values()), key=float)
    reach = " to ".join(dict.fromkeys((ends[0], ends[-1])))
    return (f'<figure><figcaption>{escape(family)} <span>[{unit}], last: {reach}</span></figcaption>'
            f'<svg width="{LEFT + WIDTH + 20 + right:.0f}" height="{TOP + height + BOTTOM}" role="img">{"".join(svg)}</svg></figure>')


def change(old, new):
    """A table cell: the change in %, marked when it is large."""
    if not old or new is None:
        return "<td>–</td>"
    percent = 100 * (new / old - 1)
    kind, sign = ("slower", " ▲") if percent > MARKED else ("faster", " ▼") if percent < -MARKED else ("", "")
    return f'<td class="{kind}">{percent:+.1f} %{sign}</td>'


def table(lines):
    """First, previous and last value of each benchmark, and how much it changed."""
    rows = []
    for name, values in lines.items():
        before = [v for v in values[:-1] if v is not None]
        cells = [before[0] if before else None, before[-1] if before else None, values[-1]]
        words = [word if v is None else written(v) for v, word in zip(cells, ("new", "–", "gone"))]
        rows.append(f"<tr><td>{escape(name)}</td>{''.join(f'<td>{word}</td>' for word in words)}"
                    f"{change(cells[1], cells[2])}{change(cells[0], cells[2])}</tr>")
    return ("<table><tr><th>benchmark</th><th>first</th><th>previous</th><th>last</th><th>since previous</th>"
            f"<th>since first</th></tr>{''.join(rows)}</table>")


def section(heading, labels, values, unit):
    """Panels and table of entries; values: for each entry a number by benchmark."""
    names = sorted({name for found in values for name in found}, key=by_number)
    lines = {name: [found.get(name) for found in values] for name in names}
    families = {}
    for name in names:
        families.setdefault(name.partition("/")[0], {})[name] = lines[name]
    panels = "".join(panel(family, own, labels, unit) for family, own in families.items())
    return f'<h2>{escape(heading)}</h2>\n<div class="panels">{panels}</div>\n{table(lines)}\n'


def ratios(times):
    """Each benchmark that has a lower bound, as a multiple of it."""
    return {name: time / bound for name, time in times.items() if (bound := bound_of(name, times))}


def plot():
    """Draws the whole history: the times of each machine, then the ratios of all."""
    if not (ROOT / FILE).exists():
        stop(f"there is no {FILE} yet: ./dev bench --history makes it")
    entries = load()
    if not entries:
        stop(f"{FILE}:1: there is no entry yet")
    machines = list(dict.fromkeys(entry["machine"] for entry in entries))
    number = {name: i + 1 for i, name in enumerate(machines)}
    hover = [f'{e["commit"]}, {e["date"]}, {e["machine"]}, {e["compiler"]}' for e in entries]
    page = ["<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>Presa: history of the benchmarks</title>"
            f"<style>{STYLE}</style></head><body>\n<h1>History of the benchmarks</h1>\n"
            "<p>Processor times and their ratios to the lower bounds, from the oldest entry to the newest; lower is better. A commit "
            f"with + had further changes. Changes above {MARKED} % are marked: ▲ slower, ▼ faster.</p>\n"]
    for name in machines:
        own = [i for i, entry in enumerate(entries) if entry["machine"] == name]
        page.append(section(f"Times on machine {number[name]}: {name}",
                            [(entries[i]["commit"], hover[i]) for i in own], [entries[i]["us"] for i in own], "us"))
    labels = [(e["commit"] + (f" · {number[e['machine']]}" if len(machines) > 1 else ""), h) for e, h in zip(entries, hover)]
    page.append(section("Ratios to the lower bound, all machines", labels, [ratios(e["us"]) for e in entries], "times the bound"))
    (ROOT / PLOT).parent.mkdir(exist_ok=True)
    (ROOT / PLOT).write_text("".join(page) + "</body></html>\n", encoding="utf-8")
    print(f"{PLOT}: {len(entries)} entries")


if __name__ == "__main__":
    if sys.argv[1:] == ["tree"]:
        if (ROOT / FILE).exists():
            load()
        print(tree())
    elif sys.argv[1:2] == ["add"] and len(sys.argv) == 4:
        add(*sys.argv[2:])
        plot()
    elif sys.argv[1:] == ["plot"]:
        plot()
    else:
        sys.exit(__doc__.strip())
