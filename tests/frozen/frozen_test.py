#!/usr/bin/env python3
"""What a version of lockstep made and ran, each later build must run, read and load, to the same bytes.

    frozen_test.py LOCKSTEP LIBRARY_DIRECTORY            compares
    frozen_test.py LOCKSTEP LIBRARY_DIRECTORY --write    fills `given` and `expected` of folders that have none yet

A folder beside this file is named after its version. It has trees, scenarios, a plugin and a program, which were
compiled then, and which run on amd64; in `given` what that version wrote, and in `expected` what came of it. Nothing in
it ever changes: a difference is a defect of the build, or the reason for a new major version."""
import json
import os
import pathlib
import platform
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
HAS_BINARIES = platform.machine() == "x86_64"
RUN = "run trees/TREE.xml --clock virtual --seed 7 --view none --plugin-path plugin"
STUDY = ("study trees/plugin.xml --runs 40 --grid step=0.02,0.04 --measure progress-distance --measure duration "
         "--plugin-path plugin --no-plots")
SANITIZERS = {name: value for name, value in os.environ.items() if name == "LD_PRELOAD" or name.endswith("SAN_OPTIONS")}
# What is made: a name, and the command that writes to it. A later build makes the same.
MADE = {
    "together.jsonl": RUN.replace("TREE", "together") + " --record {}",
    "decide.jsonl": RUN.replace("TREE", "decide") + " --record {}",
    "library.jsonl": RUN.replace("TREE", "library") + " --record {}",
    "plugin.jsonl": RUN.replace("TREE", "plugin") + " --record {}",
    "study": STUDY + " --out {}",
    "totals": STUDY + " --rows none --out {}",
}
# What is only read, since its bytes depend on a library or on the clock.
READ = {
    "together.jsonl.zst": RUN.replace("TREE", "together") + " --record {}",
    "parts.jsonl": RUN.replace("TREE", "together") + " --record {} --record-rotate 16kB",
    "part-1": STUDY + " --shard 1/2 --out {}",
    "part-2": STUDY + " --shard 2/2 --out {}",
}
# What comes of what is given, on stdout.
PRINTED = [
    ("together.csv", "log csv given/together.jsonl"),
    ("together.csv", "log csv given/together.jsonl.zst"),
    ("together.csv", "log csv given/parts.jsonl"),
    ("measures.json", "log measure given/together.jsonl --json --measure held:fast --measure spread --measure duration"),
    ("events.json", "log events given/plugin.jsonl --format json"),
    ("scenario.xml", "log scenario given/plugin.jsonl"),
    ("compare.json", "study compare given/study --cells 0 1 --json"),
    ("summary.json", "run trees/plugin.xml --clock virtual --seed 3 --view none --json --plugin-path plugin"),
    ("check.json", "check trees/together.xml --format json"),
    ("nothing.txt", "log diff given/decide.jsonl {}/decide.jsonl"),
    ("program.txt", "program/frozen trees/plugin.xml plugin"),
]
# What succeeds.
PASSES = ["test trees/plugin.test.xml", "check --strict trees/decide.xml", "check trees/library.xml"]
NEED_BINARIES = {"plugin.jsonl", "study", "totals", "summary.json", "program.txt"}


class Version:
    def __init__(self, folder, lockstep, libraries):
        self.folder, self.lockstep, self.libraries = folder, lockstep, libraries

    def call(self, line, place):
        program, *words = line.format(place).split()
        if program != "program/frozen":
            program, words = self.lockstep, [program, *words]
        environment = {"PATH": "/usr/bin:/bin", "LC_ALL": "C.UTF-8", "LD_LIBRARY_PATH": self.libraries} | SANITIZERS
        done = subprocess.run([program, *words], cwd=self.folder, capture_output=True, env=environment, check=False)
        if done.returncode != 0:
            sys.exit(f"frozen: {line}: exit code {done.returncode}\n{done.stdout.decode()}{done.stderr.decode()}")
        return done.stdout

    def write(self):
        (self.folder / "given").mkdir()
        (self.folder / "expected").mkdir()
        for name, line in (MADE | READ).items():
            self.call(line, f"given/{name}")
        for name, line in PRINTED:
            (self.folder / "expected" / name).write_bytes(self.call(line, "given"))

    def compare(self, work):
        """The names of what is not as it was."""
        runs = [name for name in MADE if HAS_BINARIES or name not in NEED_BINARIES]
        for name in runs:
            self.call(MADE[name], work / name)
        self.call("study merge given/part-1 given/part-2 --no-plots --out {}", work / "merged")
        for line in PASSES:
            self.call(line, work)
        wrong = [name for name in runs if not is_same(self.folder / "given" / name, work / name)]
        wrong += [] if is_same(self.folder / "given/study", work / "merged") else ["merged"]
        for name, line in PRINTED:
            if not HAS_BINARIES and name in NEED_BINARIES:
                continue
            printed = self.call(line, work)
            expected = (self.folder / "expected" / name).read_bytes()
            if name.endswith(".csv"):
                printed = with_columns_of(expected, printed)
            if without_version(printed) != without_version(expected):
                (work / name).write_bytes(printed)
                wrong.append(name)
        return wrong


def without_version(data):
    """The version of lockstep is the first one in a recording, and in study.json; `law` is that of its semantics."""
    data = re.sub(rb'"version": ?"[^"]*"', b'"version":"-"', data, count=1)
    return re.sub(rb'"law": ?[0-9]+', b'"law":0', data, count=1)


def with_columns_of(then, now):
    """A table may get more columns, behind those that it had."""
    count = then.split(b"\n")[0].count(b",") + 1
    return b"\n".join(b",".join(row.split(b",")[:count]) for row in now.split(b"\n"))


def of_keys(then, now):
    """A recording may get more keys, which earlier readers skip."""
    if isinstance(then, dict) and isinstance(now, dict):
        return {key: of_keys(then[key], value) for key, value in now.items() if key in then}
    if isinstance(then, list) and isinstance(now, list) and len(then) == len(now):
        return [of_keys(*both) for both in zip(then, now)]
    return now


def with_keys_of(then, now):
    header, end, rest = now.partition(b"\n")
    known = of_keys(json.loads(then.partition(b"\n")[0]), json.loads(header))
    return json.dumps(known, separators=(",", ":"), ensure_ascii=False).encode() + end + rest


def is_same(then, now):
    if then.suffix == ".jsonl":
        return without_version(then.read_bytes()) == without_version(with_keys_of(then.read_bytes(), now.read_bytes()))
    if then.is_dir():
        names = {file.name for file in then.iterdir()}
        return names == {file.name for file in now.iterdir()} and all(is_same(then / it, now / it) for it in names)
    return without_version(then.read_bytes()) == without_version(now.read_bytes())


def main():
    lockstep, libraries = (str(pathlib.Path(it).resolve()) for it in sys.argv[1:3])
    wrong = []
    for folder in sorted(it for it in HERE.iterdir() if it.is_dir()):
        version = Version(folder, lockstep, libraries)
        if "--write" in sys.argv and not (folder / "given").exists():
            version.write()
        with tempfile.TemporaryDirectory() as work:
            wrong += [f"{folder.name}/{name}" for name in version.compare(pathlib.Path(work))]
    if wrong:
        sys.exit("frozen: not as it was: " + ", ".join(wrong))


if __name__ == "__main__":
    main()
