#!/usr/bin/env python3
"""Compiles the tests of BehaviorTree.CPP, file by file, over lockstep's headers, runs each of them in
a process of its own, and compares the verdicts with library_tests.txt. Nothing of the library is in
this project: CHECKOUT is a clone of it."""
import argparse
import concurrent.futures
import os
import pathlib
import re
import subprocess
import sys

COMMIT = "879522c7"
VERSION = "4.10.0"
HERE = pathlib.Path(__file__).resolve().parent
SOURCE = HERE.parent.parent
LIST = HERE / "library_tests.txt"
SECONDS = 60  # of one test: what takes longer hangs
TEST = re.compile(r"^(?:TEST|TEST_F)\(\s*(\w+),\s*(\w+)\s*\)")
SHARED = ["tests/src/action_test_node.cpp", "tests/src/condition_test_node.cpp",
          "sample_nodes/crossdoor_nodes.cpp", "sample_nodes/dummy_nodes.cpp",
          "sample_nodes/movebase_node.cpp"]
HEADER = f"""\
# The tests of BehaviorTree.CPP {VERSION}, commit {COMMIT}, over the headers of lockstep.
# passes, fails, is not compiled: the verdict, compared by ./dev test-btcpp CHECKOUT, written by its --update.
# is left out: it tests what is private to the library. What follows a colon is the reason.
"""


def arguments():
    parser = argparse.ArgumentParser(prog="./dev test-btcpp", description=__doc__,
                                     epilog="Example: ./dev test-btcpp ~/BehaviorTree.CPP --only gtest_ports")
    parser.add_argument("checkout", type=pathlib.Path, metavar="CHECKOUT",
                        help=f"a clone of BehaviorTree.CPP at {VERSION}, commit {COMMIT}")
    parser.add_argument("--only", default="", metavar="TEXT", help="files whose name has this text")
    parser.add_argument("--update", action="store_true", help="write the verdicts to library_tests.txt")
    parser.add_argument("--verbose", action="store_true", help="print what failing tests and compilers say")
    parser.add_argument("--build", type=pathlib.Path, default=SOURCE / "build/release",
                        help="where lockstep is built (build/release)")
    parser.add_argument("--work", type=pathlib.Path, help="where programs go (BUILD/library_tests)")
    return parser.parse_args()


def refuse(message):
    print(f"test-btcpp: {message}", file=sys.stderr)
    sys.exit(2)


def check_commit(checkout):
    try:
        found = subprocess.run(["git", "-C", checkout, "rev-parse", "HEAD"], capture_output=True, text=True).stdout
    except OSError as error:
        refuse(f"git: {error}")
    if not (checkout / "tests/gtest_any.cpp").exists():
        refuse(f"{checkout} is no clone of BehaviorTree.CPP: it has no tests/gtest_any.cpp")
    if not found.startswith(COMMIT):
        refuse(f"{checkout} is at {found[:8] or 'no commit'}; the verdicts are of {VERSION}: git checkout {COMMIT}")


def read_list():
    """{file: {test: (verdict, reason)}}"""
    files, tests = {}, None
    for line in LIST.read_text().splitlines() if LIST.exists() else []:
        if line.startswith("#") or not line:
            continue
        if not line.startswith(" "):
            tests = files.setdefault(line, {})
            continue
        name, rest = line.split(maxsplit=1)
        verdict, _, reason = rest.partition(": ")
        tests[name] = (verdict, reason)
    return files


def write_list(files):
    text = HEADER
    for file, tests in sorted(files.items()):
        text += f"\n{file}\n"
        for name, (verdict, reason) in tests.items():
            text += f"  {name} {verdict}" + (f": {reason}" if reason else "") + "\n"
    LIST.write_text(text)


