"""Robots in step over the network of this machine: a member that starts late, hangs, is killed and started again, and
one whose name another program takes. Waits for what the robots print, and never for a time.

  network_test.py LOCKSTEP MEMBER
"""
import os
import re
import select
import signal
import subprocess
import sys
import tempfile
import time

LOCKSTEP, MEMBER = sys.argv[1:3]
PATIENCE = 60  # s; only a failure takes so long
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


started = []  # processes, of which none may be left


class Robot:
    def __init__(self, name, tree, *more):
        self.record = f"{os.path.dirname(tree)}/{name}-{time.monotonic_ns()}.jsonl"
        self.process = subprocess.Popen(
            [LOCKSTEP, "run", tree, "--arg", f"me={name}", "--record", self.record, "--view", "plain", "--team-domain", DOMAIN,
             "--team-peer", "127.0.0.1", "--stall", "0", *more],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        started.append(self.process)
        self.text = ""

    def wait_for(self, pattern):
        """The first match in what it prints from now on."""
        limit = time.monotonic() + PATIENCE
        while not (found := re.search(pattern, self.text)):
            assert time.monotonic() < limit, f"no {pattern!r} in:\n{self.text}"
            if select.select([self.process.stderr], [], [], 1)[0]:
                piece = os.read(self.process.stderr.fileno(), 65536).decode()
                assert piece, f"it ended without {pattern!r}:\n{self.text}"
                self.text += piece
        self.text = self.text[found.end():]
        return found

    def end(self):
        out, err = self.process.communicate(timeout=PATIENCE)
        self.text += err.decode()
        return self.process.returncode, out.decode()

    def kill(self, signal_number=signal.SIGKILL):
        self.process.send_signal(signal_number)
        if signal_number == signal.SIGKILL:
            self.process.wait()


def test_one_waits_for_the_other(tree):
    left = Robot("left", tree)
    left.wait_for("right: failure: not heard yet")
    right = Robot("right", tree)
    left.wait_for("lift: started")
    right.wait_for("lift: started")
    assert left.end()[0] == 0 and right.end()[0] == 0, (left.text, right.text)


def test_a_robot_that_hangs_is_waited_for(tree):
    left, right = Robot("left", tree), Robot("right", tree)
    right.wait_for("lift: started")
    left.wait_for("lift: started")
    right.kill(signal.SIGSTOP)
    left.wait_for("right: failure: not heard for")
    right.kill(signal.SIGCONT)
    left.wait_for("lift: continues")
    assert left.end()[0] == 0 and right.end()[0] == 0, (left.text, right.text)


def test_a_robot_that_is_started_again_joins(tree):
    left, right = Robot("left", tree), Robot("right", tree)
    left.wait_for("lift: waits for right at barrier|lift: started")
    right.wait_for("lift: started")
    right.kill()
    left.wait_for("right: failure: not heard for")
    again = Robot("right", tree)
    assert left.end()[0] == 0 and again.end()[0] == 0, (left.text, again.text)


def test_two_of_one_name_both_hold(tree):
    left, right = Robot("left", tree), Robot("right", tree)
    right.wait_for("lift: started")
    other = Robot("right", tree)
    right.wait_for("left: failure: another robot has the name of this one")
    left.wait_for("right: failure: two robots have this name")
    other.wait_for("left: failure: another robot has the name of this one")
    other.kill()
    assert left.end()[0] == 0 and right.end()[0] == 0, (left.text, right.text)


def test_trees_that_differ_hold(tree):
    left, right = Robot("left", tree), Robot("right", tree, "--arg", "barriers=0.5")
    left.wait_for("right: failure: its tree declares the team in another way")
    right.wait_for("left: failure: its tree declares the team in another way")
    for robot in (left, right):
        robot.kill(signal.SIGINT)
        assert robot.end()[0] == 130


def test_a_program_without_lockstep_takes_part(tree):
    peers = "<Discovery><ParticipantIndex>auto</ParticipantIndex><Peers><Peer address='127.0.0.1'/></Peers></Discovery>"
    uri = f"<General><AllowMulticast>false</AllowMulticast></General>{peers}"
    member = subprocess.Popen([MEMBER, DOMAIN], stdout=subprocess.PIPE, env={**os.environ, "CYCLONEDDS_URI": uri})
    started.append(member)
    left = Robot("left", tree, "--arg", "step=0.01")
    assert left.end()[0] == 0, left.text
    assert member.communicate(timeout=PATIENCE)[0] == b"success\n" and member.returncode == 0


def test_a_wrong_interface_is_a_sentence(tree):
    robot = Robot("left", tree, "--team-interface", "nowhere0")
    code, _ = robot.end()
    assert code == 2 and "the team cannot be reached" in robot.text and "nowhere0" in robot.text, (code, robot.text)


with tempfile.TemporaryDirectory() as directory:
    file = f"{directory}/carry.xml"
    with open(file, "w", encoding="utf-8") as text:
        text.write(TREE)
    for name, test in list(globals().items()):
        if name.startswith("test_"):
            print(name, flush=True)
            try:
                test(file)
            finally:
                for process in started:
                    process.kill()
                    process.wait()
                started.clear()
