"""What the server says is wrong: what `lockstep check` says, for each text as it is in the editor."""
import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

from client import Client

SOURCE = Path(os.environ["SOURCE"])
SEVERITIES = {"error": 1, "warning": 2, "note": 3}


def utf16(text):
    return len(text.encode("utf-16-le")) // 2


def checked(path, *options):
    """What `check` says of a file: by file, a set."""
    run = subprocess.run([os.environ["LOCKSTEP"], "check", "--format", "json", *options, str(path)],
                         capture_output=True, check=False)
    found = {}
    for it in json.loads(run.stdout):
        file = it["file"] or str(path)
        lines = Path(file).read_bytes().removeprefix(b"\xef\xbb\xbf").split(b"\n")
        place = (0, 0)
        if it["line"]:
            before = lines[it["line"] - 1][:max(it["column"] - 1, 0)]
            place = (it["line"] - 1, utf16(before.decode("utf-8", "replace")))
        found.setdefault(file, set()).add(
            (*place, SEVERITIES[it["severity"]], it["message"], it["hint"]))
    return found


def said(diagnostics):
    found = set()
    for it in diagnostics:
        related = it.get("relatedInformation", [{"message": ""}])
        start = it["range"]["start"]
        found.add((start["line"], start["character"], it["severity"], it["message"],
                   related[0]["message"]))
    return found


