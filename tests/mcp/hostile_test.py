"""`lockstep mcp` and frames that no client sends: it answers with errors, and goes on."""
import json
import os
import random
import signal
import subprocess
import tempfile
import unittest

LOCKSTEP = os.environ["LOCKSTEP"]
FRAMES = int(os.environ.get("MCP_FRAMES", "3000"))


class Server:
    def __init__(self, *options, **environment):
        self.process = subprocess.Popen([LOCKSTEP, "mcp", *options], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                        env={**os.environ, **environment})
        self.number = 0

    def raw(self, data):
        self.process.stdin.write(data)
        self.process.stdin.flush()

    def send(self, message):
        self.raw(json.dumps({"jsonrpc": "2.0", **message}).encode() + b"\n")

    def read(self):
        line = self.process.stdout.readline()
        if not line:
            raise EOFError(f"the server has ended with {self.process.wait(timeout=60)}")
        return json.loads(line)

    def ask(self, method, params=None):
        self.number += 1
        self.send({"id": self.number, "method": method, "params": params or {}})
        while True:
            answer = self.read()
            if answer.get("id") == self.number:
                return answer

    def begin(self):
        params = {"protocolVersion": "2025-06-18", "capabilities": {}, "clientInfo": {"name": "t", "version": "1"}}
        answer = self.ask("initialize", params)
        self.send({"method": "notifications/initialized"})
        return answer

    def call(self, name, **arguments):
        return self.ask("tools/call", {"name": name, "arguments": arguments})

    def end(self):
        self.process.stdin.close()
        self.process.stdout.close()
        return self.process.wait(timeout=60)


