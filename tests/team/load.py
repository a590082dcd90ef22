#!/usr/bin/env python3
"""Eight robots in step at 100 Hz on one machine, compared with the same eight trees without a team: how late their ticks
are, and whether their memory grows. Both kinds take turns, so that both meet what else the machine does.

usage: load.py LOCKSTEP MINUTES [OPTION…]

Each OPTION is one of `lockstep run`, such as --realtime. The last line is the verdict; the exit code is 1 if the median of
the ratios of p99 is above 1.5 where the team adds more than 0.1 ms, or memory grows."""
import json
import os
import statistics
import subprocess
import sys
import tempfile
import time

from robots import memory_of

MEMBERS, RATE, TURN = 8, 100, 15  # Hz, s
MOST_RATIO, LEAST_DIFFERENCE = 1.5, 0.1e-3
WARM_UP, MOST_GROWTH = 10, 2048  # s, KiB; DDS keeps up to 1 MiB, and gives it back every few minutes

TREE = """<root lockstep="1" main_tree_to_execute="Carry">
  <plugin name="motion"/>
  <arg name="me"/>
  {team}
  <BehaviorTree ID="Carry">{around[0]}<Advance name="lift" step="{step}"/>{around[1]}</BehaviorTree>
</root>
"""


def names():
    return [f"robot_{letter}" for letter in "abcdefgh"[:MEMBERS]]


def tree(seconds, has_team):
    team = f'<team name="table" members="{";".join(names())}"/>' if has_team else ""
    barriers = ";".join(str(i / 20) for i in range(1, 20))
    around = (f'<InStep team="table" as="${{me}}" barriers="{barriers}">', "</InStep>") if has_team else \
        ("<Sequence>", "</Sequence>")
    return TREE.format(team=team, around=around, step=1 / (seconds * RATE))


def run(lockstep, seconds, has_team, options):
    """The summaries of all robots, and how many KiB the memory of each has grown after the warm-up."""
    with tempfile.NamedTemporaryFile("w", suffix=".xml") as file:
        file.write(tree(seconds, has_team))
        file.flush()
        domain = str(201 + os.getpid() % 30)  # other tests are below
        robots = [subprocess.Popen([lockstep, "run", file.name, "--arg", f"me={name}", "--json", "--view", "none", "--stall", "0",
                                    "--team-domain", domain, *options], stdout=subprocess.PIPE) for name in names()]
        growth = []
        try:
            if seconds > 2 * WARM_UP:
                time.sleep(WARM_UP)
                before = [memory_of(robot) for robot in robots]
                time.sleep(seconds - 2 * WARM_UP)
                growth = [memory_of(robot) - kib for robot, kib in zip(robots, before)]
            return [json.loads(robot.communicate()[0]) for robot in robots], growth
        finally:
            for robot in robots:
                robot.kill()


def lateness(summaries):
    """p99 of the median robot, and the maximum of all, in seconds."""
    assert all(it["result"] == "success" for it in summaries), summaries
    return statistics.median(it["lateness"]["p99_s"] for it in summaries), max(it["lateness"]["max_s"] for it in summaries)


def main():
    lockstep, minutes, *options = sys.argv[1:]
    seconds = float(minutes) * 60
    ratios, differences = [], []
    for _ in range(max(1, round(seconds / 2 / (2 * TURN)))):
        (p99, most), (p99_alone, most_alone) = (lateness(run(lockstep, TURN, has_team, options)[0]) for has_team in (True, False))
        ratios.append(p99 / p99_alone)
        differences.append(p99 - p99_alone)
        print(f"late, in ms: p99 {p99 * 1e3:.3f}, max {most * 1e3:.3f} in a team; p99 {p99_alone * 1e3:.3f}, "
              f"max {most_alone * 1e3:.3f} without one; ratio of p99 {ratios[-1]:.2f}", flush=True)
    summaries, growth = run(lockstep, seconds / 2, True, options)
    p99, most = lateness(summaries)
    print(f"{seconds / 2:.0f} s in a team: p99 {p99 * 1e3:.3f} ms, max {most * 1e3:.3f} ms late; "
          f"memory grew by {max(growth)} KiB at most")
    ratio, difference = statistics.median(ratios), statistics.median(differences)
    is_good = (ratio <= MOST_RATIO or difference <= LEAST_DIFFERENCE) and max(growth) <= MOST_GROWTH
    print(f"{'passed' if is_good else 'failed'}: ratio of p99 {ratio:.2f}, {difference * 1e3:+.3f} ms; growth {max(growth)} KiB")
    sys.exit(not is_good)


main()