class Diagnostics(unittest.TestCase):
    maxDiff = None

    def setUp(self):
        self.client = Client()
        self.client.start(SOURCE)

    def tearDown(self):
        self.assertEqual(self.client.stop(), 0)
        self.assertEqual(self.client.errors, "")

    def same_as_check(self, files):
        for path in files:
            try:
                path.read_text(encoding="utf-8")
            except UnicodeDecodeError:
                continue  # no editor can send it
            with self.subTest(path.name):
                expected = checked(path)
                self.assertEqual(said(self.client.open(path)), expected.pop(str(path), set()))
                for other, messages in expected.items():
                    if messages:
                        self.assertEqual(said(self.client.diagnostics(other, of=path)), messages)
                self.client.close(path)
                self.assertEqual(self.client.diagnostics(path), [])

    def test_bad_files(self):
        files = sorted((SOURCE / "tests/trees/bad").glob("*.xml"))
        self.assertGreater(len(files), 50)
        self.same_as_check(files)

    def test_good_files(self):
        files = sorted([*(SOURCE / "tests/trees/good").glob("*.xml"), *(SOURCE / "trees").glob("*.xml")])
        self.assertGreater(len(files), 20)
        self.same_as_check([it for it in files if not it.name.endswith((".test.xml", ".leaves.xml"))])

    def test_scenarios_and_leaf_files(self):
        files = [*(SOURCE / "trees").glob("*.test.xml"), *(SOURCE / "trees").glob("*.leaves.xml")]
        self.assertGreater(len(files), 5)
        for path in files:
            with self.subTest(path.name):
                self.assertEqual([], self.client.open(path))
        scenarios = SOURCE / "a.test.xml"
        found = self.client.open(scenarios, "<scenarios lockstep=\"1\"><scenario nam=\"a\"/></scenarios>")
        self.assertIn("unknown attribute 'nam' of 'scenario'", [it["message"] for it in found])
        leaves = SOURCE / "a.leaves.xml"
        found = self.client.open(leaves, "<leaves lockstep=\"1\">\n <fact name=\"a\" changes=\"nevr\"/></leaves>")
        self.assertEqual({"line": 1, "character": 25}, found[0]["range"]["start"])
        self.assertEqual("did you mean 'never'?", found[0]["relatedInformation"][0]["message"])

    def test_xml_of_other_programs(self):
        for text in ("<package format=\"3\"><name>a</name></package>",
                     "<?xml version=\"1.0\"?><svg><g/></svg>"):
            self.assertEqual([], self.client.open(SOURCE / "package.xml", text))
        for text in ("<rot lockstep=\"1\"/>", "<tree><BehaviorTree/></tree>"):
            self.assertIn("'root'", self.client.open(SOURCE / "b.xml", text)[0]["message"])

    def said_of(self, files):
        """What the server and `check` say of each of these texts, which are files of one folder."""
        with tempfile.TemporaryDirectory() as folder:
            for name, text in files.items():
                (Path(folder) / name).write_text(text)
            found = {}
            for name in files:
                path = Path(folder) / name
                found[name] = said(self.client.open(path))
                self.client.close(path)
            return found

    def worst(self, found):
        return min((severity for _, _, severity, _, _ in found), default=4)

    def test_a_model_that_is_older_than_the_tree_is_a_hint(self):
        tree = '''<root BTCPP_format="4"><BehaviorTree ID="T"><Sequence>
<Go goal="{goal}" speed="fast" done="{done}"/><See target="{t}"/></Sequence></BehaviorTree>
<TreeNodesModel>%s</TreeNodesModel></root>'''
        go = '<Action ID="Go"><input_port name="goal" type="%s"/>%s</Action>'
        see = '<Condition ID="See"><input_port name="target"/></Condition>'
        models = {
            "no port of this name": go % ("std::string", "") + see,
            "another type": go % ("std::string", '<input_port name="speed" type="double"/>') + see,
            "an input that is an output": go % ("int", '<input_port name="speed"/><output_port name="goal"/>') + see,
            "an output with a constant": go % ("int", '<output_port name="speed"/><input_port name="done"/>') + see,
            "another kind": '<Condition ID="Go"/><Control ID="See"/>',
            "a decorator": '<Decorator ID="Go"/><SubTree ID="See"/>',
            "a type that nobody knows": go % ("my::Pose", '<input_port name="speed" type="?"/>') + see,
            "one of two leaves": see,
        }
        for claim, model in models.items():
            with self.subTest(claim):
                found = self.said_of({"t.xml": tree % model})["t.xml"]
                self.assertGreaterEqual(self.worst(found), SEVERITIES["warning"], found)

    def test_parts_of_a_project_have_no_error_that_is_none(self):
        main = '<root %s><BehaviorTree ID="Main"><SubTree ID="Part" goal="1"/></BehaviorTree></root>'
        parts = '<root %s><BehaviorTree ID="Part">%s</BehaviorTree><BehaviorTree ID="B"><AlwaysFailure/></BehaviorTree></root>'
        deep = '<root %s><BehaviorTree ID="Deep"><AlwaysSuccess/></BehaviorTree></root>'
        theirs, ours, include = 'BTCPP_format="4"', 'lockstep="1"', '<include path="parts.xml"/><BehaviorTree ID="Main"'
        projects = {
            "none includes the other": {"main.xml": main % theirs, "deep.xml": deep % theirs,
                                        "parts.xml": parts % (theirs, '<SubTree ID="Deep"/>')},
            "the main file includes them": {"main.xml": main.replace('<BehaviorTree ID="Main"', include) % ours,
                                            "parts.xml": parts % (ours, "<AlwaysSuccess/>")},
            "two trees and no main tree": {"parts.xml": parts % (ours, "<AlwaysSuccess/>")},
            "models only": {"models.xml": f'<root {theirs}><TreeNodesModel><Action ID="Go"/></TreeNodesModel></root>'},
        }
        for claim, files in projects.items():
            for name, messages in self.said_of(files).items():
                with self.subTest(claim, file=name):
                    self.assertGreater(self.worst(messages), SEVERITIES["error"], messages)
        for root in [theirs, ours]:  # what is wrong in a part is an error as before
            found = self.said_of({"parts.xml": parts % (root, "<Sequence/>")})["parts.xml"]
            self.assertEqual(self.worst(found), SEVERITIES["error"])
        # A tree of this language includes what it needs.
        self.assertEqual(self.worst(self.said_of({"main.xml": main % ours})["main.xml"]), SEVERITIES["error"])

    def test_a_file_is_checked_again_when_another_one_has_what_it_lacks(self):
        root = '<root lockstep="1" main_tree_to_execute="Main">%s<BehaviorTree ID="Main">%s</BehaviorTree></root>'
        part = '<root lockstep="1"><BehaviorTree ID="%s"><Wait seconds="1"/></BehaviorTree></root>'
        uses = root % ('<include path="part.xml"/>', '<SubTree ID="Part"/>')
        with tempfile.TemporaryDirectory() as folder:
            main, other = Path(folder, "main.xml"), Path(folder, "part.xml")
            self.assertIn("part.xml", str(self.client.open(main, uses)))  # it is not there
            self.client.open(other, part % "Part")
            self.assertEqual(self.client.diagnostics(main), [])
            self.client.send_change(other, part % "Other")
            self.assertIn("unknown tree 'Part'", str(self.client.diagnostics(main)))
            self.client.send_change(other, part % "Part")
            self.assertEqual(self.client.diagnostics(main), [])
            self.client.close(other)
            self.assertIn("part.xml", str(self.client.diagnostics(main)))
            self.client.close(main)

    def test_hints_for_editors_without_related_information(self):
        client = Client()
        client.start(SOURCE, related=False)
        found = client.open(SOURCE / "a.xml", "<root lockstep=\"1\"><BehaviorTree ID=\"M\"><Wiat/></BehaviorTree></root>")
        self.assertEqual("unknown node 'Wiat'\nhint: did you mean 'Wait'?", found[0]["message"])
        self.assertEqual(0, client.stop())


if __name__ == "__main__":
    unittest.main()