class HostileTest(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.server = Server("--workspace", self.folder.name, "--time", "20")

    def tearDown(self):
        self.assertEqual(0, self.server.end())
        self.folder.cleanup()

    def assert_alive(self):
        self.assertEqual({}, self.server.ask("ping")["result"])

    def test_the_revision_is_the_client_s_or_ours(self):
        for wanted, given in (("2024-11-05", "2024-11-05"), ("1999-01-01", "2025-06-18")):
            answer = self.server.ask("initialize", {"protocolVersion": wanted})
            self.assertEqual(given, answer["result"]["protocolVersion"])

    def test_before_it_is_initialized_it_only_answers_ping(self):
        self.assertEqual(-32002, self.server.ask("tools/list")["error"]["code"])
        self.assert_alive()

    def test_errors_have_the_codes_of_json_rpc(self):
        self.server.begin()
        for frame, code in ((b"{", -32700), (b"[]", -32600), (b"1", -32600), (b'{"id":{}}', -32600),
                            (b'{"jsonrpc":"2.0","id":7}', -32600)):
            self.server.raw(frame + b"\n")
            answer = self.server.read()
            self.assertIn(answer["error"]["code"], (code, -32700), frame)
            self.assertIsNone(answer["id"])
        self.assertEqual(-32601, self.server.ask("no/such")["error"]["code"])
        self.assertEqual(-32602, self.server.ask("tools/call", {"name": "check", "arguments": 3})["error"]["code"])
        self.assertEqual(-32602, self.server.ask("tools/call", {"name": "check", "arguments": {"text": {}}})["error"]["code"])
        self.assert_alive()

    def test_random_frames_end_nothing(self):
        self.server.begin()
        draw = random.Random(1)
        seeds = [json.dumps({"jsonrpc": "2.0", "id": 1, "method": method, "params": params}).encode()
                 for method, params in (("ping", {}), ("resources/read", {"uri": "lockstep://docs/nodes"}),
                                        ("tools/list", {}), ("tools/call", {"name": "chek", "arguments": {"text": "<a/>"}}),
                                        ("initialize", {"protocolVersion": "2025-06-18"}))]
        for _ in range(FRAMES // 100):
            frames = b""
            for _ in range(100):
                frame = bytearray(draw.choice(seeds))
                for _ in range(draw.randrange(4)):
                    at = draw.randrange(len(frame))
                    change = draw.randrange(3)
                    if change == 0:
                        frame[at] = draw.randrange(256)
                    elif change == 1:
                        del frame[at:at + draw.randrange(1, 9)]
                    else:
                        frame[at:at] = draw.randbytes(draw.randrange(1, 9))
                    if not frame:
                        break
                frames += bytes(frame) + b"\n"
            self.server.number += 1000
            self.server.raw(frames)
            self.assert_alive()

    def test_a_text_in_place_of_a_file_is_told_what_to_give(self):
        self.server.begin()
        tree = '<root lockstep="1"><BehaviorTree ID="T"><AlwaysSuccess/></BehaviorTree></root>'

        def refusal(name, **arguments):
            result = self.server.call(name, **arguments)["result"]
            self.assertTrue(result["isError"], result)
            return result["content"][0]["text"]

        for name in ("check", "show", "verify", "simulate", "scenario_from"):
            self.assertIn("give it as 'text'", refusal(name, tree=tree), name)
        self.assertIn("give it as 'tree'", refusal("check", text="t.xml"))
        self.assertIn("give it as 'leaves_text'", refusal("simulate", text=tree, leaves="<leaves lockstep='1'/>"))
        self.assertIn("give it as 'before_text'", refusal("diff", before=tree, after_text=tree))
        self.assertIn("a file of the workspace", refusal("measure", recording='{"lockstep_recording":1}'))
        # The recording of a text does not have it.
        self.assertFalse(self.server.call("simulate", text=tree)["result"]["isError"])
        self.assertIn("a file that has the tree", refusal("scenario_from"))
        self.assertFalse(self.server.call("scenario_from", text=tree)["result"]["isError"])

    def test_a_large_text_is_answered(self):
        self.server.begin()
        text = '<root lockstep="1"><BehaviorTree ID="Main"><Sequence>' + "<Wait seconds='x'/>" * 1_000_000
        answer = self.server.call("check", text=text)["result"]
        self.assertIn("content", answer)
        self.assert_alive()

    def test_limits_of_time_and_memory_stop_a_call_and_nothing_else(self):
        self.server.end()
        self.server = Server("--workspace", self.folder.name, "--time", "0.5", "--memory", "256")
        self.server.begin()
        leaves = "".join(f'<Retry attempts="{i + 2}"><Sequence memory="true"><A{i}/><B{i}/></Sequence></Retry>' for i in range(9))
        tree = f'<root lockstep="1"><BehaviorTree ID="Main"><Parallel success_count="9">{leaves}</Parallel></BehaviorTree></root>'
        result = self.server.call("verify", text=tree, mock=True)["result"]
        # Its own limit of time comes before that of the call.
        self.assertTrue(result["isError"] or result["structuredContent"]["exit_code"] == 124, result)
        self.assert_alive()
        long = '<root lockstep="1"><BehaviorTree ID="Main"><Repeat times="1000000000"><Wait seconds="1"/></Repeat></BehaviorTree></root>'
        result = self.server.call("simulate", text=long, max_ticks=1e12)["result"]
        self.assertTrue(result["isError"], result)
        self.assertIn("stopped after 0.5 seconds", result["content"][0]["text"])
        self.assert_alive()

    def test_calls_run_at_once_and_an_id_is_used_once(self):
        self.server.begin()
        tree = '<root lockstep="1"><BehaviorTree ID="Main"><Wait seconds="1"/></BehaviorTree></root>'
        for number in range(100, 120):
            self.server.send({"id": number, "method": "tools/call", "params": {"name": "check", "arguments": {"text": tree}}})
        answered = set()
        while len(answered) < 20:
            answer = self.server.read()
            self.assertEqual([], answer["result"]["structuredContent"]["messages"])
            answered.add(answer["id"])
        self.assertEqual(set(range(100, 120)), answered)

    def test_what_is_canceled_has_no_answer(self):
        self.server.begin()
        tree = '<root lockstep="1"><BehaviorTree ID="Main"><Wait seconds="1"/></BehaviorTree></root>'
        for number in range(200, 210):
            self.server.send({"id": number, "method": "tools/call", "params": {"name": "check", "arguments": {"text": tree}}})
        for number in range(204, 210):
            self.server.send({"method": "notifications/cancelled", "params": {"requestId": number}})
        answered = {self.server.read()["id"] for _ in range(4)}
        self.assertTrue(answered >= {200, 201} or len(answered) == 4)
        self.assert_alive()

    def test_a_signal_ends_it_with_its_calls_and_its_temporary_folder(self):
        long = '<root lockstep="1"><BehaviorTree ID="Main"><Repeat times="1000000000"><Wait seconds="1"/></Repeat></BehaviorTree></root>'
        for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
            with tempfile.TemporaryDirectory() as scratch:
                server = Server("--workspace", self.folder.name, TMPDIR=scratch)
                server.begin()
                server.send({"id": 5, "method": "tools/call", "params": {"name": "simulate", "arguments": {"text": long, "max_ticks": 1e12}}})
                self.assertEqual({}, server.ask("ping")["result"])
                server.process.send_signal(number)
                self.assertEqual(128 + number, server.process.wait(timeout=60))
                self.assertEqual([], os.listdir(scratch))
                server.end()


if __name__ == "__main__":
    unittest.main()
