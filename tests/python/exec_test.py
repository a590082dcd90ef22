#!/usr/bin/env python3
"""In which order the plugin exec.py ends the processes of a command, on a list of processes that the test makes.

    exec_test.py EXEC_PY
"""
import sys
import types
import unittest

EXEC = sys.argv.pop()


class Anything:
    def __class_getitem__(cls, _):
        return cls


def order(marked, parents):
    """The processes as they are ended: `marked` have the mark, `parents` are those that still have a line in /proc."""
    sys.modules["lockstep_leaf"] = types.SimpleNamespace(
        Action=object, Output=Anything, Port=lambda *_, **__: None, serve=lambda **_: None)
    names = {"__name__": "exec"}
    with open(EXEC, encoding="utf-8") as file:
        exec(compile(file.read(), EXEC, "exec"), names)
    pids = marked | parents.keys()
    names["os"] = types.SimpleNamespace(listdir=lambda _: [*map(str, pids), "self"], getpid=lambda: 1)

    def read(pid, name):
        if name == "environ":
            return b"A=1\0MARK=7\0" if pid in marked else b"A=1\0"
        return b"%d (a b) S %d 0" % (pid, parents[pid]) if pid in parents else b""
    names["read"] = read
    return names["started_by"]("MARK=7")


class Order(unittest.TestCase):
    def test_each_comes_before_what_it_has_started(self):
        self.assertEqual(order({30, 20, 40}, {30: 1, 20: 30, 40: 20, 50: 40, 60: 1}), [30, 20, 40, 50])

    def test_one_that_ends_meanwhile_does_not_save_the_others(self):
        self.assertEqual(set(order({30, 20, 60}, {30: 1, 20: 30})), {20, 30, 60})

    def test_a_chain_may_be_long(self):
        chain = range(100, 5100)
        self.assertEqual(order(set(chain), {pid: pid - 1 for pid in chain}), list(chain))


unittest.main()
