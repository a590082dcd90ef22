"""Robots in step over the network of this machine: a member that starts late, hangs, is killed and started again, and
one whose name another program takes. Waits for what the robots print, and never for a time.

  network_test.py LOCKSTEP MEMBER TYPES LIAR

MEMBER is team_member.c, and TYPES the types of its words as a shared library, for team_member.py. LIAR is liar.c.
"""
import json
import os
import signal
import subprocess
import sys
import time

import robots
from robots import PATIENCE

LOCKSTEP, MEMBER, TYPES, LIAR = sys.argv[1:5]
IN_PYTHON = f"{os.path.dirname(__file__)}/../../plugins/sdk/examples/team_member.py"
# Robots of other tests on this machine are in other domains.
DOMAIN = str(1 + os.getpid() % 200)

TREE = """<root lockstep="1" main_tree_to_execute="Carry">
  <plugin name="motion"/>
  <arg name="me"/>
  <arg name="step" default="0.002"/>
  <arg name="barriers" default="0.25;0.5;0.75"/>
  <team name="table" members="left;right"/>
  <BehaviorTree ID="Carry">
    <InStep team="table" as="${me}" barriers="${barriers}"><Advance name="lift" step="${step}"/></InStep>
  </BehaviorTree>
</root>
"""


ROAD = """<root lockstep="1">
  <plugin name="motion"/>
  <arg name="me"/>
  <arg name="step" default="0.01"/>
  <team name="trucks" members="left;right"/>
  <resources name="roads" team="trucks" as="${me}" resources="road"/>
  <BehaviorTree ID="Haul">
    <UseResources pool="roads" resources="road"><Advance name="drive" step="${step}"/></UseResources>
  </BehaviorTree>
</root>
"""


class Robot(robots.Robot):
    def __init__(self, name, folder, *more, text=TREE):
        tree = f"{folder}/tree.xml"
        if not os.path.exists(tree):  # another robot may read it now
            with open(tree, "w", encoding="utf-8") as file:
                file.write(text)
        super().__init__([LOCKSTEP, "run", tree, "--arg", f"me={name}", "--team-domain", DOMAIN, "--team-peer", "127.0.0.1", *more],
                         f"{folder}/{name}-{time.monotonic_ns()}.jsonl")


def test_one_waits_for_the_other(folder):
    left = Robot("left", folder)
    left.wait_for("right: failure: not heard yet")
    right = Robot("right", folder)
    left.wait_for("lift: started")
    right.wait_for("lift: started")
    left.succeeds()
    right.succeeds()


def test_a_robot_that_hangs_is_waited_for(folder):
    left, right = Robot("left", folder), Robot("right", folder)
    right.wait_for("lift: started")
    left.wait_for("lift: started")
    right.kill(signal.SIGSTOP)
    left.wait_for("right: failure: not heard for")
    right.kill(signal.SIGCONT)
    left.wait_for("lift: continues")
    left.succeeds()
    right.succeeds()


def test_a_robot_that_is_started_again_joins(folder):
    left, right = Robot("left", folder), Robot("right", folder)
    left.wait_for("lift: waits for right at barrier|lift: started")
    right.wait_for("lift: started")
    right.kill()
    left.wait_for("right: failure: not heard for")
    again = Robot("right", folder)
    left.succeeds()
    again.succeeds()


def test_a_robot_that_is_killed_continues_in_its_round(folder):
    text = TREE.replace("<InStep", '<Repeat times="3"><InStep').replace("</InStep>", "</InStep></Repeat>")
    kept = ("--checkpoint", f"{folder}/right.checkpoint", "--resume")
    left = Robot("left", folder, "--arg", "step=0.02", text=text)
    right = Robot("right", folder, "--arg", "step=0.02", *kept)
    right.wait_for("lift: success")  # of the first round
    right.wait_for("lift: started")
    right.kill()
    left.wait_for("right: failure: not heard for")
    again = Robot("right", folder, "--arg", "step=0.02", *kept)
    again.wait_for("resumed after")
    left.succeeds()
    again.succeeds()


def test_a_robot_that_is_a_round_ahead_stays_so_when_it_continues(folder):
    text = TREE.replace("<InStep", '<Repeat times="2"><InStep').replace("</InStep>", "</InStep></Repeat>")
    common, kept = ("--arg", "barriers=0.25"), ("--checkpoint", f"{folder}/right.checkpoint", "--resume")
    left = Robot("left", folder, "--arg", "step=0.004", *common, text=text)
    right = Robot("right", folder, "--arg", "step=0.05", *common, *kept)
    right.wait_for("lift: success")
    right.wait_for("lift: waits for left at barrier 0.25")  # of the second round, and left is in the first one
    right.kill()
    again = Robot("right", folder, "--arg", "step=0.05", *common, *kept)
    again.wait_for("resumed after")
    left.succeeds()  # it would wait for ever for one that does the first round again
    again.succeeds()


