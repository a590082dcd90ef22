"""Robots of a team as processes: what they print is waited for, and never a time."""
import os
import re
import signal
import subprocess
import tempfile
import threading
import time

PATIENCE = 60  # s; only a failure takes so long
started = []  # processes, of which none may be left
every = []  # robot of this test


class Robot:
    def __init__(self, command, record):
        """`command` runs a tree; it is recorded in the file `record`."""
        self.record, self.text, self.place = record, "", 0
        self.zero = float("inf")  # the time 0 of its run, on the clock of this machine
        self.changed, self.is_over = threading.Condition(), False
        self.process = subprocess.Popen([*command, "--record", record, "--view", "plain", "--stall", "0"],
                                        stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        started.append(self.process)
        every.append(self)
        threading.Thread(target=self.read, daemon=True).start()

    def read(self):
        while piece := os.read(self.process.stderr.fileno(), 65536):
            now = time.monotonic()
            with self.changed:
                self.text += piece.decode()
                # A line is read after its time. Of many lines, the one that was read soonest counts.
                for at in re.findall(r"^ *(\d+\.\d+) s  tick", piece.decode(), re.MULTILINE):
                    self.zero = min(self.zero, now - float(at))
                self.changed.notify_all()
        with self.changed:
            self.is_over = True
            self.changed.notify_all()

    def wait_for(self, pattern):
        """The first match in what it prints after the last one."""
        with self.changed:
            self.changed.wait_for(lambda: self.is_over or re.compile(pattern).search(self.text, self.place), PATIENCE)
            found = re.compile(pattern).search(self.text, self.place)
            assert found, f"no {pattern!r} behind character {self.place} of {self.record}"
            self.place = found.end()
        return found

    def end(self):
        """Its exit code."""
        with self.changed:
            assert self.changed.wait_for(lambda: self.is_over, PATIENCE), f"{self.record} does not end"
        return self.process.wait(PATIENCE)

    def succeeds(self):
        assert self.end() == 0, self.record

    def kill(self, signal_number=signal.SIGKILL):
        self.process.send_signal(signal_number)
        if signal_number == signal.SIGKILL:
            self.process.wait()


def memory_of(process):
    """In KiB."""
    with open(f"/proc/{process.pid}/status", encoding="utf-8") as lines:
        return next(int(line.split()[1]) for line in lines if line.startswith("VmRSS"))


def run_tests(tests):
    """Each function in `tests` whose name begins with test_, with a folder that is removed."""
    for name, test in list(tests.items()):
        if name.startswith("test_"):
            began = time.monotonic()
            print(name, end=" ", flush=True)
            with tempfile.TemporaryDirectory() as folder:
                try:
                    test(folder)
                except AssertionError:
                    for robot in every:
                        print(f"\n--- {' '.join(robot.process.args)}\n{robot.text}")
                    raise
                finally:
                    for process in started:
                        process.kill()
                        process.wait()
                    started.clear()
                    every.clear()
            print(f"{time.monotonic() - began:.1f} s", flush=True)