class Builder:
    def __init__(self, given):
        self.checkout = given.checkout.resolve()
        self.build = given.build.resolve()
        self.work = (given.work or self.build / "library_tests").resolve()
        self.work.mkdir(parents=True, exist_ok=True)
        includes = [SOURCE / "plugins/sdk/btcpp/include", SOURCE / "plugins/sdk", SOURCE / "interpreter/embedding",
                    self.checkout / "tests/include", self.checkout / "tests", self.checkout / "sample_nodes",
                    self.checkout / "3rdparty"]
        self.plugin = self.work / "plugin_issue953.so"
        self.flags = ["-std=c++17", "-O0", "-w", "-fdiagnostics-color=never", "-fPIC",
                      f'-DBT_TEST_FOLDER="{self.checkout}/tests"', f'-DBT_PLUGIN_ISSUE953_PATH="{self.plugin}"']
        for it in includes[:3]:
            self.flags += ["-I", str(it)]
        # The library's own headers are not among them: these are found by the folder of the test.
        for it in includes[3:6]:
            self.flags += ["-I", str(it)]
        compiler = os.environ.get("CXX", "c++").split()
        launcher = os.environ.get("CMAKE_CXX_COMPILER_LAUNCHER", "").split()
        self.compiler, self.launcher = compiler, launcher

    def compile(self, source, target, *more):
        return subprocess.run([*self.launcher, *self.compiler, *self.flags, *more, "-c", source, "-o", target],
                              capture_output=True, text=True)

    def shared(self):
        """What all tests are linked with; a text where it is not compiled."""
        objects = []
        for it in SHARED:
            target = self.work / (pathlib.Path(it).stem + ".o")
            done = self.compile(self.checkout / it, target)
            if done.returncode != 0:
                print(f"test-btcpp: {it} is not compiled\n{done.stderr}", file=sys.stderr)
                continue
            objects.append(target)
        plugin = self.checkout / "tests/plugin_issue953/plugin_issue953.cpp"
        subprocess.run([*self.compiler, *self.flags, "-DBT_PLUGIN_EXPORT", "-shared", plugin, "-o", self.plugin,
                        f"-Wl,--version-script={SOURCE}/plugins/sdk/lockstep_plugin.map"])
        self.objects = objects

    def link(self, name, objects):
        target = self.work / name
        done = subprocess.run([*self.compiler, *objects, *self.objects, "-o", target, f"-L{self.build}",
                               f"-Wl,-rpath,{self.build}", "-llockstep-runtime", "-lgmock", "-lgtest_main", "-lgtest", "-lpthread",
                               "-ldl"], capture_output=True, text=True)
        return target if done.returncode == 0 else done.stderr


def ranges(lines):
    """{test: (first, last)} lines, from 0: each test ends with a brace in the first column."""
    tests, name = {}, None
    for index, line in enumerate(lines):
        found = TEST.match(line) or TEST.match(line.strip() + (lines[index + 1].strip() if line.rstrip().endswith(",")
                                                               and index + 1 < len(lines) else ""))
        if found:
            name, first = f"{found[1]}.{found[2]}", index
        elif name and line.startswith("}"):
            tests[name] = (first, index)
            name = None
    return tests


def without(lines, tests, names):
    kept = list(lines)
    for name in names:
        first, last = tests[name]
        for index in range(first, last + 1):
            kept[index] = ""
    return "\n".join(kept) + "\n"


def compile_file(builder, file, left_out):
    """(the program, or what the compiler says; tests that are not compiled)"""
    path = builder.checkout / "tests" / file
    lines = path.read_text().splitlines()
    tests = ranges(lines)
    missing = set()
    copy = builder.work / file
    relative = re.compile(r'#include "(\.\./[^"]*|include/[^"]*)"')
    said = ""
    for _ in range(12):
        text = without(lines, tests, [it for it in [*left_out, *missing] if it in tests])
        text = relative.sub(lambda it: f'#include "{(path.parent / it[1]).resolve()}"', text)
        copy.write_text(f'#line 1 "{file}"\n{text}')
        done = builder.compile(copy, copy.with_suffix(".o"), "-fmax-errors=400", "-fno-show-column")
        if done.returncode == 0:
            return builder.link(path.stem, [copy.with_suffix(".o")]), tests, missing, said
        said += done.stderr
        # An error is in the test that it names, or that what it names was required from.
        wrong = {int(it) - 1 for it in re.findall(rf"(?:^|[ /]){re.escape(file)}:(\d+):", done.stderr, re.M)}
        more = {name for name, (first, last) in tests.items() if any(first <= it <= last for it in wrong)} - missing
        if not more:
            return done.stderr, tests, set(tests), said
        missing |= more
    return said, tests, set(tests), said


