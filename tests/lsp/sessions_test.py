"""Random sessions: texts change, are closed and opened while they are checked, and requests come at any time. Each request has one
answer; in the end the server has the text of the editor, and finds in it what a new server finds.

LSP_SESSIONS is how many there are; LSP_SEED, the first seed. Under a sanitizer there are more, and it finds what one thread takes from
another."""
import os
import queue
import random
import tempfile
import threading
import unittest
from pathlib import Path

from client import PLUGINS, Client, place

SESSIONS = int(os.environ.get("LSP_SESSIONS", "2"))
SEED = int(os.environ.get("LSP_SEED", "1"))
ABOUT = ["foldingRange", "documentSymbol", "codeLens", "semanticTokens/full"]
AT = ["hover", "completion", "definition", "documentHighlight", "prepareRename"]
PIECES = ["", " ", "\n", "\r\n", "ü", "😀", "<", ">", "\"", "{x}", "<Wait seconds=\"1\"/>", "<Sequence>", "</Sequence>", "<!-- -->",
          "<Script code=\"x := 1\"/>", "<SubTree ID=\"Part\"/>", "<Unknown/>", "name=\"é\" "]


def tree(random_numbers, name, other):
    lines = [f'<root lockstep="1"><include path="{other}"/>', f'<BehaviorTree ID="{name}">', "<Sequence>"]
    lines += [f'<Wait name="n{i} ü😀" seconds="{random_numbers.randint(0, 9)}"/>' for i in range(random_numbers.choice([1, 30, 2000]))]
    return random_numbers.choice(["\n", " "]).join(lines + ["</Sequence>", "</BehaviorTree>", "</root>"])


class ReadingClient(Client):
    """It reads while it writes, as editors do: the server waits for one that does not."""

    def start(self, *arguments, **options):
        self.messages = queue.Queue()
        self.reader = threading.Thread(target=self.collect)
        self.reader.start()
        return super().start(*arguments, **options)

    def collect(self):
        try:
            while True:
                self.messages.put(super().read())
        except Exception as end:
            self.messages.put(end)

    def read(self):
        message = self.messages.get()
        if isinstance(message, Exception):
            raise message
        return message

    def stop(self):
        self.ask("shutdown")
        self.notify("exit")
        self.reader.join()
        self.process.stdin.close()
        code = self.process.wait(timeout=60)
        self.process.stdout.close()
        return code


class Editor:
    """It changes its texts as it tells the server."""

    def __init__(self, client, directory, numbers):
        self.client, self.numbers, self.texts, self.asked = client, numbers, {}, []
        self.paths = [Path(directory) / it for it in ("a.xml", "b.xml")]
        for path, name, other in zip(self.paths, ("Main", "Part"), ("b.xml", "a.xml")):
            path.write_text(tree(numbers, name, other), encoding="utf-8")

    def about(self, path):
        return {"textDocument": {"uri": path.as_uri()}}

    def open(self, path):
        self.texts[path] = path.read_bytes().decode()
        self.client.versions[path] = 1
        self.client.notify("textDocument/didOpen", {"textDocument": {
            "uri": path.as_uri(), "languageId": "xml", "version": 1, "text": self.texts[path]}})

    def close(self, path):
        del self.texts[path]
        self.client.close(path)

    def change(self, path):
        changes = []
        for _ in range(self.numbers.choice([1, 1, 1, 3])):
            text = self.texts[path]
            begin = self.numbers.randint(0, len(text))
            end = min(len(text), begin + self.numbers.choice([0, 0, 1, 40]))
            # A place between the two bytes of a line end is no place.
            begin -= text[begin - 1:begin + 1] == "\r\n"
            end += text[end - 1:end + 1] == "\r\n"
            new = self.numbers.choice(PIECES)
            changes.append((place(text, begin), place(text, end), new))
            self.texts[path] = text[:begin] + new + text[end:]
        self.client.send_change(path, *changes)

    def ask(self, path):
        text = self.texts[path]
        line, character = place(text, self.numbers.randint(0, len(text)))
        more = {"position": {"line": line, "character": character}}
        method = self.numbers.choice(ABOUT + AT + ["inlayHint", "formatting", "codeAction"])
        if method in ("inlayHint", "codeAction"):
            more = {"range": self.client.range((0, 0), (line, character)), "context": {"diagnostics": []}}
        if method == "formatting":
            more = {"options": {"tabSize": 2, "insertSpaces": True}}
        number = self.client.send("textDocument/" + method, {**self.about(path), **more})
        if self.numbers.random() < 0.1:
            self.client.notify("$/cancelRequest", {"id": number})
        self.asked.append(number)

    def step(self):
        closed = [it for it in self.paths if it not in self.texts]
        path = self.numbers.choice(self.paths)
        if path in closed:
            self.open(path)
        else:
            self.numbers.choices([self.change, self.ask, self.close], [5, 5, 0.2])[0](path)
        if len(self.asked) > 5:
            self.read()

    def read(self):
        for number in self.asked:
            error = self.client.answer(number).get("error")
            # The text has no tree to format, a place has no name, or the request was cancelled.
            assert error is None or error["code"] in (-32602, -32800), error
        self.asked = []


class Sessions(unittest.TestCase):
    maxDiff = None

    def found(self, texts, directory):
        """What a new server finds in them."""
        client = ReadingClient(*PLUGINS)
        client.start(directory)
        for path, text in texts.items():
            client.open(path, text)
        found = {path: client.diagnostics(path) for path in texts}
        self.assertEqual(0, client.stop(), client.errors)
        return found

    def session(self, seed):
        numbers = random.Random(seed)
        with tempfile.TemporaryDirectory() as directory:
            client = ReadingClient(*PLUGINS)
            client.start(directory)
            editor = Editor(client, directory, numbers)
            for _ in range(200):
                editor.step()
            editor.read()
            for path in editor.paths:
                if path not in editor.texts:
                    editor.open(path)
            for path in editor.paths:
                client.diagnostics(path)
            found = {path: client.diagnostics(path) for path in editor.paths}
            self.assertEqual(0, client.stop(), client.errors)
            self.assertEqual("", client.errors)
            self.assertEqual(self.found(editor.texts, directory), found)

    def test_random_sessions(self):
        for seed in range(SEED, SEED + SESSIONS):
            with self.subTest(seed=seed):
                self.session(seed)


if __name__ == "__main__":
    unittest.main()
