"""Plugins of the files that are open: loaded in other processes, watched, and left alone without trust."""
import os
import shutil
import stat
import subprocess
import tempfile
import unittest
from pathlib import Path

from client import Client, edited, place

PLUGINS = Path(os.environ["BUILD"]) / "plugins"
TREE = """<root lockstep="1">
  <plugin name="NAME"/>
  <BehaviorTree ID="Main"><Advance step="0.5"/></BehaviorTree>
</root>
"""


class Plugins(unittest.TestCase):
    def setUp(self):
        self.directory = tempfile.TemporaryDirectory()
        self.root = Path(self.directory.name)
        self.path = self.root / "tree.xml"
        self.plugins = self.root / "plugins"
        self.plugins.mkdir()

    def tearDown(self):
        self.directory.cleanup()

    def session(self, *options, **settings):
        client = Client("--plugin-path", str(self.plugins), *options,
                        environment={"LOCKSTEP_PLUGIN_PATH": ""})
        client.start(self.root, **settings)
        def end():
            client.process.stdin.close()
            client.process.wait(timeout=60)
            client.process.stdout.close()
        self.addCleanup(end)
        return client

    @staticmethod
    def messages(diagnostics):
        return [it["message"] for it in diagnostics]

    def compile(self, name, source):
        file = self.root / "plugin.c"
        file.write_text(source)
        subprocess.run(["cc", "-shared", "-fPIC", "-o", self.plugins / f"{name}.so", file], check=True)

    def children(self, client):
        pid = client.process.pid
        tasks = Path(f"/proc/{pid}/task").iterdir()
        return [child for task in tasks for child in (task / "children").read_text().split()]

    def test_a_plugin_that_crashes(self):
        self.compile("bad", "#include <stdlib.h>\n__attribute__((constructor)) void f(void) { abort(); }")
        client = self.session()
        found = self.messages(client.open(self.path, TREE.replace("NAME", "bad")))
        self.assertIn("cannot be loaded", found[0])
        shutil.copy(PLUGINS / "motion.so", self.plugins)
        self.assertEqual([], client.change(self.path, TREE.replace("NAME", "motion")))
        self.assertEqual(0, client.stop())

    def test_a_plugin_that_hangs_and_prints(self):
        self.compile("slow", "#include <stdio.h>\n__attribute__((constructor)) void f(void) {\n"
                     "puts(\"Content-Length: 3\\r\\n\\r\\n\"); fflush(stdout); for (;;) {} }")
        client = self.session("--hang-limit", "0.2")
        found = self.messages(client.open(self.path, TREE.replace("NAME", "slow")))
        self.assertIn("cannot be loaded", found[0])
        self.assertEqual(0, client.stop())

    def test_a_request_that_waits_for_a_plugin_is_cancelled(self):
        self.compile("slow", "__attribute__((constructor)) void f(void) { for (;;) {} }")
        client = self.session("--hang-limit", "1")
        client.notify("textDocument/didOpen", {"textDocument": {
            "uri": self.path.as_uri(), "languageId": "xml", "version": 1, "text": TREE.replace("NAME", "slow")}})
        number = client.send("textDocument/codeLens", {"textDocument": {"uri": self.path.as_uri()}})
        # What needs no plugin is answered meanwhile.
        client.ask("textDocument/codeLens", {"textDocument": {"uri": "file:///none"}})
        client.notify("$/cancelRequest", {"id": number})
        self.assertEqual(-32800, client.answer(number)["error"]["code"])
        self.assertEqual(0, client.stop())

    def test_a_plugin_that_changes(self):
        client = self.session()
        text = TREE.replace("NAME", "mine")
        found = client.open(self.path, text)
        self.assertIn("not found", found[0]["message"])
        shutil.copy(PLUGINS / "motion.so", self.plugins / "mine.so")
        client.notify("workspace/didChangeWatchedFiles", {"changes": []})
        self.assertIn("calls itself 'motion'", client.diagnostics(self.path)[0]["message"])
        (self.plugins / "mine.so").unlink()
        self.assertEqual(found, client.change(self.path, text))
        self.assertEqual(0, client.stop())

    def test_it_lives_in_another_process(self):
        shutil.copy(PLUGINS / "motion.so", self.plugins)
        client = self.session()
        self.assertEqual([], client.open(self.path, TREE.replace("NAME", "motion")))
        maps = Path(f"/proc/{client.process.pid}/maps").read_text()
        self.assertNotIn("motion.so", maps)
        self.assertEqual(1, len(self.children(client)))
        # Another file with the same plugins needs no other process, nor does another text.
        client.open(self.root / "other.xml", TREE.replace("NAME", "motion"))
        client.change(self.path, TREE.replace("NAME", "motion").replace("0.5", "0.25"))
        self.assertEqual(1, len(self.children(client)))
        self.assertEqual(0, client.stop())

    def test_ports_that_an_element_decides(self):
        here = Path(__file__).resolve().parents[1]
        subprocess.run(["cc", "-shared", "-fPIC", "-I", here.parent / "plugins/sdk", "-o",
                        self.plugins / "shapes.so", here / "abi/plugins/shapes.c"], check=True)
        client = self.session()
        def tree(leaf):
            return TREE.replace("NAME", "shapes").replace('<Advance step="0.5"/>', leaf)
        def at(leaf, method):
            text = tree(leaf)
            line = next(i for i, it in enumerate(text.split("\n")) if "|" in it)
            column = text.split("\n")[line].index("|")
            client.change(self.path, text.replace("|", ""))
            return client.at(method, self.path, line, column)
        wrong = client.open(self.path, tree('<Shape kind="round" size.side="1"/>'))
        self.assertIn("'Shape' has no parameter 'size.side'", self.messages(wrong))
        offered = [it["label"] for it in
                   at('<Shape kind="square" |/>', "textDocument/completion")["items"]]
        self.assertIn("size.side", offered)
        self.assertNotIn("size.radius", offered)
        hover = at('<Shape kind="round" size.ra|dius="1"/>', "textDocument/hover")
        self.assertIn("how large it is", hover["contents"]["value"])
        self.assertEqual(0, client.stop())

    def test_a_workspace_without_trust(self):
        shutil.copy(PLUGINS / "motion.so", self.plugins)
        client = self.session(trusted=False)
        text = TREE.replace("NAME", "motion")
        expected = ["the plugin is not loaded: the workspace is not trusted"]
        self.assertEqual(expected, self.messages(client.open(self.path, text)))
        self.assertEqual([], self.children(client))
        said = [it for it in client.kept if it.get("method") == "window/showMessage"]
        self.assertEqual(1, len(said))
        self.assertEqual(expected, self.messages(client.change(self.path, text + "\n")))
        said = [it for it in client.kept if it.get("method") == "window/showMessage"]
        self.assertEqual(1, len(said))
        # The user trusts it.
        client.notify("workspace/didChangeConfiguration", {"settings": {"lockstep": {"trusted": True}}})
        self.assertEqual([], client.diagnostics(self.path))
        self.assertEqual(0, client.stop())

    def test_settings_of_the_editor(self):
        other = self.root / "mine"
        other.mkdir()
        shutil.copy(PLUGINS / "motion.so", other)
        text = TREE.replace("  <plugin name=\"NAME\"/>\n", "  <arg name=\"pace\"/>\n").replace("0.5", "${pace}")
        client = self.session(pluginPath=["mine"], plugins=["motion"], arguments={"pace": "0.25"})
        self.assertEqual([], client.open(self.path, text))
        self.assertEqual(0, client.stop())

    def test_a_plugin_that_is_a_program(self):
        program = self.plugins / "exec.py"
        started = self.root / "started"
        program.write_text(f"#!/bin/sh\necho >{started}\n")
        program.chmod(program.stat().st_mode | stat.S_IXUSR)
        shutil.copy(PLUGINS / "exec.leaves.json", self.plugins)
        client = self.session()
        text = TREE.replace("name=\"NAME\"", "name=\"exec\" program=\"exec.py\"").replace("Advance step=\"0.5\"", "Exc")
        client.open(self.path, text)
        found = client.known[self.path.as_uri()]
        self.assertIn("unknown node 'Exc'", self.messages(found))
        self.assertFalse(started.exists())
        self.assertEqual(0, client.stop())

    def test_completion_of_programs(self):
        for name, mode in (("exec.py", 0o755), ("plain.py", 0o644), ("tool", 0o755)):
            (self.plugins / name).write_text("#!/bin/sh\n")
            (self.plugins / name).chmod(mode)
        for name in ("exec", "plain"):
            shutil.copy(PLUGINS / "exec.leaves.json", self.plugins / f"{name}.leaves.json")
        client = self.session()

        def completed(plugin):
            """The texts by their labels, with that element for the plugin."""
            before, cursor, after = TREE.replace('plugin name="NAME"/', plugin).partition("|")
            text = before + after
            (client.change if self.path in client.versions else client.open)(self.path, text)
            items = client.at("textDocument/completion", self.path, *place(text, len(before)))["items"]
            return {it["label"]: edited(text, [it["textEdit"]]) for it in items if "ec" in it["label"] or "." in it["label"]
                    or it["label"] in ("plain", "tool")}
        whole = TREE.replace('name="NAME"', 'name="exec" program="exec.py"')
        self.assertEqual({"exec": whole}, completed('plugin name="|"/'))
        self.assertEqual({"exec": whole}, completed('plugin name="ex|e"/'))
        self.assertEqual({"exec": whole.replace('"exec" program="exec.py"', "'exec' program='exec.py'")}, completed("plugin name='|'/"))
        self.assertEqual({"exec": whole}, completed('plugin name="|" program="exec.py"/'))
        self.assertEqual({"exec.py": whole}, completed('plugin name="exec" program="|"/'))
        self.assertEqual([], [it for it in client.open(self.path, whole) if "exec" in it["message"] and it["severity"] == 1])
        self.assertEqual(0, client.stop())


if __name__ == "__main__":
    unittest.main()
