"""Prints how long the server takes: python3 tests/lsp/speed.py [NODES…]. It neither passes nor fails.

LOCKSTEP is the program; BUILD, the directory that has plugins/."""
import os
import statistics
import sys
import tempfile
import time
from pathlib import Path

from client import Client

EDITS = 200


def tree(nodes):
    """A tree of so many nodes, in sequences of ten."""
    lines = ["<root lockstep=\"1\">", "  <plugin name=\"motion\"/>", "  <BehaviorTree ID=\"Main\">", "    <Sequence memory=\"true\">"]
    for i in range(nodes // 10):
        lines.append(f"      <Sequence name=\"part {i}\" memory=\"true\">")
        lines += [f"        <Advance name=\"a{j}\" step=\"0.5\"/>" for j in range(8)]
        lines.append(f"        <Script code=\"x{i} := {i}\"/>")
        lines.append("      </Sequence>")
    return "\n".join(lines + ["    </Sequence>", "  </BehaviorTree>", "</root>", ""])


def milliseconds(times):
    times = sorted(1000 * it for it in times)
    return f"median {statistics.median(times):7.1f} ms   p95 {times[int(0.95 * len(times))]:7.1f} ms   worst {times[-1]:7.1f} ms"


def measure(nodes):
    with tempfile.TemporaryDirectory() as directory:
        path = Path(directory) / "tree.xml"
        client = Client("--plugin-path", os.environ["BUILD"] + "/plugins")
        client.start(directory)
        text = tree(nodes)
        begin = time.perf_counter()
        client.open(path, text)
        print(f"{nodes} nodes, {len(text)} bytes; opened in {1000 * (time.perf_counter() - begin):.1f} ms")
        edits = EDITS if nodes <= 10_000 else 5
        line = 5  # <Advance
        checks, completions = [], []
        for i in range(edits):
            begin = time.perf_counter()
            client.send_change(path, ((line, 8), (line, 8), " "))
            client.first_diagnostics(path)
            checks.append(time.perf_counter() - begin)
            begin = time.perf_counter()
            client.at("textDocument/completion", path, line, 11 + i)
            completions.append(time.perf_counter() - begin)
        print("  an edit until its diagnostics:", milliseconds(checks))
        print("  completion:                   ", milliseconds(completions))
        begin = time.perf_counter()
        client.diagnostics(path)
        print(f"  all that check says, after:    {1000 * (time.perf_counter() - begin):.1f} ms")
        # While the newest text is being checked.
        client.send_change(path, ((line, 8), (line, 8), " "))
        begin = time.perf_counter()
        client.at("textDocument/completion", path, line, 11)
        print(f"  completion during a check:     {1000 * (time.perf_counter() - begin):.1f} ms")
        client.diagnostics(path)
        assert client.stop() == 0


for count in [int(it) for it in sys.argv[1:]] or [1_000, 10_000]:
    measure(count)
