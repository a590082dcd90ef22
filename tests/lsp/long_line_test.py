"""A tree whose text is one line, as XML libraries write it, costs about what it costs in many lines."""
import os
import tempfile
import unittest
from pathlib import Path

from client import Client

NODES = 5000
ABOUT = ["foldingRange", "documentSymbol", "inlayHint", "formatting", "references", "definition", "rename"]


def text(between):
    nodes = [f'<Script code="x := {i}"/>{between}<Wait name="n{i}" seconds="{{x}}"/>' for i in range(NODES)]
    return between.join(['<root lockstep="1">', '<BehaviorTree ID="M">', "<Sequence>", *nodes,
                         "</Sequence></BehaviorTree></root>"])


class LongLine(unittest.TestCase):
    def seconds(self, between):
        """Of the processor, for each request."""
        with tempfile.TemporaryDirectory() as directory:
            client, path, tree = Client("--no-plugins"), Path(directory) / "tree.xml", text(between)
            client.start(directory)
            client.versions[path] = 1
            client.notify("textDocument/didOpen", {"textDocument": {
                "uri": path.as_uri(), "languageId": "xml", "version": 1, "text": tree}})
            client.at("textDocument/hover", path, 0, 3)
            at = tree.index("{x}") + 1
            line = tree[:at].count("\n")
            position = (line, at - tree.rfind("\n", 0, at) - 1)
            used = {}
            for method in ABOUT:
                before = self.used(client)
                client.at("textDocument/" + method, path, *position, newName="y", context={"includeDeclaration": True},
                          range=client.range((0, 0), (10 * NODES, 0)), options={"tabSize": 2, "insertSpaces": True})
                used[method] = self.used(client) - before
            client.stop()
            return used

    @staticmethod
    def used(client):
        fields = Path(f"/proc/{client.process.pid}/stat").read_text().rsplit(")", 1)[1].split()
        return sum(map(int, fields[11:13])) / os.sysconf("SC_CLK_TCK")

    def test_one_line_costs_what_many_cost(self):
        many, one = self.seconds("\n"), self.seconds(" ")
        for method in ABOUT:
            with self.subTest(method=method):
                self.assertLess(one[method], max(1, 10 * many[method]))


if __name__ == "__main__":
    unittest.main()
