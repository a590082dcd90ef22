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


def text_of_warnings(between):
    """Each node reads an entry that nothing makes."""
    nodes = [f'<ScriptCondition code="k{i} == 1"/>' for i in range(4 * NODES)]
    return between.join(['<root BTCPP_format="4">', '<BehaviorTree ID="M">', "<Sequence>", *nodes,
                         "</Sequence></BehaviorTree></root>"])


class LongLine(unittest.TestCase):
    @staticmethod
    def opened(directory, tree):
        """A client, and the path of the text."""
        client, path = Client("--no-plugins"), Path(directory) / "tree.xml"
        client.start(directory)
        client.versions[path] = 1
        client.notify("textDocument/didOpen", {"textDocument": {
            "uri": path.as_uri(), "languageId": "xml", "version": 1, "text": tree}})
        client.at("textDocument/hover", path, 0, 3)
        return client, path

    @staticmethod
    def position_of(tree, part):
        at = tree.index(part) + 1
        return tree[:at].count("\n"), at - tree.rfind("\n", 0, at) - 1

    def seconds(self, between):
        """Of the processor, for each request."""
        with tempfile.TemporaryDirectory() as directory:
            tree = text(between)
            client, path = self.opened(directory, tree)
            position = self.position_of(tree, "{x}")
            used = {}
            for method in ABOUT:
                before = self.used(client)
                client.at("textDocument/" + method, path, *position, newName="y", context={"includeDeclaration": True},
                          range=client.range((0, 0), (10 * NODES, 0)), options={"tabSize": 2, "insertSpaces": True})
                used[method] = self.used(client) - before
            client.stop()
            return used

    def seconds_of_actions(self, between):
        """Of the processor, for the actions at one node: those that a user asks for, and those that an editor does."""
        with tempfile.TemporaryDirectory() as directory:
            tree = text_of_warnings(between)
            client, path = self.opened(directory, tree)
            position = self.position_of(tree, f"<ScriptCondition code=\"k{2 * NODES} ")
            used = {}
            for trigger in (1, 2):
                before = self.used(client)
                actions = client.ask("textDocument/codeAction", {
                    "textDocument": {"uri": path.as_uri()}, "range": client.range(position, position),
                    "context": {"diagnostics": [], "triggerKind": trigger}})
                used[trigger] = self.used(client) - before
                self.assertEqual("Wrap in Inverter" in [it["title"] for it in actions], trigger == 1)
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

    def test_actions_at_a_node_cost_the_same_in_one_line(self):
        many, one = self.seconds_of_actions("\n"), self.seconds_of_actions(" ")
        for trigger in many:
            with self.subTest(trigger=trigger):
                self.assertLess(one[trigger], max(1, 5 * many[trigger]))


if __name__ == "__main__":
    unittest.main()