def run(program, name):
    try:
        done = subprocess.run([program, f"--gtest_filter={name}"], capture_output=True, text=True, errors="replace",
                              timeout=SECONDS, cwd=program.parent, stdin=subprocess.DEVNULL)
    except subprocess.TimeoutExpired:
        return "fails", f"it takes longer than {SECONDS} s"
    return ("passes" if done.returncode == 0 and "[  PASSED  ] 1 test" in done.stdout else "fails",
            done.stdout + done.stderr + (f"\nended with {done.returncode}" if done.returncode else ""))


def main():
    given = arguments()
    check_commit(given.checkout)
    expected = read_list()
    builder = Builder(given)
    files = sorted(it.name for it in (given.checkout / "tests").glob("*.cpp") if given.only in it.name)
    if not files:
        refuse(f"no file has '{given.only}' in its name")
    print(f"test-btcpp: {len(files)} files", file=sys.stderr)
    builder.shared()
    found = {}

    def one(file):
        listed = expected.get(file, {})
        left_out = [name for name, (verdict, _) in listed.items() if verdict == "is left out"]
        every = ranges((builder.checkout / "tests" / file).read_text().splitlines())
        if set(left_out) >= set(every):
            return file, {name: listed[name] for name in every}, ""
        program, tests, missing, said = compile_file(builder, file, left_out)
        verdicts, texts = {}, said if missing else ""
        if not isinstance(program, pathlib.Path):
            texts = program
            missing = set(tests)
        for name in tests:
            _, reason = listed.get(name, ("", ""))
            if name in left_out:
                verdicts[name] = listed[name]
            elif name in missing:
                verdicts[name] = ("is not compiled", reason)
            else:
                verdict, text = run(program, name)
                verdicts[name] = (verdict, reason if verdict == "fails" else "")
                if verdict == "fails":
                    texts += f"--- {name}\n{text}\n"
        return file, verdicts, texts

    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for file, verdicts, texts in pool.map(one, files):
            found[file] = verdicts
            kinds = [verdict for verdict, _ in verdicts.values()]
            counted = [it for it in kinds if it != "is left out"]
            print(f"{file:45} {kinds.count('passes'):4} of {len(counted):3}"
                  + (f", {kinds.count('is not compiled')} not compiled" if "is not compiled" in kinds else ""))
            sys.stdout.flush()
            (builder.work / f"{file}.txt").write_text(texts)
            if given.verbose and texts:
                print(texts)
    worse = [(file, name, old[0], verdicts[name][0]) for file, verdicts in found.items()
             for name, old in expected.get(file, {}).items()
             if name in verdicts and old[0] == "passes" and verdicts[name][0] != "passes"]
    better = [(file, name, expected[file][name][0], it[0]) for file, verdicts in found.items()
              for name, it in verdicts.items()
              if it[0] == "passes" and expected.get(file, {}).get(name, ("passes",))[0] != "passes"]
    every = [it for verdicts in found.values() for it, _ in verdicts.values()]
    for file, name, old, new in worse + better:
        print(f"{file}: {name} {new}; it was listed as: {old}")
    print(f"{every.count('passes')} of {len(every) - every.count('is left out')} pass; "
          f"{every.count('is left out')} are left out")
    if given.update:
        write_list({**expected, **found})
        return 0
    if better:
        print("test-btcpp: more pass than are listed: ./dev test-btcpp CHECKOUT --update", file=sys.stderr)
    return 1 if worse else 0


sys.exit(main())
