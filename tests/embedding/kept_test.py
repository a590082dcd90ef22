"""Programs that embed lockstep and keep a run in a file: killed in the middle of a tick, they continue from there.

    kept_test.py IN_C IN_CPP"""
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import unittest

PROGRAMS = pathlib.Path(__file__).parent / "programs"
TREE = """<root lockstep="1"><BehaviorTree ID="Main"><Sequence memory="true"><Script code="n := 0"/><Repeat times="2">
<Sequence memory="true"><ParallelAbsolute barriers="0.5"><Step name="left" ticks="4"/><Step name="right" ticks="6"/>
</ParallelAbsolute><Script code="n += 1"/></Sequence></Repeat></Sequence></BehaviorTree></root>"""
IN_C, IN_CPP, IN_PYTHON = [sys.argv[1]], [sys.argv[2]], [sys.executable, str(PROGRAMS / "kept.py")]
LEFT, RIGHT = 5, 6  # the numbers of their nodes


class Kept(unittest.TestCase):
    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.directory = pathlib.Path(directory.name)
        self.tree, self.file = self.directory / "tree.xml", self.directory / "run.checkpoint"
        self.tree.write_text(TREE)

    def run_program(self, program, cut_at=None, period=0.1, **environment):
        arguments = [self.tree, self.file, str(period)] + ([] if cut_at is None else [str(cut_at)])
        return subprocess.run([*program, *arguments], capture_output=True, text=True, env=os.environ | environment)

    def ticks(self, done):
        return [line for line in done.stdout.splitlines() if line[0].isdigit()]

    def kept_ticks(self):
        shown = subprocess.run([os.environ["LOCKSTEP"], "checkpoint", self.file, "--json"], capture_output=True, check=True)
        return json.loads(shown.stdout)["ticks"]

    def uncut(self, program, **environment):
        done = self.run_program(program, **environment)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return self.ticks(done)

    def cut(self, program, at, **environment):
        done = self.run_program(program, cut_at=at, **environment)
        self.assertEqual(done.returncode, -signal.SIGKILL, done.stdout + done.stderr)
        return self.ticks(done)

    def check(self, program, **environment):
        expected = self.uncut(program, **environment)
        self.assertEqual(len(expected), 12)
        for tick in range(len(expected)):
            before = self.cut(program, tick * 0.1, **environment)
            done = self.run_program(program, **environment)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            self.assertEqual(before + self.ticks(done), expected, f"cut in tick {tick}")
            if tick == 2:
                text, *leaves = done.stdout.splitlines()[:3]
                self.assertRegex(text, r"^resumed after \d+(\.\d)? s; '.*/left' continues at 0.5; '.*/right' continues at 0.33$")
                self.assertEqual(leaves, [f"leaf {LEFT} is 1 at 0.50, asked 1", f"leaf {RIGHT} is 1 at 0.33, asked 1"])

    def test_in_c_it_ticks_by_itself(self):
        self.check(IN_C)

    def test_in_cpp_in_the_loop_of_the_run(self):
        self.check(IN_CPP)

    def test_in_python(self):
        self.check(IN_PYTHON)

    def test_in_python_in_the_loop_of_the_run(self):
        self.check(IN_PYTHON, LOOP="1")

    def test_killed_several_times_in_a_row(self):
        expected = self.uncut(IN_C)
        found = []
        for at in (0.3, 0.5, 0.5, 1.1):  # the third one is killed before its first tick has ended
            found += self.cut(IN_C, at)
        self.assertEqual(found + self.ticks(self.run_program(IN_C)), expected)

    def test_resumed_too_often_without_a_leaf_that_completes(self):
        for _ in range(4):
            self.cut(IN_C, 0.3)
        done = self.run_program(IN_C)
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stdout, "^error: '.*' was resumed 3 times in a row and no leaf has completed: remove the file "
                                      "to start a new run, or give a larger resume_limit")

    def test_killed_from_outside_on_the_clock_of_the_wall(self):
        self.tree.write_text(TREE.replace('ticks="4"', 'ticks="400000"').replace('ticks="6"', 'ticks="600000"'))
        process = subprocess.Popen([*IN_C, self.tree, self.file, "0"], stdout=subprocess.PIPE, text=True)
        for line in process.stdout:  # until the thread that writes has had its turn
            if line.split()[0].endswith("000") and self.kept_ticks() > 1:
                break
        process.kill()
        process.stdout.close()
        process.wait()
        resumed = subprocess.Popen([*IN_C, self.tree, self.file, "0"], stdout=subprocess.PIPE, text=True)
        self.assertRegex(resumed.stdout.readline(), "left' continues at")
        resumed.stdout.readline()
        resumed.stdout.readline()
        self.assertGreater(int(resumed.stdout.readline().split()[0]), 1)
        resumed.kill()
        resumed.stdout.close()
        resumed.wait()

    def test_recordings_of_a_run_that_was_cut_are_one(self):
        record = self.directory / "run.jsonl"
        self.cut(IN_PYTHON, 0.5, RECORD=str(record))
        self.assertEqual(self.run_program(IN_PYTHON, RECORD=str(record)).returncode, 0)
        self.assertTrue((self.directory / "run.resumed-1.jsonl").exists())
        info = subprocess.run([os.environ["LOCKSTEP"], "log", "info", record], capture_output=True, text=True).stdout
        self.assertRegex(info, r"resumed after \d+\.\d s, from tick 5 on\n  success \(completed\) after 12 ticks, 1\.\d00 s")

    def test_an_end_in_order_is_no_cut(self):
        self.uncut(IN_C)
        self.assertEqual(len(self.uncut(IN_C)), 12)  # from the beginning

    def test_another_run_is_refused(self):
        self.cut(IN_C, 0.5)
        refused = lambda **more: self.run_program(IN_C, **more).stdout
        self.assertIn("the tick period was '0.1 s' and is '0.2 s'", refused(period=0.2))
        self.assertIn("the version of the program was nothing and is '2'", refused(KEPT_VERSION="2"))
        self.tree.write_text(TREE.replace("0.5", "0.6"))
        self.assertIn("the text of 'the main file' was", refused())
        self.tree.write_text(TREE)
        self.assertEqual(self.run_program(IN_C).returncode, 0)

    def test_a_file_that_cannot_be_used(self):
        self.file.mkdir()
        done = self.run_program(IN_C)
        self.assertEqual(done.returncode, 1)
        self.assertTrue(done.stdout.startswith("error: "), done.stdout)


unittest.main(argv=sys.argv[:1], verbosity=2)
