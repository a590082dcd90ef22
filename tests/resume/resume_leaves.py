"""Leaves that continue after a cut: in Python, isolated, and of BehaviorTree.CPP; and those that commit.

    resume_leaves.py LOCKSTEP PLUGINS FOLDER…

A leaf of the plugin `cut`, next to the leaf that is tried, kills the run in the middle of a tick. PLUGINS and the folders
contain the plugins."""
import os
import re
import subprocess
import sys
import tempfile

LOCKSTEP, *FOLDERS = sys.argv[1:]

COUNT = '''#!/usr/bin/python3
import os
import time
from lockstep_leaf import Action, Failed, serve

PID = os.environ["LOG"] + ".pid"

class Count(Action):
    "Counts its ticks."
    ticks: int = 20
    answer: str = "goes on"

    def __init__(self):
        with open(PID, "w") as file:
            file.write(str(os.getpid()))

    def start(self):
        self.done = 0

    def tick(self):
        self.done += 1
        return True if self.done == self.ticks else None

    def progress(self):
        return self.done / self.ticks

    def pause(self):
        self.log("is held")

    def resume(self):
        self.log(f"continues at {self.done}")

    def save(self):
        return {"done": self.done}

    def restore(self, kept, cut):
        self.log(f"gap {cut.gap >= 0}, lost {cut.lost_ticks}, held {cut.held}, power {cut.power}, {cut.on_resume}, at {self.now:.1f}")
        if self.answer == "fails":
            raise Failed("the table is gone")
        self.done = kept["done"]
        return self.answer != "begins"

class Look(Action):
    "After a cut, looks whether the process of Count is stopped by a signal, as expected."
    stopped: bool
    was_cut = False

    def is_as_expected(self):
        with open("/proc/" + open(PID).read() + "/stat") as file:
            return (file.read().rpartition(")")[2].split()[0] == "T") == self.stopped

    def tick(self):
        until = time.monotonic() + 2
        while self.was_cut and not self.is_as_expected() and time.monotonic() < until:
            time.sleep(0.001)
        return self.is_as_expected() if self.was_cut else None

    def save(self):
        return None

    def restore(self, kept, cut):
        self.was_cut = True
        return True

serve()
'''


class Mission:
    def __init__(self, directory, language, plugins, nodes):
        self.directory = directory
        for name in os.listdir(directory):
            os.unlink(os.path.join(directory, name))
        program = self.file("count.py", COUNT)
        os.chmod(program, 0o755)
        self.tree = self.file("tree.xml", f'<root {language}><plugin name="cut"/>{plugins}'
                                          f'<BehaviorTree ID="Main">{nodes}</BehaviorTree></root>')

    def file(self, name, text):
        path = os.path.join(self.directory, name)
        with open(path, "w") as file:
            file.write(text)
        return path

    def run(self, *more, cut_at=None, environment={}):
        paths = [it for folder in (self.directory, *FOLDERS) for it in ("--plugin-path", folder)]
        variables = dict(os.environ, LOG=os.path.join(self.directory, "log"), **environment)
        if cut_at is not None:
            variables["CUT_AT"] = str(cut_at)
        return subprocess.run([LOCKSTEP, "run", self.tree, "--clock", "virtual", "--rate", "10", *paths, *more], env=variables,
                              capture_output=True, text=True)

    def cut_and_resume(self, cut_at, environment={}):
        keep = ["--checkpoint", os.path.join(self.directory, "run.checkpoint")]
        cut = self.run(*keep, cut_at=cut_at)
        assert cut.returncode == -9, (cut.returncode, cut.stderr)
        return self.run(*keep, "--resume", environment=environment)

    def log(self):
        with open(os.path.join(self.directory, "log")) as file:
            return file.read()


def end_of(run, name):
    found = re.search(rf"([0-9.]+) s +tick +\d+ +\S*/{name}: success", run.stderr)
    assert found, run.stderr
    return float(found.group(1))


OURS, THEIRS = 'lockstep="1"', 'BTCPP_format="4"'
CLOCK = '<Move who="clock" ticks="30"/>'


