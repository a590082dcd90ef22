"Values of ports that are long, to process plugins and from them: docs/programs.md."
import os
import pathlib
import tempfile
import unittest

import lockstep

PROGRAM = """#!/usr/bin/python3
from lockstep_leaf import Action, Output, serve

class Make(Action):
    "Sets a text of so many characters."
    size: int
    text: Output[str]

    def tick(self):
        self.text = "x" * self.size
        return True

class Take(Action):
    "Needs texts of so many characters together."
    size: int
    text: str
    more: str = ""

    def tick(self):
        return len(self.text) + len(self.more) == self.size

serve()
"""


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


if __name__ == "__main__":
    unittest.main()
