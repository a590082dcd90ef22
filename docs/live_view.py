#!/usr/bin/env python3
"""The picture of README.md: the live view of trees/door_pulling.xml, played once more.

    python3 docs/live_view.py LOCKSTEP [--check]

Runs the tree on the virtual clock and draws what `lockstep replay` prints of every 20th tick, as an animated SVG:
docs/live_view.svg. With --check it writes nothing, and fails if the file differs.
"""
import html
import pathlib
import re
import subprocess
import sys
import tempfile

LOCKSTEP = sys.argv[1]
DOCS = pathlib.Path(__file__).parent
PICTURE = DOCS / "live_view.svg"
TICKS = [*range(160, 700, 20), 700, 700, 700, 700, 700]  # stays at the end for a second
STILL = 380  # shown by a program that plays no animation
SECONDS = 8.0
LINE, CHARACTER, MARGIN = 22, 8.4, 16
COLORS = {"▶": "#58a6ff", "✓": "#3fb950", "‖": "#d29922", "✗": "#f85149", "·": "#6e7681"}


def lockstep(*arguments):
    return subprocess.run([LOCKSTEP, *arguments], check=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True).stdout


def text(column, row, content, color="#e6edf3"):
    x, y = MARGIN + column * CHARACTER, MARGIN + (row + 0.7) * LINE
    return f'<text x="{x:g}" y="{y:g}" fill="{color}">{html.escape(content)}</text>'


def box(column, row, width, height, color):
    x, y = MARGIN + column * CHARACTER, MARGIN + row * LINE + (LINE - height) / 2
    return f'<rect x="{x:g}" y="{y:g}" width="{width * CHARACTER:g}" height="{height}" fill="{color}"/>'


def bar(column, row, cells, color):
    """The characters of a bar as rectangles, since few fonts have them in one width."""
    track = box(column, row, len(cells), 12, "#30363d")
    full = box(column, row, 1 + max((at for at, cell in enumerate(cells) if cell == "█"), default=-1), 12, color)
    return track + full + "".join(box(column + at, row, 0.3, 18, "#e6edf3") for at, cell in enumerate(cells) if cell == "┃")


def draw(row, line):
    if row == 0:
        return text(0, row, line, "#8b949e")
    at = len(line) - len(line.lstrip())
    sign, rest = line[at], line[at + 2:]
    color = COLORS[sign]
    drawn = text(at, row, sign, color)
    parts = re.fullmatch(r"([^\[]*)\[([^\]]*)\] (\S+) *(.*)", rest)
    if not parts:
        return drawn + text(at + 2, row, rest)
    begin = at + 2 + len(parts[1])
    end = begin + len(parts[2]) + 1
    return (drawn + text(at + 2, row, parts[1]) + bar(begin, row, parts[2], color) + text(end, row, parts[3]) +
            (text(end + 6, row, parts[4], color) if parts[4] else ""))


def picture():
    with tempfile.TemporaryDirectory() as directory:
        recording = directory + "/run.jsonl"
        lockstep("run", str(DOCS.parent / "trees/door_pulling.xml"), "--clock", "virtual", "--view", "none", "--record", recording)
        frames = [lockstep("replay", recording, "--at", str(tick), "--print").splitlines() for tick in TICKS]
    columns = max(len(line) for lines in frames for line in lines)
    width, height = round(2 * MARGIN + (columns + 2) * CHARACTER), 2 * MARGIN + LINE * len(frames[0])
    share = 100 / len(frames)
    out = f'''<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" height="{height}" role="img">
<title>The live view: an arm pulls a door open, and the base waits for it at three barriers</title>
<style>
text {{ font: 14px ui-monospace, "DejaVu Sans Mono", Menlo, Consolas, monospace; white-space: pre; }}
.frame {{ visibility: hidden; animation: show {SECONDS:g}s step-end infinite; }}
.still {{ visibility: visible; }}
@keyframes show {{ 0% {{ visibility: visible; }} {share:.4f}%, 100% {{ visibility: hidden; }} }}
@media (prefers-reduced-motion: reduce) {{ .frame {{ animation: none; }} }}
</style>
<rect width="{width}" height="{height}" rx="8" fill="#0d1117"/>
'''
    for number, (tick, lines) in enumerate(zip(TICKS, frames)):
        begins = (number / len(frames) - 1) * SECONDS
        kind = "frame still" if tick == STILL else "frame"
        out += f'<g class="{kind}" style="animation-delay: {begins:.3f}s">'
        out += "".join(draw(row, line) for row, line in enumerate(lines)) + "</g>\n"
    return out + "</svg>\n"


made = picture()
if "--check" not in sys.argv:
    PICTURE.write_text(made, encoding="utf-8")
elif made != PICTURE.read_text(encoding="utf-8"):
    sys.exit(f"{PICTURE} is not what a run shows: python3 docs/live_view.py LOCKSTEP writes it")
