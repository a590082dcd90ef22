"""Sessions: how they begin and end, and what comes of messages that are no good ones."""
import json
import os
import random
import tempfile
import unittest
from pathlib import Path

from client import Client

SOURCE = Path(os.environ["SOURCE"])
TREE = """<root lockstep="1">
  <BehaviorTree ID="Main">
    <Wait seconds="1"/>
  </BehaviorTree>
</root>
"""


class Protocol(unittest.TestCase):
    def setUp(self):
        self.client = Client()
        self.directory = tempfile.TemporaryDirectory()
        self.path = Path(self.directory.name) / "a tree, ü.xml"

    def tearDown(self):
        process = self.client.process
        process.stdin.close()
        process.wait(timeout=60)
        process.stdout.close()
        self.directory.cleanup()

    def ends(self):
        self.client.process.stdin.close()
        return self.client.process.wait(timeout=60)

    def refused(self, method, params=None):
        return self.client.answer(self.client.send(method, params))["error"]

    def test_a_session(self):
        answer = self.client.start(self.directory.name)
        self.assertEqual("utf-16", answer["capabilities"]["positionEncoding"])
        self.assertEqual("lockstep", answer["serverInfo"]["name"])
        self.assertEqual([], self.client.open(self.path, TREE))
        self.assertEqual(0, self.client.stop())
        self.assertEqual("", self.client.errors)

    def test_the_client_vanishes(self):
        self.client.start()
        self.assertEqual(1, self.ends())

    def test_a_file_is_closed_before_its_answer(self):
        self.client.start(self.directory.name)
        uri = {"textDocument": {"uri": self.path.as_uri()}}
        document = {**uri["textDocument"], "languageId": "xml", "version": 1, "text": TREE}
        self.client.write({"method": "textDocument/didOpen", "params": {"textDocument": document}},
                          {"id": 100, "method": "textDocument/codeLens", "params": uri},
                          {"method": "textDocument/didClose", "params": uri})
        self.client.answer(100)
        self.assertEqual(0, self.client.stop())

    def test_all_at_once(self):
        self.client.write({"id": 1, "method": "initialize", "params": {"capabilities": {}}},
                          {"id": 2, "method": "shutdown"}, {"method": "exit"})
        self.assertEqual(0, self.ends())

    def test_exit_without_shutdown(self):
        self.client.start()
        self.client.notify("exit")
        self.assertEqual(1, self.client.process.wait(timeout=60))

    def test_it_vanishes_after_shutdown(self):
        self.client.start()
        self.client.ask("shutdown")
        self.assertEqual(0, self.ends())

    def test_order(self):
        self.assertEqual(-32002, self.refused("textDocument/hover", {})["code"])
        self.client.notify("textDocument/didOpen", {})  # nobody listens so far
        self.client.start()
        self.assertEqual(-32602, self.refused("initialize", {"capabilities": {}})["code"])
        self.client.ask("shutdown")
        self.assertEqual(-32600, self.refused("textDocument/hover", {})["code"])

    def test_what_is_no_message(self):
        self.client.start(self.directory.name)
        def code(body):
            self.client.raw(b"Content-Length: %d\r\n\r\n%b" % (len(body), body))
            return self.client.wait(lambda it: "error" in it)["error"]["code"]
        self.assertEqual(-32700, code(b"{"))
        self.assertEqual(-32700, code(b""))
        self.assertEqual(-32700, code(b"\xff\xfe"))
        self.assertIn(code(b"[]"), (-32700, -32600))
        self.assertEqual(-32600, code(b"{}"))
        self.assertEqual(-32600, code(b'{"id": [1], "method": "x"}'))
        self.assertEqual(-32601, self.refused("textDocument/unheard")["code"])
        self.assertEqual(-32602, self.refused("textDocument/hover", {"textDocument": 3})["code"])
        self.assertEqual(-32602, self.refused("textDocument/hover", {
            "textDocument": {"uri": "a"}, "position": {"line": -1, "character": 0}})["code"])
        deep = b'{"id": 1, "method": "x", "params": ' + b"[" * 10000 + b"]" * 10000 + b"}"
        self.assertIn(code(deep), (-32700, -32600, -32601))
        # Notifications have no answers; the server goes on.
        self.client.notify("$/unheard", {"a": 1})
        self.client.notify("textDocument/didChange", {"textDocument": {"uri": "file:///none"}})
        self.client.notify("textDocument/didOpen", {})
        self.client.write({"id": 99, "result": None})
        self.assertEqual([], self.client.open(self.path, TREE))
        self.assertEqual(0, self.client.stop())

    def test_bad_frames(self):
        for frame in (b"hello\r\n\r\n", b"Content-Length: x\r\n\r\n", b"Content-Type: a\r\n\r\n{}",
                      b"Content-Length: 99999999999999999999\r\n\r\n", b"Content-Length: -1\r\n\r\n",
                      b"x" * 5000):
            with self.subTest(frame[:30]):
                client = Client()
                client.raw(frame)
                self.assertEqual(2, client.process.wait(timeout=60))
                self.assertIn("lockstep: error: ", client.errors)
                for file in (client.process.stdin, client.process.stdout):
                    file.close()

    def test_frames_in_pieces(self):
        body = json.dumps({"jsonrpc": "2.0", "id": "one", "method": "initialize",
                           "params": {"capabilities": {}, "rootUri": None}}).encode()
        data = b"content-length:%d\r\nContent-Type: application/json\r\n\r\n%b" % (len(body), body)
        for i in range(len(data)):
            self.client.raw(data[i:i + 1])
        self.assertEqual("one", self.client.read()["id"])

    def test_positions_outside_of_the_text(self):
        self.client.start(self.directory.name)
        self.client.open(self.path, TREE)
        for line, character in ((0, 10**6), (10**6, 0), (2**31 - 1, 2**31 - 1)):
            for method in ("hover", "definition", "completion", "references"):
                self.client.at("textDocument/" + method, self.path, line, character)
        self.client.change(self.path, ((10**6, 0), (10**7, 0), "<"), ((3, 5), (1, 1), "x"))
        self.client.change(self.path, TREE)
        self.assertEqual(0, self.client.stop())

    def test_columns_are_in_utf_16(self):
        self.client.start(self.directory.name)
        text = TREE.replace("<Wait ", "<Wait name=\"\U0001F600ü\" secnds=\"1\" ")
        message = self.client.open(self.path, text)[0]
        self.assertEqual({"line": 2, "character": 21}, message["range"]["start"])
        self.assertEqual({"line": 2, "character": 27}, message["range"]["end"])
        fixed = self.client.change(self.path, ((2, 21), (2, 32), ""))
        self.assertEqual([], fixed)

    def test_a_file_with_a_byte_order_mark(self):
        self.client.start(self.directory.name)
        message = self.client.open(self.path, "\ufeff<root lockstep=\"1\"><x/></root>")[-1]
        self.assertEqual({"line": 0, "character": 20}, message["range"]["start"])

    def test_line_ends(self):
        self.client.start(self.directory.name)
        for end in ("\n", "\r\n", "\r"):
            text = TREE.replace("Wait", "Wiat").replace("\n", end)
            (self.client.change if end != "\n" else self.client.open)(self.path, text)
            message = self.client.known[self.path.as_uri()][0]
            self.assertEqual({"line": 2, "character": 4}, message["range"]["start"])

    def test_a_cancelled_request(self):
        self.client.start(self.directory.name)
        self.client.open(self.path, TREE)
        hover = {"textDocument": {"uri": self.path.as_uri()}, "position": {"line": 2, "character": 6}}
        self.client.write(*[{"id": i, "method": "textDocument/hover", "params": hover} for i in (101, 102)],
                          {"method": "$/cancelRequest", "params": {"id": 102}})
        self.assertIn("result", self.client.answer(101))
        self.assertEqual(-32800, self.client.answer(102)["error"]["code"])
        self.client.notify("$/cancelRequest", {"id": 101})  # it is over
        self.client.notify("$/cancelRequest", {"id": "none"})
        self.assertEqual(0, self.client.stop())

    def test_a_cancelled_request_that_waits_for_a_check(self):
        self.client.start(self.directory.name)
        self.client.notify("textDocument/didOpen", {"textDocument": {
            "uri": self.path.as_uri(), "languageId": "xml", "version": 1, "text": TREE}})
        params = {"textDocument": {"uri": self.path.as_uri()}}
        self.client.write({"id": 7, "method": "textDocument/codeLens", "params": params},
                          {"method": "$/cancelRequest", "params": {"id": 7}})
        self.assertEqual(-32800, self.client.answer(7)["error"]["code"])

    def test_two_files_of_one_name(self):
        self.client.start(self.directory.name)
        self.path.write_text(TREE)
        self.client.open(self.path)
        self.client.notify("textDocument/didOpen", {"textDocument": {
            "uri": self.path.as_uri().replace("%20", " "), "languageId": "xml", "version": 1, "text": "<"}})
        self.assertEqual([], self.client.diagnostics(self.path))
        self.client.close(self.path)
        self.client.close(self.path)
        self.assertEqual(0, self.client.stop())

    def test_a_text_without_a_file(self):
        self.client.start()
        for uri in ("untitled:Untitled-1", "git:/a/b.xml?c", "", "file://", "file:///%zz%"):
            self.client.notify("textDocument/didOpen", {"textDocument": {
                "uri": uri, "languageId": "xml", "version": 1, "text": TREE.replace("Wait", "Wiat")}})
            message = self.client.wait(lambda it: it.get("params", {}).get("uri") == uri)
            self.assertEqual("unknown node 'Wiat'", message["params"]["diagnostics"][0]["message"])
        self.assertEqual(0, self.client.stop())

    def test_random_edits(self):
        """No edit ends the server, and the text is the same on both sides."""
        self.client.start(self.directory.name)
        text = (SOURCE / "trees/door_pulling.xml").read_text()
        self.client.open(self.path, text)
        chance = random.Random(7)
        pieces = ["<", ">", "/>", "\"", "{", "}", "${", "\n", "ü", "\U0001F600", "</", "<!--", "-->", "Wait", " ", "&",
                  "<Sequence>", "</Sequence>", ":=", ""]
        count = int(os.environ.get("LSP_EDITS", "300"))
        memory = None
        for i in range(count):
            if i == count // 5:
                memory = self.memory()
            begin = chance.randrange(len(text) + 1)
            end = min(len(text), begin + chance.choice([0, 0, 1, 5, 40]))
            if i % 50 == 49:
                text = (SOURCE / "trees/door_pulling.xml").read_text()
                self.client.send_change(self.path, text)
                continue
            new = chance.choice(pieces)
            self.client.send_change(self.path, (self.place(text, begin), self.place(text, end), new))
            text = text[:begin] + new + text[end:]
            line, character = self.place(text, chance.randrange(len(text) + 1))
            method = chance.choice(["completion", "hover", "definition", "references", "documentHighlight"])
            self.client.at("textDocument/" + method, self.path, line, character)
            method = chance.choice(["documentSymbol", "foldingRange", "codeLens", "semanticTokens/full"])
            self.client.about("textDocument/" + method, self.path)
        found = self.client.diagnostics(self.path)
        self.assertLess(self.memory() - memory, int(os.environ.get("LSP_GROWTH", "8")))
        other = Path(self.directory.name) / "other.xml"
        known = self.client.open(other, text)
        self.assertEqual([it["message"] for it in known], [it["message"] for it in found])
        self.assertEqual([it["range"] for it in known], [it["range"] for it in found])
        self.assertEqual(0, self.client.stop())
        self.assertEqual("", self.client.errors)

    def memory(self):
        """Of the server, in MiB."""
        status = Path(f"/proc/{self.client.process.pid}/status").read_text()
        return int(status.partition("VmRSS:")[2].split()[0]) / 1024

    @staticmethod
    def place(text, offset):
        before = text[:offset]
        return before.count("\n"), len(before.rpartition("\n")[2].encode("utf-16-le")) // 2


if __name__ == "__main__":
    unittest.main()
