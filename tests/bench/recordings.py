#!/usr/bin/env python3
"""What recordings cost and how small they are. Prints tables for docs/performance.md.

    tests/bench/recordings.py [build/release/lockstep [TICKS [DIRECTORY]]]

TICKS of the long recording: 3600000, which are 10 hours at 100 Hz; its files need 3 GB in DIRECTORY.
"""
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
LOCKSTEP = str(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "build/release/lockstep").resolve())
TICKS = int(sys.argv[2]) if len(sys.argv) > 2 else 3_600_000
PLACE = sys.argv[3] if len(sys.argv) > 3 else None

SHIFT = """<root lockstep="1" main_tree_to_execute="Shift"><plugin name="motion"/><BehaviorTree ID="Shift"><Repeat><Sequence memory="true">
  <ParallelAbsolute barriers="0.25;0.5;1">
    <Advance step="0.01" noise="0.003"/><Advance step="0.02" noise="0.003"/>
  </ParallelAbsolute>
  <ParallelRelative delta="0.1">
    <Advance step="0.01" noise="0.003"/><Advance step="0.015" noise="0.003"/><Advance step="0.02" noise="0.003"/>
  </ParallelRelative>
</Sequence></Repeat></BehaviorTree></root>"""


def all_change(step):
    "A tree of 200 leaves that change in each of 5000 ticks; leaf i advances by step(i)."
    leaves = "".join(f'<Advance step="{step(i):.9g}"/>' for i in range(200))
    return f'<root lockstep="1"><plugin name="motion"/><BehaviorTree ID="All"><Parallel>{leaves}</Parallel></BehaviorTree></root>'


def threads(pid):
    "Peak memory in MB, the processor seconds of the first thread, and those of all others, so far."
    of = {True: 0, False: 0}
    for task in pathlib.Path(f"/proc/{pid}/task").iterdir():
        of[int(task.name) == pid] += int((task / "schedstat").read_text().split()[0])
    peak = re.search(r"VmHWM:\s+(\d+)", pathlib.Path(f"/proc/{pid}/status").read_text())
    return int(peak[1]) / 1000, of[True] / 1e9, of[False] / 1e9


def call(*arguments, until=None):
    """Runs lockstep to its end, or kills it when until() holds: seconds of the clock and of the processor, and the
    most that threads() has said."""
    began = time.monotonic()
    process = subprocess.Popen([LOCKSTEP, *map(str, arguments)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    seen = (0, 0, 0)
    while os.waitid(os.P_PID, process.pid, os.WEXITED | os.WNOHANG | os.WNOWAIT) is None:
        try:
            seen = tuple(map(max, seen, threads(process.pid)))
        except (OSError, IndexError, TypeError):
            pass
        if until and until():
            os.kill(process.pid, signal.SIGKILL)
        time.sleep(0.002)
    took = time.monotonic() - began
    _, status, use = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode not in (0, 124, -signal.SIGKILL):
        sys.exit(f"{' '.join(map(str, arguments))} exited with {process.returncode}")
    return took, use.ru_utime + use.ru_stime, *seen


def table(heads, rows):
    print("| " + " | ".join(heads) + " |\n|" + "---|" * len(heads))
    for row in rows:
        print("| " + " | ".join(cell if isinstance(cell, str) else f"{cell:.3g}" for cell in row) + " |")
    print(flush=True)


def megabytes(file):
    return file.stat().st_size / 1e6


def written(directory):
    tree = directory / "shift.xml"
    tree.write_text(SHIFT)
    rows = []
    for name in (None, "ten.jsonl", "ten.jsonl.zst", "ten.mcap"):
        record = ["--record", directory / name] if name else []
        _, processor, memory, first, others = call("run", tree, "--clock", "virtual", "--rate", 100, "--max-ticks", TICKS, *record)
        rows.append([f"`{name}`" if name else "none", megabytes(directory / name) if name else "", processor, first, others, memory])
    print(f"A recording of {TICKS} ticks of 10 nodes.\n")
    table(["file", "MB", "processor, s", "thread that ticks, s", "other threads, s", "peak memory, MB"], rows)


def sought(directory):
    middle = TICKS // 2
    near = ["--from", middle, "--to", middle + 10]
    commands = {
        "`replay --print --at`": ["replay", "{}", "--print", "--at", middle],
        "`log csv`, 11 ticks": ["log", "csv", "{}", *near],
        "`log events`, 11 ticks": ["log", "events", "{}", *near],
        "`log export --format mcap`, 11 ticks": ["log", "export", "{}", "--format", "mcap", "--out", directory / "a.mcap", *near],
        "`log export --format trace`, 11 ticks": ["log", "export", "{}", "--format", "trace", "--out", directory / "a.json", *near],
        "`log page`, 1,001 ticks": ["log", "page", "{}", "--out", directory / "a.html", "--from", middle, "--to", middle + 1000],
        "`log info`, all": ["log", "info", "{}"],
        "`log export --format trace`, all": ["log", "export", "{}", "--format", "trace", "--out", directory / "a.json"],
        "`log export --format mcap`, all": ["log", "export", "{}", "--format", "mcap", "--out", directory / "a.mcap"],
    }
    rows = []
    for name, command in commands.items():
        plain, packed = ([str(part).format(directory / file) for part in command] for file in ("ten.jsonl", "ten.jsonl.zst"))
        if name.endswith(", all"):
            a, b = call(*plain), call(*packed)
        else:
            a, b = (min(call(*words) for _ in range(5)) for words in (plain, packed))
        rows.append([name, a[0], b[0], max(a[2], b[2])])
    print(f"Tick {middle} of it.\n")
    table(["command", "JSON Lines, s", "zstd, s", "peak memory, MB"], rows)


def killed(directory):
    rows = []
    for name in ("cut.jsonl", "cut.jsonl.zst"):
        whole = directory / name.replace("cut", "ten")
        cut, size = directory / name, whole.stat().st_size
        call("run", directory / "shift.xml", "--clock", "virtual", "--rate", 100, "--max-ticks", TICKS, "--record", cut,
             until=lambda: cut.exists() and cut.stat().st_size > 0.8 * size)
        info = call("log", "info", cut)
        at = call("replay", cut, "--print", "--at", TICKS // 2)
        rows.append([f"`{name}`", megabytes(cut), info[0], at[0], max(info[2], at[2])])
    print("The same, ended by SIGKILL after four fifths.\n")
    table(["file", "MB", "`log info`, s", "`replay --print --at`, s", "peak memory, MB"], rows)


def smaller(directory):
    rows = []
    plain, packed = directory / "a.jsonl", directory / "a.jsonl.zst"
    few, many = directory / "few.xml", directory / "many.xml"
    few.write_text(all_change(lambda i: (0.0002, 0.00021, 0.00023)[i % 3]))
    many.write_text(all_change(lambda i: 0.0002 * (1 - i / 1000)))
    for name, tree in (
        ("trees/fetch_and_carry.xml", ROOT / "trees/fetch_and_carry.xml"),
        ("200 leaves that all change, at three speeds", few),
        ("200 leaves that all change, each at another speed", many),
    ):
        for file in (plain, packed):
            call("run", tree, "--clock", "virtual", "--record", file)
        rows.append([name, megabytes(plain), megabytes(packed), megabytes(plain) / megabytes(packed)])
    print("How much smaller.\n")
    table(["tree", "JSON Lines, MB", "zstd, MB", "times"], rows)


with tempfile.TemporaryDirectory(dir=PLACE) as temporary:
    place = pathlib.Path(temporary)
    for part in (written, sought, killed, smaller):
        part(place)
