"""A client of the Language Server Protocol: it starts the server and waits for what it sends."""
import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

PLUGINS = ["--plugin-path", os.environ["BUILD"] + "/plugins"]


class Client:
    def __init__(self, *options, environment=None):
        self.told = tempfile.TemporaryFile()  # what it writes to stderr; nothing reads it meanwhile
        self.process = subprocess.Popen(
            [os.environ["LOCKSTEP"], "lsp", *options], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
            stderr=self.told, env={**os.environ, **(environment or {})})
        self.number = 0
        self.versions = {}
        self.known = {}  # what is wrong, by URI
        self.kept = []  # what was sent while something else was waited for

    # Messages.
    def write(self, *messages):
        """All in one piece."""
        data = b""
        for message in messages:
            body = json.dumps({"jsonrpc": "2.0", **message}).encode()
            data += b"Content-Length: %d\r\n\r\n%b" % (len(body), body)
        self.raw(data)

    def raw(self, data):
        try:
            self.process.stdin.write(data)
            self.process.stdin.flush()
        except BrokenPipeError:
            pass  # read() says how the server has ended

    def read(self):
        length = None
        while line := self.process.stdout.readline().strip():
            name, value = line.split(b":")
            if name.lower() == b"content-length":
                length = int(value)
        if length is None:
            code = self.process.wait(timeout=60)
            raise EOFError(f"the server has ended with {code}:\n{self.errors}")
        return json.loads(self.process.stdout.read(length))

    @property
    def errors(self):
        number = self.told.fileno()
        return os.pread(number, os.fstat(number).st_size, 0).decode()  # the server writes where it was

    def wait(self, is_it):
        for message in self.kept:
            if is_it(message):
                self.kept.remove(message)
                return message
        while True:
            message = self.read()
            if is_it(message):
                return message
            self.kept.append(message)

    def notify(self, method, params=None):
        self.write({"method": method, "params": params or {}})

    def send(self, method, params=None):
        self.number += 1
        self.write({"id": self.number, "method": method, "params": params or {}})
        return self.number

    def answer(self, number):
        return self.wait(lambda it: it.get("id") == number and "method" not in it)

    def ask(self, method, params=None):
        answer = self.answer(self.send(method, params))
        assert "error" not in answer, answer
        return answer["result"]

    # A session.
    def start(self, root=None, related=True, **options):
        capabilities = {
            "textDocument": {
                "publishDiagnostics": {"relatedInformation": related},
                "completion": {"completionItem": {"snippetSupport": True}},
                "hover": {"contentFormat": ["markdown", "plaintext"]},
            }}
        answer = self.ask("initialize", {
            "processId": None, "rootUri": Path(root).as_uri() if root else None,
            "capabilities": capabilities, "initializationOptions": options or None})
        self.notify("initialized")
        return answer

    def stop(self):
        self.ask("shutdown")
        self.notify("exit")
        self.process.stdin.close()
        code = self.process.wait(timeout=60)
        self.process.stdout.close()
        return code

    # Files. Each returns what is wrong with the text, once the server has said so.
    def open(self, path, text=None, language="xml"):
        path = Path(path)
        text = path.read_text(encoding="utf-8") if text is None else text
        self.versions[path] = 1
        self.notify("textDocument/didOpen", {"textDocument": {
            "uri": path.as_uri(), "languageId": language, "version": 1, "text": text}})
        return self.diagnostics(path)

    def change(self, path, *changes):
        """Each is a text, or ((line, character), (line, character), text)."""
        self.send_change(path, *changes)
        return self.diagnostics(path)

    def send_change(self, path, *changes):
        path = Path(path)
        self.versions[path] += 1
        content = []
        for change in changes:
            if isinstance(change, str):
                content.append({"text": change})
            else:
                content.append({"range": self.range(*change[:2]), "text": change[2]})
        self.notify("textDocument/didChange", {
            "textDocument": {"uri": path.as_uri(), "version": self.versions[path]},
            "contentChanges": content})

    def close(self, path):
        self.notify("textDocument/didClose", {"textDocument": {"uri": Path(path).as_uri()}})

    def diagnostics(self, path, of=None):
        """Those that the client has once the server has found all; `of` includes the file."""
        path, of = Path(path), Path(of or path)
        # It is answered when nothing more can be found.
        self.about("textDocument/codeAction", of, range=self.range((0, 0), (0, 0)),
                   context={"diagnostics": []})
        for message in self.kept:
            if message.get("method") == "textDocument/publishDiagnostics":
                self.known[message["params"]["uri"]] = message["params"]["diagnostics"]
        self.kept = [it for it in self.kept if it.get("method") != "textDocument/publishDiagnostics"]
        return self.known.get(path.as_uri(), [])

    def first_diagnostics(self, path):
        """Those of the newest version that come first."""
        path = Path(path)
        return self.wait(
            lambda it: it.get("method") == "textDocument/publishDiagnostics" and
            it["params"]["uri"] == path.as_uri() and
            it["params"].get("version") == self.versions[path])["params"]["diagnostics"]

    @staticmethod
    def range(begin, end):
        return {"start": {"line": begin[0], "character": begin[1]},
                "end": {"line": end[0], "character": end[1]}}

    def at(self, method, path, line, character, **more):
        return self.ask(method, {
            "textDocument": {"uri": Path(path).as_uri()},
            "position": {"line": line, "character": character}, **more})

    def about(self, method, path, **more):
        return self.ask(method, {"textDocument": {"uri": Path(path).as_uri()}, **more})


class Session(unittest.TestCase):
    """A client with a place for a file, and a server that ends well."""
    maxDiff = None

    def setUp(self):
        self.directory = tempfile.TemporaryDirectory()
        self.path = Path(self.directory.name) / "tree.xml"
        self.client = Client(*PLUGINS)

    def tearDown(self):
        self.assertEqual(self.client.stop(), 0)
        self.assertEqual(self.client.errors, "")
        self.directory.cleanup()


def offset(text, position):
    """In characters of Python."""
    lines = text.split("\n")
    line = lines[position["line"]].encode("utf-16-le")[:2 * position["character"]]
    return sum(len(it) + 1 for it in lines[:position["line"]]) + len(line.decode("utf-16-le"))


def place(text, at):
    """The position of a character."""
    before = text[:at]
    return before.count("\n"), len(before.rpartition("\n")[2].encode("utf-16-le")) // 2


def edited(text, edits):
    """With the edits of a file, of which no two overlap."""
    ranges = [(*(offset(text, it["range"][end]) for end in ("start", "end")), it["newText"]) for it in edits]
    for begin, end, new in sorted(ranges, key=lambda it: it[:2], reverse=True):
        text = text[:begin] + new + text[end:]
    return text