def check_continues(directory, language, plugins, leaf, at, parallel="Parallel"):
    mission = Mission(directory, language, plugins, f"<{parallel}>{leaf}{CLOCK}</{parallel.split()[0]}>")
    uncut = mission.run()
    assert uncut.returncode == 0, uncut.stderr
    reported = ""
    for tick in 0.3, 0.8:
        resumed = mission.cut_and_resume(tick)
        assert resumed.returncode == 0, resumed.stderr
        assert f"/it' continues at {at[tick]}" in resumed.stderr, resumed.stderr
        assert end_of(resumed, "it") == end_of(uncut, "it"), (uncut.stderr, resumed.stderr)
        reported += resumed.stderr
    return reported


def test_python(directory):
    reported = check_continues(directory, OURS, '<plugin name="count" program="count.py"/>', '<Count name="it"/>',
                              {0.3: "0.15", 0.8: "0.4"})
    assert "gap True, lost 1, held False, power False, restart, at 0.2" in reported, reported


def test_a_held_leaf_in_python(directory):
    reported = check_continues(directory, OURS, '<plugin name="count" program="count.py" hold="message"/>',
                              '<Count name="it" ticks="10"/>', {0.3: "0.2", 0.8: "0.4"}, 'ParallelAbsolute barriers="0.2;0.6"')
    assert "held True" in reported and "info: continues at 2" in reported, reported


def test_a_leaf_that_is_held_by_a_signal(directory):
    "Its process is another one after the cut, and is stopped as that before it. At 0.5, Count is held."
    plugins = '<plugin name="count" program="count.py" hold="signal"/>'
    nodes = '<Parallel><ParallelAbsolute barriers="0.2"><Count name="it" ticks="10" answer="{}"/>{}</ParallelAbsolute>' \
            '<Look name="look" stopped="{}"/></Parallel>'
    for answer, is_stopped in ("goes on", "true"), ("begins", "false"):
        resumed = Mission(directory, OURS, plugins, nodes.format(answer, CLOCK, is_stopped)).cut_and_resume(0.5)
        assert resumed.returncode == 0, resumed.stderr
        assert end_of(resumed, "look") == 0.5, resumed.stderr
        assert answer == "begins" or end_of(resumed, "it") == 1.3, resumed.stderr


def test_python_that_does_not_continue(directory):
    plugin = '<plugin name="count" program="count.py"/>'
    mission = Mission(directory, OURS, plugin, f'<Parallel><Count name="it" answer="begins"/>{CLOCK}</Parallel>')
    again = mission.cut_and_resume(0.8)
    assert "/it' starts again" in again.stderr and abs(end_of(again, "it") - 2.7) < 1e-9, again.stderr
    mission = Mission(directory, OURS, plugin, f'<Parallel><Count name="it" answer="fails"/>{CLOCK}</Parallel>')
    failed = mission.cut_and_resume(0.8)
    assert failed.returncode == 1 and "/it' cannot continue" in failed.stderr, failed.stderr


def test_isolated(directory):
    for flag in "", ' isolate="true"':
        check_continues(directory, OURS, f'<plugin name="motion"{flag}/>', '<Advance name="it" step="0.05"/>',
                        {0.3: "0.15", 0.8: "0.4"})


def test_behaviortree_cpp(directory):
    for flag in "", ' isolate="true"':
        check_continues(directory, THEIRS, f'<plugin name="faulty"{flag}/>', '<Reach name="it" step="0.05"/>',
                        {0.3: "0.15", 0.8: "0.4"})


def test_behaviortree_cpp_that_is_held(directory):
    "onRestored does not learn it, so onPaused follows."
    mission = Mission(directory, THEIRS, '<plugin name="faulty"/>',
                      f'<ParallelAbsolute barriers="0.2"><Reach name="it" step="0.1"/>{CLOCK}</ParallelAbsolute>')
    resumed = mission.cut_and_resume(0.5)
    assert re.findall("it holds at .*|it goes on", resumed.stderr) == ["it holds at 0.2", "it goes on"], resumed.stderr


