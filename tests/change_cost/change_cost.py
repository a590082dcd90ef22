#!/usr/bin/env python3
"""What a change costs: the files that it touches, by hand and generated.

change_cost.py [CHANGE]

CHANGE is what `git diff` takes: two commits (main..branch), or one, from which on all counts, with
what is not committed. HEAD when absent. docs/architecture.md has the numbers of the usual changes.
"""
import os
import re
import subprocess
import sys

# What `./dev generate` and `./dev page` write: whole files, and tables in files that are written by hand, by
# the line before the table or its first line.
WHOLE = {"schema/lockstep.xsd", "schema/leaves.xsd", "schema/scenarios.xsd", "docs/nodes.md", "schema/recording.schema.json",
         "interpreter/show/web/page/src/model/recording.ts", "interpreter/show/web/page/page.html",
         "plugins/sdk/btcpp/include/behaviortree_cpp/lockstep/node_ids.h",
         "plugins/sdk/btcpp/include/behaviortree_cpp/lockstep/node_ports.h",
         "plugins/sdk/btcpp/include/behaviortree_cpp/lockstep/nodes.h"}
TABLES = {"docs/messages.md": r"\| Code \| Meaning \|",
          "docs/recording.md": r"<!-- lines: .* -->", "docs/studies.md": r"\| Measure \| Of \| Meaning \|",
          "docs/nodes-and-attributes.md": r"\| There \| Here \| \|"}
NOT_COUNTED = {"CHANGELOG.md"}


def git(*words):
    return subprocess.run(["git", *words], capture_output=True, text=True, check=True).stdout


def text_of(commit, name):
    "The lines of the file, in a commit or as it lies there; none before the commit that adds it."
    if commit:
        return git("show", f"{commit}:{name}").splitlines() if git("ls-tree", "--full-tree", commit, name) else []
    with open(name, encoding="utf-8") as file:
        return file.read().splitlines()


def generated_lines(lines, begin):
    "The numbers of the lines that are in a generated table, from 1."
    found = set()
    for number, line in enumerate(lines, 1):
        if re.fullmatch(begin, line):
            found.add(number)
        elif line.startswith("|") and number - 1 in found:
            found.add(number)
    return found


def is_generated(change, name):
    if name in WHOLE:
        return True
    if name not in TABLES:
        return False
    ends = re.split(r"\.\.\.?", change) if ".." in change else [change, ""]
    old, new = (generated_lines(text_of(end, name), TABLES[name]) for end in ends)
    hunks = re.findall(r"^@@ -(\d+)(?:,(\d+))? \+(\d+)(?:,(\d+))? @@", git("diff", "-U0", change, "--", name), re.M)
    for old_begin, old_count, new_begin, new_count in hunks:
        removed = range(int(old_begin), int(old_begin) + int(old_count or 1))
        added = range(int(new_begin), int(new_begin) + int(new_count or 1))
        if not (set(removed) <= old and set(added) <= new):
            return False
    return True


def kind_of(change, name):
    "None: it does not count."
    if name in NOT_COUNTED:
        return None
    if is_generated(change, name):
        return "generated"
    if name.startswith("tests/"):
        return "tests"
    return "documents" if name.endswith(".md") else "program"


def main():
    if len(sys.argv) > 2 or sys.argv[1:2] in (["-h"], ["--help"]):
        sys.exit(__doc__)
    change = sys.argv[1] if len(sys.argv) == 2 else "HEAD"
    try:
        os.chdir(git("rev-parse", "--show-toplevel").strip())
        rows = git("diff", "--numstat", "--no-renames", change).splitlines()
        if ".." not in change:
            new = git("ls-files", "--others", "--exclude-standard").splitlines()
            rows += [f"{len(text_of('', name))}\t0\t{name}" for name in new]
    except subprocess.CalledProcessError as error:
        sys.exit(f"change_cost: {error.stderr.strip()}")
    files = {}
    for added, removed, name in (row.split("\t") for row in rows):
        kind = kind_of(change, name)
        if kind:
            files.setdefault(kind, []).append(f"{name}  +{added} -{removed}")
    for kind in ("program", "tests", "documents", "generated"):
        for row in sorted(files.get(kind, [])):
            print(f"{kind:<11}{row}")
    count = {kind: len(files.get(kind, [])) for kind in ("program", "tests", "documents", "generated")}
    by_hand = count["program"] + count["tests"] + count["documents"]
    print(f"{by_hand} by hand: {count['program']} of the program, {count['tests']} of tests, "
          f"{count['documents']} of documents; {count['generated']} generated")


main()
