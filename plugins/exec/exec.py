#!/usr/bin/python3
"""Runs a command as a leaf: success is exit code 0, and progress comes from what it prints."""
import itertools
import os
import re
import shlex
import signal
import subprocess
import time
from collections import defaultdict, deque

from lockstep_leaf import Action, Output, Port, serve

# What a line of output may say of progress, and what the number is to be divided by.
PATTERNS = {"percent": (r"(\d+(?:\.\d+)?) ?%", 100), "fraction": (r"progress[ =:]+(\d*\.?\d+)", 1)}
LINES, LONGEST = 10, 400  # of the output that is kept for the case of a failure
GRACE = 0.5               # seconds between SIGTERM and SIGKILL


MARK = "LOCKSTEP_EXEC"    # in the environment of a command: whose it is
counter = itertools.count(1)


def read(pid, name):
    try:
        with open(f"/proc/{pid}/{name}", "rb") as file:
            return file.read()
    except OSError:
        return b""


def started_by(mark):
    """The processes of a command: those with its mark, and what these have started without it. Each comes before what it
    has started: a shell whose command is ended goes on with the next one."""
    pids = [int(name) for name in os.listdir("/proc") if name.isdigit() and int(name) != os.getpid()]
    found = {pid for pid in pids if mark.encode() in read(pid, "environ").split(b"\0")}
    parents = {pid: int(stat.rpartition(b")")[2].split()[1]) for pid in pids if (stat := read(pid, "stat"))}
    while more := {pid for pid, parent in parents.items() if parent in found and pid not in found}:
        found |= more
    children = defaultdict(list)
    for pid in found:
        children[parents.get(pid)].append(pid)  # of none: it ended meanwhile
    ordered = [pid for pid in found if parents.get(pid) not in found]
    for pid in ordered:
        ordered += children[pid]
    return ordered


def send(number, mark):
    "True if there was a process."
    pids = started_by(mark)
    for pid in pids:
        try:
            os.kill(pid, number)
        except OSError:
            pass
    return bool(pids)


class Exec(Action):
    """Runs a command, without a shell. Success is exit code 0; Failure logs the last lines of its output. With
    hold="signal" at the plugin, the command is stopped while others are waited for."""
    command: str = Port(doc="the program and its arguments, split as a shell would; {a} is the value of the port a")
    progress_from: str = Port("", doc="where a line of output has the progress: percent (37%), fraction "
                                      "(progress 0.37), or a regular expression with a group")
    shell: bool = Port(False, doc="true: /bin/sh runs the command; the values are $a to $d")
    a: str = Port("", doc="a value for the command, also in its environment")
    b: str = Port("", doc="as a")
    c: str = Port("", doc="as a")
    d: str = Port("", doc="as a")
    exit_code: Output[int]
    output: Output[str]

    real_time = True

    def start(self):
        self.done, self.rest, self.lines = 0.0, b"", deque(maxlen=LINES)
        pattern, self.whole = PATTERNS.get(self.progress_from, (self.progress_from, 1))
        self.pattern = re.compile(pattern) if pattern else None
        values = {name: getattr(self, name) for name in "abcd"}
        words = self.command
        if not self.shell:
            words = [re.sub(r"\{([abcd])\}", lambda it: values[it[1]], word) for word in shlex.split(words)]
            if not words:
                raise ValueError("the port 'command' is empty")
        self.mark = f"{MARK}={os.getpid()}.{next(counter)}"
        environment = os.environ | values | dict([self.mark.split("=")])
        self.process = subprocess.Popen(words, shell=self.shell, env=environment, bufsize=0,
                                        stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                        stderr=subprocess.STDOUT)
        os.set_blocking(self.process.stdout.fileno(), False)

    def tick(self):
        if self.clock == "virtual":
            time.sleep(self.period)  # the command works in real time
        code = self.process.poll()
        self.read()
        if code is None:
            return None
        self.exit_code, self.output = code, self.lines[-1] if self.lines else ""
        self.process.stdout.close()
        if code != 0:
            how = f"exit code {code}" if code > 0 else f"signal {signal.Signals(-code).name}"
            self.log(f"{how}: {self.command}", "warning")
            for line in self.lines:
                self.log("  " + line, "warning")
        return code == 0

    def read(self):
        while data := self.process.stdout.read(65536):
            *lines, self.rest = re.split(rb"[\r\n]+", self.rest + data)
            self.rest = self.rest[-LONGEST:]
            for line in lines:
                self.take(line.decode(errors="replace")[:LONGEST])

    def take(self, line):
        if line.strip():
            self.lines.append(line)
        found = self.pattern and self.pattern.search(line)
        if found:
            self.done = min(1.0, float(found[found.lastindex or 0]) / self.whole)

    def progress(self):
        return self.done

    def halt(self):
        send(signal.SIGTERM, self.mark)
        send(signal.SIGCONT, self.mark)
        end = time.monotonic() + GRACE
        while self.process.poll() is None and time.monotonic() < end:
            time.sleep(0.005)
        end = time.monotonic() + GRACE
        while send(signal.SIGKILL, self.mark) and time.monotonic() < end:
            time.sleep(0.001)  # what they started meanwhile
        self.process.wait()
        self.process.stdout.close()


serve(version="1.0", doc="Commands as leaves")
