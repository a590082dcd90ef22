"""Kills runs of random trees and continues them, and compares what follows with the same run without a cut, tick by tick.

    cuts.py LOCKSTEP PLUGINS COUNT [--seed N] [--wall]

COUNT runs, the first with this seed. Each is killed once or several times, at random ticks. All leaves keep their state, so the
ticks after the last cut must be the last ones of the run without a cut: the same nodes with the same states and progress. With
--wall on the wall clock, in trees where no node counts time."""
import argparse
import json
import os
import random
import signal
import subprocess
import sys
import tempfile

RATE, MOST_TICKS, WALL_RATE = 10, 300, 500


class Trees:
    "Random trees of nodes that all can continue."

    def __init__(self, seed, wall):
        self.random = random.Random(seed)
        self.wall = wall
        self.number = 0

    def leaf(self):
        kinds = ["advance"] * 5 + ["script", "check"] + ([] if self.wall else ["wait"])
        kind = self.random.choice(kinds)
        self.number += 1
        if kind == "advance":
            return f'<Advance name="a{self.number}" step="{self.random.choice([0.5, 0.34, 0.21, 0.13, 0.07])}"/>'
        if kind == "script":
            return f'<Script code="n += {self.random.randint(1, 3)}"/>'
        if kind == "check":
            return f'<Check code="n {self.random.choice(["&lt;", "&gt;"])} {self.random.randint(1, 6)}"/>'
        return f'<Wait seconds="{self.random.choice([0.2, 0.5, 0.7])}"/>'

    def children(self, depth, least=1, most=3):
        return "".join(self.node(depth - 1) for _ in range(self.random.randint(least, most)))

    def node(self, depth):
        if depth == 0:
            return self.leaf()
        r = self.random
        kinds = ["leaf", "Sequence", "Fallback", "Parallel", "Absolute", "Relative", "Repeat", "Retry", "pool", "Inverter"]
        kind = r.choice(kinds + ([] if self.wall else ["Timeout"]))
        memory = r.choice(["true", "true", "false"])
        if kind == "leaf":
            return self.leaf()
        if kind in ("Sequence", "Fallback"):
            return f'<{kind} memory="{memory}">{self.children(depth)}</{kind}>'
        if kind == "Parallel":
            return f"<Parallel>{self.children(depth, 2)}</Parallel>"
        if kind == "Absolute":
            barriers = r.choice(["0.5", "0.25;0.75", "0.4;0.6;0.8"])
            return f'<ParallelAbsolute barriers="{barriers}">{self.children(depth, 2)}</ParallelAbsolute>'
        if kind == "Relative":
            return f'<ParallelRelative delta="{r.choice([0.1, 0.3])}">{self.children(depth, 2)}</ParallelRelative>'
        inside = self.node(depth - 1)
        if kind == "Repeat":
            return f'<Repeat times="{r.randint(2, 3)}">{inside}</Repeat>'
        if kind == "Retry":
            return f'<Retry attempts="{r.randint(2, 3)}">{inside}</Retry>'
        if kind == "pool":
            return f'<UseResources pool="arms" resources="{r.choice(["one", "two", "one;two"])}">{inside}</UseResources>'
        if kind == "Timeout":
            return f'<Timeout seconds="{r.choice([0.5, 1.1, 3])}">{inside}</Timeout>'
        return f"<Inverter>{inside}</Inverter>"

    def document(self):
        tree = "".join(f'<Fallback memory="true">{self.node(3)}<Script code="n += 1"/></Fallback>' for _ in range(2))
        return ('<root lockstep="1"><plugin name="motion"/><resources name="arms" resources="one;two"/><barrier name="meet" barriers="0.5"/>'
                f'<BehaviorTree ID="Main"><Sequence memory="true"><Script code="n := 0"/><Parallel>{tree}'
                '<SyncProgress barrier="meet"><Advance name="one" step="0.012"/></SyncProgress>'
                '<SyncProgress barrier="meet"><Advance name="two" step="0.015"/></SyncProgress></Parallel></Sequence></BehaviorTree></root>')