def test_commit(directory):
    tree = '<Sequence memory="true"><Parallel><Move who="it" name="it" ticks="5" commit="true"/><Move who="clock" ticks="8"/></Parallel>' \
           '<Step who="end"/></Sequence>'
    mission = Mission(directory, OURS, "", tree)
    assert end_of(mission.run(), "it") == 0.4
    keep = ["--checkpoint", os.path.join(directory, "run.checkpoint")]
    assert end_of(mission.run(*keep), "it") == 0.5
    for cut_at in 0.4, 0.5, 0.6:
        os.unlink(os.path.join(directory, "log"))
        resumed = mission.cut_and_resume(cut_at)
        assert resumed.returncode == 0, resumed.stderr
        assert mission.log().count("it succeeds") == 1, (cut_at, mission.log())
        assert "halted" not in mission.log(), mission.log()
        # From 0.5 s on it waits for the disk, and there is nothing that it could do again.
        (told,) = re.findall("resumed after .*", resumed.stderr)
        assert ("/it'" in told) == (cut_at == 0.4), told


def test_what_the_element_says(directory):
    for word, code in ("failure", 1), ("success", 0), ("restart", 0):
        mission = Mission(directory, OURS, "", f'<Step who="a" ticks="9" on_resume="{word}"/>')
        assert mission.cut_and_resume(0.4).returncode == code
        mission = Mission(directory, THEIRS, "", f'<Step who="a" ticks="9" _onResume="{word}"/>')
        assert mission.cut_and_resume(0.4).returncode == code


def test_what_the_element_says_is_known_to_a_leaf_that_continues(directory):
    for more, wants in (('on_resume="failure"', ["would fail"]), ('on_resume="success"', ["would succeed"]), ("", [])):
        mission = Mission(directory, OURS, "", f'<Move who="a" ticks="9" {more}/>')
        assert mission.cut_and_resume(0.4).returncode == 0
        assert re.findall("would .*", mission.log()) == wants, mission.log()
    mission = Mission(directory, OURS, '<plugin name="count" program="count.py"/>',
                      f'<Parallel><Count name="it" on_resume="failure"/>{CLOCK}</Parallel>')
    resumed = mission.cut_and_resume(0.4).stderr
    assert re.search(r"0\.300 s +tick 4 .*power False, failure", resumed), resumed


def test_what_is_wrong_with_an_element(directory):
    for leaf, message in (('<Step on_resume="stop"/>', "'stop' is not restart, failure or success"),
                          ('<Step commit="perhaps"/>', "'perhaps' is not true or false"),
                          ('<Wait seconds="1" on_resume="failure"/>', "'on_resume' is for actions of plugins")):
        wrong = Mission(directory, OURS, "", leaf).run()
        assert wrong.returncode == 3 and message in wrong.stderr, wrong.stderr


def test_the_summary_is_of_a_run_that_began_before(directory):
    "Nothing is blamed for what the cut did: the progress of its first tick, and the time of restore."
    mission = Mission(directory, OURS, "", '<ParallelAbsolute barriers="0.9"><Move who="a" ticks="10"/>'
                                           '<Move who="b" ticks="12"/></ParallelAbsolute>')
    resumed = mission.cut_and_resume(0.5)
    assert "rose" not in resumed.stdout and "budget" not in resumed.stderr + resumed.stdout, resumed


def test_a_leaf_that_breaks_in_restore(directory):
    mission = Mission(directory, OURS, "", '<Fallback memory="true"><Move who="a" ticks="9"/><Step who="b"/></Fallback>')
    broken = mission.cut_and_resume(0.4, {"AFTER_CUT": "throw"})
    assert broken.returncode == 5 and "the arm is gone" in broken.stderr, broken.stderr
    again = mission.run("--checkpoint", os.path.join(directory, "run.checkpoint"), "--resume")  # a fault is no cut
    assert again.returncode == 0 and "resumed" not in again.stderr, again.stderr


with tempfile.TemporaryDirectory() as directory:
    for name, test in list(globals().items()):
        if name.startswith("test_"):
            test(directory)
            print(name)
