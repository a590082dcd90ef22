"Values of ports that are long, to process plugins and from them: docs/programs.md."
import os
import pathlib
import tempfile
import unittest

import lockstep

PROGRAM = """#!/usr/bin/python3
from lockstep_leaf import Action, Fixed, Output, serve

class Make(Action):
    "Sets a text of so many letters."
    size: int
    letter: str = "x"
    text: Output[str]

    def tick(self):
        self.text = self.letter * self.size
        return True

class Take(Action):
    "Needs texts of so many characters together."
    size: int
    text: str
    more: str = ""

    def tick(self):
        return len(self.text) + len(self.more) == self.size

class Keep(Action):
    "Keeps more than a line can have."
    def tick(self):
        return None

    def save(self):
        return "x" * 2_000_000

    def restore(self, kept, cut):
        return True

class Shape(Action):
    "Has a port by pattern."
    more_ports = ["x.*"]
    one: Fixed[str]
    two: Fixed[str]

    @classmethod
    def describe(cls, one, two):
        return {"x.a": (int, len(one + two))}

    def tick(self):
        return True

serve()
"""
MIB = 1 << 20


class LongLines(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        program = pathlib.Path(self.folder.name, "long.py")
        program.write_text(PROGRAM)
        program.chmod(0o755)

    def run_tree(self, nodes, **options):
        file = os.path.join(self.folder.name, "tree.xml")
        pathlib.Path(file).write_text(
            f'<root lockstep="1"><plugin name="long" program="long.py"/>'
            f'<BehaviorTree ID="Main">{nodes}</BehaviorTree></root>')
        return lockstep.run(file, plugin_path=self.folder.name, max_ticks=1000, **options)

    def test_a_text_that_no_pipe_holds_comes_through_on_both_clocks(self):
        for size in (300_000, 1_000_000):
            nodes = (f'<Repeat times="3"><Sequence memory="true"><Make size="{size}" text="{{t}}"/>'
                     f'<Take size="{size}" text="{{t}}"/></Sequence></Repeat>')
            for clock in ("virtual", "wall"):
                self.assertEqual(self.run_tree(nodes, clock=clock).result, "success")

    def test_letters_that_are_not_ascii_have_their_size_in_utf_8(self):
        nodes = '<Sequence memory="true"><Make size="500000" letter="é" text="{t}"/><Take size="500000" text="{t}"/></Sequence>'
        self.assertEqual(self.run_tree(nodes).result, "success")

    def test_the_longest_line_to_a_program(self):
        def take(one, other):
            return f'<Take size="{one + other}" text="{"x" * one}" more="{"y" * other}"/>'
        line = len('{"do":"start","leaf":1,"now":0,"ports":{"size":1000000,"text":"","more":""}}')
        self.assertEqual(self.run_tree(take(600_000, MIB - line - 600_000)).result, "success")
        with self.assertRaisesRegex(lockstep.Error, "the leaf 'Main/Take' .* the port 'more' of 600002 bytes as JSON does "
                                                    "not fit a line to its program, which has at most 1 MiB"):
            self.run_tree(take(MIB - line - 599_999, 600_000))
        # The program is there, and its other leaves go on.
        for clock in ("virtual", "wall"):
            nodes = f'<Fallback memory="true">{take(600_000, 600_000)}<Take size="1" text="x"/></Fallback>'
            self.assertEqual(self.run_tree(nodes, on_fault="fail", clock=clock).result, "success")

    def test_the_longest_line_of_a_leaf_in_python(self):
        for clock in ("virtual", "wall"):
            with self.assertRaisesRegex(lockstep.Error, "ValueError: the port 'text' of 2000002 bytes as JSON does not fit a "
                                                        "line to lockstep, which has at most 1 MiB"):
                self.run_tree('<Make size="2000000" text="{t}"/>', clock=clock)
            nodes = ('<Fallback memory="true"><Make size="2000000" text="{t}"/><Sequence memory="true">'
                     '<Make size="1" text="{t}"/><Take size="1" text="{t}"/></Sequence></Fallback>')
            self.assertEqual(self.run_tree(nodes, on_fault="fail", clock=clock).result, "success")
        with self.assertRaisesRegex(lockstep.Error, "ValueError: what save has returned of 2000006 bytes as JSON does not fit"):
            self.run_tree("<Keep/>")

    def test_what_is_described_has_a_line_too(self):
        with self.assertRaisesRegex(lockstep.Error, "'Shape' cannot be described: its program reads lines of at most 1 MiB, and "
                                                    "the request has 12000[0-9][0-9] bytes"):
            self.run_tree(f'<Shape one="{"x" * 600_000}" two="{"x" * 600_000}"/>')

    def test_many_long_lines_at_once(self):
        takes = '<Take size="1000000" text="{t}"/>' * 12
        nodes = f'<Sequence memory="true"><Make size="1000000" text="{{t}}"/><Parallel>{takes}</Parallel></Sequence>'
        for clock in ("virtual", "wall"):
            self.assertEqual(self.run_tree(nodes, clock=clock).result, "success")


if __name__ == "__main__":
    unittest.main()