class Trial:
    def __init__(self, options, seed, directory):
        self.options, self.seed, self.directory = options, seed, directory
        self.tree = self.path("tree.xml")
        with open(self.tree, "w") as file:
            file.write(Trees(seed, options.wall).document())

    def path(self, name):
        return os.path.join(self.directory, name)

    def command(self, record, *more):
        clock = ["--rate", str(WALL_RATE)] if self.options.wall else ["--clock", "virtual", "--rate", str(RATE)]
        return [self.options.lockstep, "run", self.tree, *clock, "--plugin-path", self.options.plugins, "--view", "none",
                "--max-ticks", str(MOST_TICKS), "--record", record, *more]

    def finish(self, record, *more):
        done = subprocess.run(self.command(record, *more), capture_output=True, text=True)
        if done.returncode not in (0, 1, 3, 124):
            raise AssertionError(f"exit code {done.returncode}: {done.stderr}")
        return done

    def kill_at(self, tick, *more):
        "The last tick that was seen; None: the run has ended before."
        reading, writing = os.pipe()  # a run that records nothing, since it had ended at the kill before, closes it as well
        process = subprocess.Popen(self.command(f"/dev/fd/{writing}", *more), stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                   pass_fds=[writing])
        os.close(writing)
        seen = None
        with open(reading, "rb") as lines:
            for line in lines:
                value = json.loads(line)
                if "end" in value:
                    break
                if "tick" in value and value["tick"] >= tick:
                    seen = value["tick"]
                    process.send_signal(signal.SIGKILL)
                    break
        process.wait()
        return seen if process.returncode == -signal.SIGKILL else None

    def ticks(self, record):
        "What the recording has of each tick: its rows, and on the virtual clock its time."
        done = subprocess.run([self.options.lockstep, "log", "csv", record], capture_output=True, text=True, check=True)
        ticks, last = [], None
        for row in done.stdout.splitlines()[1:]:
            tick, time, *rest = row.split(",")
            if tick != last:
                ticks.append([] if self.options.wall else [time])
                last = tick
            ticks[-1].append(rest)
        return ticks

    def check(self, chance):
        if self.finish(self.path("uncut.jsonl")).returncode == 3:  # `check` is right about it
            return 0
        uncut = self.ticks(self.path("uncut.jsonl"))
        if len(uncut) < 2:
            return 0
        checkpoint, cuts, done = self.path("run.checkpoint"), 0, 0
        for _ in range(chance.randint(1, 3)):
            resume = ["--checkpoint", checkpoint] + (["--resume", "--resume-limit", "9"] if cuts else [])
            seen = self.kill_at(chance.randrange(max(1, len(uncut) - done)), *resume)
            if seen is None:
                break
            cuts += 1
            done += seen
        if cuts == 0:
            return 0
        state = json.loads(subprocess.run([self.options.lockstep, "checkpoint", checkpoint, "--json"], capture_output=True,
                                          text=True, check=True).stdout)
        if state["state"] == "ended":
            return 0
        self.finish(self.path("resumed.jsonl"), "--checkpoint", checkpoint, "--resume", "--resume-limit", "9")
        resumed = self.ticks(self.path("resumed.jsonl"))
        expected = uncut[state["ticks"]:]
        if resumed != expected:
            different = next((i for i, (a, b) in enumerate(zip(resumed, expected)) if a != b), min(len(resumed), len(expected)))
            raise AssertionError(f"cut after {state['ticks']} ticks, it differs {different} ticks later:\n"
                                 f"uncut   {expected[different:different + 1]}\nresumed {resumed[different:different + 1]}")
        return cuts


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("lockstep")
    parser.add_argument("plugins")
    parser.add_argument("count", type=int)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--wall", action="store_true")
    options = parser.parse_args()
    cuts = 0
    for seed in range(options.seed, options.seed + options.count):
        with tempfile.TemporaryDirectory() as directory:
            trial = Trial(options, seed, directory)
            try:
                cuts += trial.check(random.Random(seed))
            except (AssertionError, subprocess.CalledProcessError, json.JSONDecodeError) as error:
                with open(trial.tree) as file:
                    print(f"seed {seed}: {error}\n{file.read()}")
                return 1
    print(f"{cuts} cuts of {options.count} runs")
    return 0 if cuts > 0 else 1  # how many runs end before they are killed depends on the machine


sys.exit(main())
