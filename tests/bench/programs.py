#!/usr/bin/env python3
"""What leaves that are programs cost. Prints a table for docs/performance.md.

    LOCKSTEP=build/release/lockstep PYTHONPATH=python python3 tests/bench/programs.py
"""
import pathlib
import tempfile
import time

import lockstep

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAMS = ROOT / "tests" / "programs"
SECONDS, RATE = 10, 100


def tree(plugin, count, leaf='<Advance step="1e-6"/>'):
    return (f'<root lockstep="1"><plugin {plugin}/><BehaviorTree ID="Main"><Parallel>'
            + leaf * count + "</Parallel></BehaviorTree></root>")


def lateness(name, plugin, count):
    with tempfile.TemporaryDirectory() as directory:
        file = pathlib.Path(directory) / "tree.xml"
        file.write_text(tree(plugin, count))
        run = lockstep.run(file, clock="wall", rate=RATE, max_ticks=SECONDS * RATE, plugin_path=[PROGRAMS])
        period, worst = run.period, run.worst_tick
        print(f"| {name} | {1e3 * (period['p99_s'] - 1 / RATE):.2f} | {run.skipped} | "
              f"{1e3 * worst['took_s']:.2f} |")


def of_a_run(program, ticks=20000):
    with tempfile.TemporaryDirectory() as directory:
        file = pathlib.Path(directory) / "tree.xml"
        file.write_text(tree(f'name="motion" program="{program}"', 1))
        began = time.monotonic()
        lockstep.run(file, max_ticks=1, plugin_path=[PROGRAMS])
        begun = time.monotonic()
        lockstep.run(file, max_ticks=ticks, plugin_path=[PROGRAMS])
        took = time.monotonic() - begun - (begun - began)
        print(f"| {program} | {1e6 * took / ticks:.1f} |")


print("| a tick on the virtual clock, from request to answer | us |\n|---|---|")
for name in ("advance.py", "advance_class.py", "advance.js"):
    of_a_run(name)
print(f"\n| {RATE} Hz, {SECONDS} s | p99 of the lateness, ms | skipped | longest tick, ms |\n|---|---|---|---|")
lateness("1 leaf in C++", 'name="motion"', 1)
lateness("100 leaves in C++", 'name="motion"', 100)
lateness("100 leaves in Python, one process", 'name="motion" program="advance_class.py"', 100)
lateness("100 leaves in Python, 100 processes", 'name="motion" program="advance_class.py" hold="signal"', 100)