def test_a_robot_that_continues_has_the_progress_that_it_heard_last(folder):
    kept = ("--checkpoint", f"{folder}/right.checkpoint", "--resume", "--on-resume", "success")
    left = Robot("left", folder)
    right = Robot("right", folder, "--arg", "step=0.05", *kept)
    right.wait_for("lift: waits for left at barrier 0.5")  # so left is behind 0.25
    right.kill()
    again = Robot("right", folder, "--arg", "step=0.05", *kept)
    resumed = again.wait_for("resumed after.*\n").group()
    assert "left'" not in resumed, resumed  # what another robot does is never assumed
    left.succeeds()
    again.succeeds()
    with open(again.record, encoding="utf-8") as file:
        lines = [json.loads(line) for line in file]
    node = next(it["index"] for it in lines[0]["nodes"] if it["path"].endswith("/left"))
    heard = [it[2] for line in lines[1:] for it in line.get("nodes", []) if it[0] == node and it[1] in ("running", "failure")]
    assert heard and min(heard) >= 0.25, heard


def test_two_of_one_name_both_hold(folder):
    left, right = Robot("left", folder), Robot("right", folder)
    right.wait_for("lift: started")
    other = Robot("right", folder)
    right.wait_for("left: failure: another robot has the name of this one")
    left.wait_for("right: failure: two robots have this name")
    other.wait_for("left: failure: another robot has the name of this one")
    other.kill()
    left.succeeds()
    right.succeeds()


def test_a_road_has_one_owner_also_when_that_is_killed(folder):
    left = Robot("left", folder, "--arg", "step=0.0001", text=ROAD)
    left.wait_for("'right' is not heard yet")
    right = Robot("right", folder, text=ROAD)
    left.wait_for("drive: started")
    right.wait_for("'left' has 'road'")
    left.kill()
    assert "drive: started" not in right.text
    again = Robot("left", folder, text=ROAD)
    right.wait_for("drive: started")
    again.wait_for("drive: started")
    right.succeeds()
    again.succeeds()


def test_trees_that_differ_hold(folder):
    left, right = Robot("left", folder), Robot("right", folder, "--arg", "barriers=0.5")
    left.wait_for("right: failure: its tree declares the team in another way")
    right.wait_for("left: failure: its tree declares the team in another way")
    for robot in (left, right):
        robot.kill(signal.SIGINT)
        assert robot.end() == 130


def start(*program):
    """A program of another kind, in the domain of the robots."""
    peers = "<Discovery><ParticipantIndex>auto</ParticipantIndex><Peers><Peer address='127.0.0.1'/></Peers></Discovery>"
    uri = f"<General><AllowMulticast>false</AllowMulticast></General>{peers}"
    process = subprocess.Popen([*program, DOMAIN], stdout=subprocess.PIPE, env={**os.environ, "CYCLONEDDS_URI": uri})
    robots.started.append(process)
    return process


def is_in_step_with(folder, *member):
    process = start(*member)
    left = Robot("left", folder, "--arg", "step=0.01")
    left.succeeds()
    assert process.communicate(timeout=PATIENCE)[0] == b"success\n" and process.returncode == 0


def test_a_program_that_lies_uses_no_memory_and_is_named(folder):
    left = Robot("left", folder)
    left.wait_for("right: failure: not heard yet")
    before = robots.memory_of(left.process)
    start(LIAR)
    left.wait_for("the team 'table' has no member 'ghost_0'")
    left.wait_for("right: failure: what it sends makes no sense")
    assert robots.memory_of(left.process) - before < 8192, "KiB"
    left.kill(signal.SIGINT)
    assert left.end() == 130


def test_a_program_in_c_takes_part(folder):
    is_in_step_with(folder, MEMBER)


def test_a_program_in_python_takes_part(folder):
    is_in_step_with(folder, sys.executable, IN_PYTHON, TYPES)


def test_a_wrong_interface_is_a_sentence(folder):
    robot = Robot("left", folder, "--team-interface", "nowhere0")
    code = robot.end()
    assert code == 2 and "the team cannot be reached" in robot.text and "nowhere0" in robot.text, (code, robot.text)


robots.run_tests(globals())
