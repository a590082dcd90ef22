#!/usr/bin/env python3
"""What leaves that are programs cost. Prints tables for docs/performance.md.

    LOCKSTEP=build/release/lockstep PYTHONPATH=python python3 tests/bench/programs.py [ROUNDS]

What is compared takes turns, in one run, and each number is the median of all rounds, with the least and the greatest.
"""
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

import lockstep

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAMS = ROOT / "tests" / "programs"
ROUNDS = int(sys.argv[1]) if len(sys.argv) > 1 else 7
SECONDS, RATE, TICKS = 3, 100, 10000
sys.path.insert(0, str(PROGRAMS))
import advance_class  # noqa: E402: the same leaf in this process

PYTHON = 'name="motion" program="advance_class.py"'


def text(plugin, nodes):
    return f'<root lockstep="1"><plugin {plugin}/><BehaviorTree ID="Main">{nodes}</BehaviorTree></root>'


def spread(values, digits=1):
    return f"{statistics.median(values):.{digits}f} ({min(values):.{digits}f} to {max(values):.{digits}f})"


def in_turns(measures):
    "The results of each measure, which take turns: {name: [result, …]}."
    results = {name: [] for name in measures}
    for _ in range(ROUNDS):
        for name, measure in measures.items():
            results[name].append(measure())
    return results


# ---- a tick on the virtual clock: from the request to the answer, and all else that a tick is


def of_a_tick(plugin, **project):
    with lockstep.Tree(text=text(plugin, '<Advance step="1e-6"/>'), plugin_path=PROGRAMS, **project) as tree:
        tree.run(max_ticks=100)
        began = time.perf_counter()
        tree.run(max_ticks=TICKS)
        return 1e6 * (time.perf_counter() - began) / TICKS


# ---- Exec, spoken to by hand


def speak(program, lines):
    program.stdin.write("".join(json.dumps(it) + "\n" for it in lines))
    program.stdin.flush()
    return json.loads(program.stdout.readline())


def of_exec(command, ticks):
    "Microseconds from start to the end of the command, or of one tick while it runs."
    path = pathlib.Path(lockstep.program()).parent / "plugins" / "exec.py"
    with subprocess.Popen([path], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
                          env=os.environ | {"PYTHONPATH": str(ROOT / "python")}) as program:
        program.stdout.readline()
        speak(program, [{"do": "create", "leaf": 1, "type": "Exec", "name": "e", "path": "e", "period": 0.01,
                         "clock": "wall", "seed": 1}])
        ports = {"command": command, "progress_from": "percent", "shell": False, "a": "", "b": "", "c": "", "d": ""}
        began = time.perf_counter()
        answer = speak(program, [{"do": "start", "leaf": 1, "now": 0, "ports": ports}, {"do": "tick", "leaf": 1}])
        if ticks:
            began = time.perf_counter()
        count = 0
        while answer["status"] == "running" and (not ticks or count < ticks):
            answer = speak(program, [{"do": "tick", "leaf": 1, "now": 0}])
            count += 1
        took = time.perf_counter() - began
        if answer["status"] == "running":
            speak(program, [{"do": "halt", "leaf": 1, "now": 0}])
        program.stdin.close()
    return 1e6 * took / max(1, ticks)


def of_subprocess():
    began = time.perf_counter()
    subprocess.run(["true"], check=True)
    return 1e6 * (time.perf_counter() - began)


# ---- the tick thread on the wall clock


def lateness(plugin, count):
    "p50 and p99 of the time between the begins of two ticks beyond the period, and the longest tick, in ms."
    with tempfile.TemporaryDirectory() as directory:
        file = pathlib.Path(directory) / "tree.xml"
        file.write_text(text(plugin, "<Parallel>" + '<Advance step="1e-6"/>' * count + "</Parallel>"))
        run = lockstep.run(file, clock="wall", rate=RATE, max_ticks=SECONDS * RATE, plugin_path=[PROGRAMS])
    period = run.period
    return [1e3 * (period["p50_s"] - 1 / RATE), 1e3 * (period["p99_s"] - 1 / RATE), 1e3 * run.worst_tick["took_s"]]


# ---- hold="signal": from the begin of the tick that holds a leaf until the kernel says that its process is stopped


def state_of(pid):
    return pathlib.Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0]


def stops():
    with tempfile.TemporaryDirectory() as directory:
        pids = pathlib.Path(directory) / "pids"
        os.environ["PIDS"] = str(pids)
        barriers = ";".join(f"{i / 500:g}" for i in range(1, 400))
        nodes = (f'<ParallelAbsolute barriers="{barriers}"><Steady name="ahead"/><Advance step="0.0004"/>'
                 "</ParallelAbsolute>")
        times = []
        with lockstep.Tree(text=text('name="steady" program="steady.py" hold="signal"', nodes), leaves=advance_class,
                           plugin_path=PROGRAMS, log=lambda *_: None) as tree:
            pid, ahead, was_held = int(pids.read_text().split()[-1]), tree.nodes[1], False
            while len(times) < 200:
                began = time.perf_counter()
                tree.tick()
                if ahead.held and not was_held:
                    while state_of(pid) != "T":
                        pass
                    times.append(1e6 * (time.perf_counter() - began))
                was_held = ahead.held
    return sorted(times)


def main():
    print(f"load before: {os.getloadavg()[0]:.1f}, {os.cpu_count()} cores, {ROUNDS} rounds\n")
    print("| A tick on the virtual clock | us |\n|---|---|")
    ticks = in_turns({
        "Python, by hand (`tests/programs/advance.py`)": lambda: of_a_tick('name="motion" program="advance.py"'),
        "Python, with `lockstep_leaf`": lambda: of_a_tick(PYTHON),
        "node": lambda: of_a_tick('name="motion" program="advance.js"'),
        "Python, in the process of Python (`lockstep.Tree`)": lambda: of_a_tick('name="advance_class"', leaves=advance_class),
        "C++": lambda: of_a_tick('name="motion"')})
    for name, times in ticks.items():
        print(f"| {name} | {spread(times)} |")
    print("\n| `Exec` | us |\n|---|---|")
    for name, times in in_turns({"a tick while its command runs": lambda: of_exec("sleep 1000", 2000),
                                 "`true`, from the start to Success": lambda: of_exec("true", 0),
                                 "`true`, by `subprocess.run`": of_subprocess}).items():
        print(f"| {name} | {spread(times, 0)} |")
    print(f"\n| {RATE} Hz, {SECONDS} s each | p50 beyond the period, ms | p99, ms | longest tick, ms |\n|---|---|---|---|")
    for name, runs in in_turns({
            "no program: 1 leaf in C++": lambda: lateness('name="motion"', 1),
            "no program: 100 leaves in C++": lambda: lateness('name="motion"', 100),
            "100 leaves in Python, one process": lambda: lateness(PYTHON, 100),
            "100 leaves in Python, 100 processes": lambda: lateness(PYTHON + ' hold="signal"', 100)}).items():
        print(f"| {name} | " + " | ".join(spread(it, 2) for it in zip(*runs)) + " |")
    times = stops()
    print(f"\nhold=\"signal\", from the begin of the tick until the process is stopped, of {len(times)}: "
          f"p50 {times[len(times) // 2]:.0f} us, p99 {times[len(times) * 99 // 100]:.0f} us, longest {times[-1]:.0f} us")
    print(f"\nload after: {os.getloadavg()[0]:.1f}")


main()
