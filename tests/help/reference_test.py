"""docs/nodes-and-attributes.md has each node and attribute of docs/nodes.md, with the same type, range and default:
reference_test.py SOURCES. The program prints docs/nodes.md, so the reference follows the program."""
import os
import re
import sys

SOURCES = sys.argv[1]


def values(page):
    """{"wait": {("`seconds`", "double in s, …")}}: of each heading, the attributes in the table below it."""
    found, heading = {}, None
    with open(os.path.join(SOURCES, "docs", page), encoding="utf-8") as text:
        for line in text:
            if line.startswith("#"):
                heading = line.lstrip("#").strip().lower()
                found.setdefault(heading, set())
            elif row := re.match(r"\| (`[^`]+`) \| ([^|]+) \|", line):
                found[heading].add((row[1], row[2].strip()))
    return found


ours = values("nodes-and-attributes.md")
with open(os.path.join(SOURCES, "docs/nodes.md"), encoding="utf-8") as text:
    nodes = [it.lower() for it in re.findall(r"^### (\w+)$", text.read(), re.M)]
assert len(nodes) > 25, nodes
wrong = [f"no section '{it}'" for it in nodes if it not in ours]
for node in nodes:
    wrong += [f"{node}: no row | {name} | {value} |" for name, value in values("nodes.md")[node] - ours.get(node, set())]
if wrong:
    sys.exit("docs/nodes-and-attributes.md differs from docs/nodes.md\n" + "\n".join(wrong))
