"""Servers and trees for the tests of plugins/ros2, as a user starts them."""

import csv
import os
import pathlib
import signal
import subprocess
import tempfile
import threading
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SERVERS = ROOT / "build/ros2/tests"
TREE_SERVER = ROOT / "build/ros2/installed/lib/lockstep_ros/tree_server"
LOCKSTEP = pathlib.Path(os.environ.get("LOCKSTEP", ROOT / "build/release/lockstep"))
PLUGINS = ROOT / "build/ros2/plugin"

TYPES = pathlib.Path(os.environ.get("AMENT_PREFIX_PATH", "").split(":")[-1]) / "share"


def has(package):
    return unittest.skipUnless((TYPES / package).exists(), f"there is no {package}")


def count(name, action, order=5, more=""):
    """A leaf that counts to `order` at the server of `action`."""
    return (f'<RosAction name="{name}" type="example_interfaces/action/Fibonacci" '
            f'action="{action}" goal.order="{order}" '
            f'progress="size(feedback.sequence) / goal.order" {more}/>')


class Server:
    """A program that has said that it is ready, if it does; `lines` is what it has said."""

    def __init__(self, program, *options, ready="ready"):
        self.lines = []
        self._heard = threading.Condition()
        self.process = subprocess.Popen([SERVERS / program, *map(str, options)], stdout=subprocess.PIPE,
                                        stderr=subprocess.DEVNULL, text=True)
        self._thread = threading.Thread(target=self._read, daemon=True)
        self._thread.start()
        if ready:
            self.wait_for(ready)

    def _read(self):
        with self.process.stdout as said:
            for line in said:
                with self._heard:
                    self.lines.append(line.strip())
                    self._heard.notify_all()

    def wait_for(self, line, seconds=10):
        with self._heard:
            if not self._heard.wait_for(lambda: line in self.lines, seconds):
                raise AssertionError(f"the server has not said {line!r}: {self.lines}")

    def stop(self, number=signal.SIGTERM):
        if self.process.poll() is not None:
            return
        self.process.send_signal(number)
        self.process.wait()
        self._thread.join()


class World(unittest.TestCase):
    plugins = ("ros2",)
    plugin_paths = (PLUGINS,)

    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.directory = pathlib.Path(directory.name)
        self.recording = self.directory / "run.jsonl"

    def server(self, *options, program="counting_server", **more):
        server = Server(program, *options, **more)
        self.addCleanup(server.stop)
        return server

    def command(self, verb, nodes, *options):
        tree = self.directory / "tree.xml"
        used = "".join(f'<plugin name="{name}"/>' for name in self.plugins)
        tree.write_text(f'<root lockstep="1">{used}<BehaviorTree ID="T">\n'
                        f"{nodes}\n</BehaviorTree></root>\n")
        paths = [word for path in self.plugin_paths for word in ("--plugin-path", path)]
        return [LOCKSTEP, verb, tree, *paths, *map(str, options)]

    def check(self, nodes):
        return subprocess.run(self.command("check", nodes), text=True, capture_output=True,
                              timeout=30)

    def start(self, nodes, *options):
        """A run that goes on; its messages are on stderr."""
        run = subprocess.Popen(
            self.command("run", nodes, "--record", self.recording, *options), text=True,
            stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.addCleanup(lambda: (run.kill(), run.communicate()) if run.poll() is None else None)
        return run

    def run_tree(self, nodes, *options, seconds=40):
        """The finished run."""
        run = self.start(nodes, *options)
        run.out, run.err = run.communicate(timeout=seconds)
        return run

    def rows(self, node):
        """The rows of `log csv` about this node."""
        text = subprocess.run([LOCKSTEP, "log", "csv", self.recording], text=True,
                              capture_output=True, check=True).stdout
        return [row for row in csv.DictReader(text.splitlines()) if row["path"].endswith(node)]

    def progress(self, node):
        return {int(row["tick"]): float(row["progress"]) for row in self.rows(node)}
