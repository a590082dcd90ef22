"""Groot2 sees that a program of its own, over the headers for BehaviorTree.CPP, halts its tree."""

import json
import pathlib
import socket
import subprocess
import sys
import unittest

PROGRAM = sys.argv.pop(1)
CLIENT = pathlib.Path(__file__).with_name("client.py")
RUNNING, SUCCESS, WAS = 1, 2, 10  # idle, and what it was


def free_port():
    """One whose next is free, too: that is for events."""
    while True:
        with socket.socket() as first, socket.socket() as second:
            first.bind(("127.0.0.1", 0))
            port = first.getsockname()[1]
            try:
                second.bind(("127.0.0.1", port + 1))
            except OSError:
                continue
            return port


class Program(unittest.TestCase):
    def setUp(self):
        self.port = free_port()
        self.program = subprocess.Popen([PROGRAM, str(self.port)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.addCleanup(self.program.communicate)

    def said(self):
        return self.program.stdout.readline().strip()

    def go_on(self):
        self.program.stdin.write("\n")
        self.program.stdin.flush()

    def statuses(self):
        answer = subprocess.run([sys.executable, CLIENT, str(self.port), "S"], capture_output=True, text=True, check=True)
        return [status for _, status in json.loads(answer.stdout)["value"]]

    def test_halted(self):
        self.assertEqual(self.said(), "RUNNING")
        self.assertEqual(self.statuses(), [RUNNING, SUCCESS, RUNNING])
        self.go_on()
        self.assertEqual(self.said(), "IDLE")
        self.assertEqual(self.statuses(), [WAS + RUNNING, WAS + SUCCESS, WAS + RUNNING])
        self.go_on()
        self.assertEqual(self.program.wait(20), 0)


unittest.main()
