#!/usr/bin/env python3
"""Compares what two builds of lockstep say and write: for a change that must not be noticed.

    tests/corpus/compare.py BEFORE AFTER

BEFORE and AFTER are programs, such as build/release/lockstep of two checkouts. Both get the trees of this checkout:
those that load are run on the virtual clock, and the recordings, the output and the messages are compared byte for
byte; of those that are refused, the messages. A study of two trees is compared too. Prints each command whose results
differ. The exit code is 0 if none does, else 1.
"""

import os
import pathlib
import re
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parents[2]
RUN = ["run", "--clock", "virtual", "--max-ticks", "300", "--view", "plain", "--record"]
STUDY = ["study", "--runs", "20", "--no-plots", "--max-ticks", "300", "--out"]

TIMED = "trees/commands.xml"  # its leaves are commands, whose output comes when it comes


def trees():
    for folder in ("trees", "tests/trees"):
        yield from sorted(it for it in (SOURCE / folder).rglob("*.xml") if not it.name.endswith((".test.xml", ".leaves.xml")))


def commands():
    for tree in trees():
        name = str(tree.relative_to(SOURCE))
        yield ["check", name]
        yield ["show", name]
        if name != TIMED:
            yield [*RUN, "{out}/run.jsonl", name]
    for name in ("trees/two_robots.xml", "trees/predictability.xml"):
        yield [*STUDY, "{out}/study", name]
    yield ["nodes"]
    yield ["schema"]
    for command in ("", "run", "check", "show", "nodes", "schema", "convert", "plugin", "log", "replay", "study"):
        yield [command, "--help"] if command else ["--help"]


def results(program, command):
    """The exit code, stdout, stderr and every file that was written, without what says where and when."""
    with tempfile.TemporaryDirectory() as out:
        done = subprocess.run(
            [program, *(part.replace("{out}", out) for part in command)],
            cwd=SOURCE,
            capture_output=True,
            timeout=120,
            env={**os.environ, "NO_COLOR": "1", "COLUMNS": "100"},
        )
        texts = {"stdout": done.stdout, "stderr": done.stderr}
        for path in sorted(pathlib.Path(out).rglob("*")):
            if path.is_file():
                texts[str(path.relative_to(out))] = path.read_bytes()
        own = [out.encode(), str(pathlib.Path(program).resolve().parent).encode()]
        return {"code": done.returncode, **{name: neutral(text, own) for name, text in texts.items()}}


def neutral(text, own):
    for path in own:
        text = text.replace(path, b"PATH")
    # The wall clock: when it was recorded, and how long a tick took.
    return re.sub(rb'"(recorded_at|date|started|late_ms|tick_us|us|took)":("[^"]*"|[-0-9.e]+)', rb'"\\1":0', text)


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    before, after = (os.path.abspath(program) for program in sys.argv[1:])
    count = different = 0
    for command in commands():
        count += 1
        try:
            one, other = results(before, command), results(after, command)
        except subprocess.TimeoutExpired as late:
            one, other = {}, {"time": str(late)}
        unlike = [name for name in {**one, **other} if one.get(name) != other.get(name)]
        if unlike:
            different += 1
            print(f"{' '.join(command)}: {', '.join(unlike)}")
        if sys.stderr.isatty():
            print(f"\r{count} commands, {different} differ", end="", file=sys.stderr)
    print(f"{count} commands, {different} differ")
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())
