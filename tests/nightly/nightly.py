"""Runs what is too slow for ./dev test, and writes a table of what ran and what failed: build/nightly/report.md.

usage: ./dev nightly [--list] [--fuzz-seconds N] [STEP…]

Without a STEP it runs every step that has not run at this commit, and continues a step that was stopped: each step consists of
parts, and a part that has ended does not run again. With a STEP it runs this step alone, from its beginning if it has ended.
--list prints the table of the last runs. Each fuzz target runs for N seconds, 600 when absent. The exit code is 1 if a part failed.

Examples: ./dev nightly
          ./dev nightly asan fuzz --fuzz-seconds 60"""
import argparse
import datetime
import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import time

SOURCE = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(SOURCE / "tests/results"))
import results  # noqa: E402

TREES, SMALL_TREES, TIMES, SOAK_MINUTES, TEAM_MINUTES, MUTANTS, TEAMS = 200_000, 500_000, 20, 60, 20, 60, 3_000
CUT_RUNS, CUT_RUNS_ON_THE_WALL_CLOCK = 20_000, 2_000
HEAD = """\
# Nightly

Times are UTC. A step without a time has never run here. `./dev nightly` runs the steps that have not run at the current commit.

| Step | What it runs | Commit | Began | Minutes | Result |
|---|---|---|---|---:|---|
"""


def commit():
    """What is tested: two runs at the same commit with changes are not told apart."""
    def git(*arguments):
        return subprocess.run(["git", "-C", SOURCE, *arguments], capture_output=True, text=True).stdout.strip()
    changes = git("status", "--porcelain", "--untracked-files=no")
    return (git("rev-parse", "--short=8", "HEAD") or "no commit") + (" with changes" if changes else "")


# A step is (what, parts, missing): `parts` is a generator of (name, command), which may look at what the parts before have
# built; `missing` returns why the step cannot run here, or "".

def one(*command):
    return lambda options: iter([("all", command)])


def is_here():
    return ""


def sanitized(preset):
    def parts(_):
        yield "build", ("./dev", "sanitize-build", preset)
        listed = subprocess.run(["ctest", "--test-dir", f"build/{preset}", "-N"], cwd=SOURCE, capture_output=True, text=True).stdout
        for program in dict.fromkeys(re.findall(r"Test +#\d+: ([^:\n]+)", listed)):
            yield program, ("ctest", "--test-dir", f"build/{preset}", "-R", f"^{re.escape(program)}(:|$)", "--output-on-failure",
                            "-j", str(os.cpu_count() + 4), "--output-junit", "{junit}")
    return parts


def fuzzed(options):
    for target in re.findall(r"^ *lockstep_fuzz\((\w+)", (SOURCE / "tests/fuzz/CMakeLists.txt").read_text(), re.MULTILINE):
        yield target, ("./dev", "fuzz", str(options.fuzz_seconds), target)


def random_trees(command, count):
    """Other trees each day."""
    return lambda _: iter([("all", ("./dev", command, str(count), str(int(time.time()) // 86400 * count)))])


def more_trials(_):
    """Of the test programs with tests that are tagged so (support/trials.h)."""
    for program in sorted({file.parent.name for file in (SOURCE / "tests").glob("*/*_test.cpp") if '"[trials]")' in file.read_text()}):
        yield program, ("env", f"LOCKSTEP_TRIALS={TIMES}", f"build/release/tests/test_{program}", "[trials]")


def cut_runs(_):
    command = ("python3", "tests/reliability/cuts.py", "build/release/lockstep", "build/release/plugins")
    yield "virtual clock", (*command, str(CUT_RUNS))
    yield "wall clock", (*command, str(CUT_RUNS_ON_THE_WALL_CLOCK), "--wall")
    yield "power failures", ("build/release/tests/torn_writes", "build/release/tests/reliability", "10000")


def checkout_of_btcpp():
    return pathlib.Path(os.environ.get("BTCPP_CHECKOUT", SOURCE.parent / "BehaviorTree.CPP"))


def btcpp_is_missing():
    return "" if checkout_of_btcpp().exists() else "no checkout of BehaviorTree.CPP in BTCPP_CHECKOUT"


def public_trees():
    return pathlib.Path(os.environ.get("PUBLIC_TREES", SOURCE.parent / "public_trees"))


def public_trees_are_missing():
    return "" if public_trees().exists() else "no folder with sets of public trees in PUBLIC_TREES"


def ros2_is_missing():
    found = subprocess.run(["tests/ros2/run.sh", "--found"], cwd=SOURCE, capture_output=True, text=True)
    return found.stdout.strip() if found.returncode else ""


STEPS = {
    "test": ("every test, also those that `./dev test` may leave out", one("./dev", "test", "--all"), is_here),
    "asan": ("every test under ASan and UBSan", sanitized("sanitize"), is_here),
    "tsan": ("every test under TSan", sanitized("thread"), is_here),
    "fuzz": ("each fuzz target, with ASan and UBSan", fuzzed, is_here),
    "tidy": ("clang-tidy over all sources, and unused includes", one("./dev", "tidy"), is_here),
    "property": (f"{TREES:,} random trees against the reference interpreters", random_trees("property", TREES), is_here),
    "judge": (f"{SMALL_TREES:,} small trees: `verify` against all their runs", random_trees("judge", SMALL_TREES), is_here),
    "trials": (f"the other tests of random trees, with {TIMES} times as many", more_trials, is_here),
    "mutants": (f"{MUTANTS} changes of the engine, each of which a test must notice",
                one("tests/mutants/mutants.py", str(MUTANTS)), is_here),
    "resume mutants": ("breaks of the rules of resuming, each of which a test must notice",
                       one("tests/mutants/mutants.py", "tests/mutants/resume.txt"), is_here),
    "btcpp": ("the tests of BehaviorTree.CPP over the headers of lockstep",
              lambda _: iter([("all", ("./dev", "test-btcpp", str(checkout_of_btcpp())))]), btcpp_is_missing),
    "public trees": ("a mistake in each of the trees in a folder of public repositories, which `check` must find and mend",
                     lambda _: iter([("all", ("python3", "tests/public_trees/public_trees.py", "build/release/lockstep",
                                              str(public_trees()), "--list"))]), public_trees_are_missing),
    "ros2": ("leaves against real servers of ROS 2", one("./dev", "test-ros2"), ros2_is_missing),
    "python": ("the Python module with Python 3.9", one("./dev", "test-python"), is_here),
    "cuts": (f"{CUT_RUNS + CUT_RUNS_ON_THE_WALL_CLOCK:,} runs of random trees that are killed and continue", cut_runs, is_here),
    "team": (f"eight robots in step, against eight alone, for {TEAM_MINUTES} minutes",
             one("python3", "tests/team/load.py", "build/release/lockstep", str(TEAM_MINUTES)), is_here),
    "teams verified": (f"{TEAMS:,} random teams: `verify` of all robots against what they do",
                       lambda _: iter([("all", ("python3", "tests/team/verify_judge.py", "build/release/lockstep", str(TEAMS),
                                                str(int(time.time()) // 86400 * TEAMS), "8"))]), is_here),
    "soak": (f"random faults at 1 kHz for {SOAK_MINUTES} minutes", one("./dev", "soak", str(SOAK_MINUTES)), is_here),
    "bench": ("the benchmarks, which neither pass nor fail", one("./dev", "bench"), is_here),
}


class Nightly:
    """What has run, in a file: of each step the commit, and of each part of it when it began, how long it took and its exit code."""

    def __init__(self, folder, steps, options):
        self.folder, self.steps, self.options = folder, steps, options
        self.commit = commit()
        self.file = folder / "state.json"
        folder.mkdir(parents=True, exist_ok=True)
        self.ran = json.loads(self.file.read_text()) if self.file.exists() else {}

    def path(self, step, part, suffix):
        return self.folder / step / (re.sub(r"\W", "_", part) + suffix)

    def has_ended(self, step):
        record = self.ran.get(step, {})
        return record.get("commit") == self.commit and record.get("ended", False)

    def run(self, step):
        """What had ended of this step at this commit does not run again."""
        _, parts, missing = self.steps[step]
        if missing():
            return
        if self.ran.get(step, {}).get("commit") != self.commit:
            self.ran[step] = {"commit": self.commit, "parts": {}}
        record = self.ran[step]
        for part, command in parts(self.options):
            if part not in record["parts"]:
                record["parts"][part] = self.run_part(step, part, command)
                self.save()
        record["ended"] = True
        self.save()

    def run_part(self, step, part, command):
        log, junit = self.path(step, part, ".log"), self.path(step, part, ".xml")
        log.parent.mkdir(exist_ok=True)
        junit.unlink(missing_ok=True)
        command = [str(junit) if word == "{junit}" else word for word in command]
        print(f"nightly: {step}, {part}: {' '.join(command)}", file=sys.stderr, flush=True)
        began = time.time()
        with log.open("w") as output:
            process = subprocess.Popen(command, cwd=SOURCE, stdin=subprocess.DEVNULL, stdout=output, stderr=subprocess.STDOUT,
                                       start_new_session=True)
            try:
                code = process.wait()
            except BaseException:
                os.killpg(process.pid, signal.SIGTERM)
                process.wait()
                raise
        return {"began": began, "seconds": time.time() - began, "code": code}

    def save(self):
        self.file.write_text(json.dumps(self.ran, indent=1))
        (self.folder / "report.md").write_text(self.report())

    def failures(self, step):
        """A line for each part that failed, and for each test that did."""
        for part, run in self.ran.get(step, {}).get("parts", {}).items():
            if run["code"] == 0:
                continue
            tests = [name for name, outcome, _ in results.read(self.path(step, part, ".xml")) if outcome == "failed"]
            log = self.path(step, part, ".log")
            yield f"{step}, {part}: exit code {run['code']}; {log.relative_to(self.folder.parent.parent)}"
            yield from (f"{step}: {name}" for name in sorted(tests))

    def result(self, step):
        record = self.ran[step]
        parts = record["parts"]
        failed = sum(run["code"] != 0 for run in parts.values())
        words = [f"{failed} of {len(parts)} parts failed" if failed else "passed"]
        if not record.get("ended"):
            words = [f"stopped after {len(parts)} parts" + (f", {failed} failed" if failed else "")]
        outcomes = [outcome for part in parts for _, outcome, _ in results.read(self.path(step, part, ".xml"))]
        if outcomes:
            words += [f"{outcomes.count(outcome):,} {outcome}" for outcome in ("passed", "failed", "skipped")]
        executed = [int(count) for part in parts
                    for count in re.findall(r"stat::number_of_executed_units: (\d+)", self.log(step, part))]
        if executed:
            words.append(f"{sum(executed):,} executions")
        words += [line for part in parts for line in re.findall(r"^(\d+ passed, \d+ failed|\d+ of \d+ mutants .*|.* mistakes found, .*)$",
                                                                self.log(step, part), re.MULTILINE)[-1:]]
        return "; ".join(words)

    def log(self, step, part):
        try:
            return self.path(step, part, ".log").read_text(errors="replace")
        except OSError:
            return ""

    def report(self):
        rows, failed = [], []
        for step, (what, _, missing) in self.steps.items():
            runs = self.ran.get(step, {}).get("parts", {}).values()
            if runs:
                began = datetime.datetime.fromtimestamp(min(run["began"] for run in runs), datetime.timezone.utc)
                minutes = sum(run["seconds"] for run in runs) / 60
                rows.append((step, what, self.ran[step]["commit"], f"{began:%Y-%m-%d %H:%M}", f"{minutes:.1f}", self.result(step)))
                failed += self.failures(step)
            else:
                rows.append((step, what, "", "", "", missing() or "never run"))
        text = HEAD + "".join(f"| {' | '.join(row)} |\n" for row in rows)
        if failed:
            text += "\n## Failed\n\n" + "".join(f"- {line}\n" for line in failed)
        return text + ("\nNot a part of it, as they change the machine: `./dev package --try`, `./dev test-slurm`, "
                       "`./dev test-container` and `./dev test-service`, as root.\n")


def stop(*_):
    raise KeyboardInterrupt


def main(arguments, folder=SOURCE / "build/nightly", steps=None):
    steps = steps or STEPS
    parser = argparse.ArgumentParser(prog="./dev nightly", description=__doc__, usage=argparse.SUPPRESS,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--list", action="store_true", help=argparse.SUPPRESS)
    parser.add_argument("--fuzz-seconds", type=int, default=600, help=argparse.SUPPRESS)
    parser.add_argument("steps", nargs="*", help=argparse.SUPPRESS)
    options = parser.parse_args(arguments)
    unknown = [step for step in options.steps if step not in steps]
    if unknown:
        print(f"nightly: no step '{unknown[0]}'; steps are {', '.join(steps)}", file=sys.stderr)
        return 2
    nightly = Nightly(folder, steps, options)
    if options.list:
        print(nightly.report(), end="")
        return 0
    signal.signal(signal.SIGTERM, stop)
    try:
        for step in options.steps:
            if nightly.has_ended(step):
                nightly.ran.pop(step)
            nightly.run(step)
        for step in steps if not options.steps else ():
            if not nightly.has_ended(step):
                nightly.run(step)
    except KeyboardInterrupt:
        print("nightly: stopped; ./dev nightly continues here", file=sys.stderr)
        return 130
    finally:
        nightly.save()
    print(nightly.report(), end="")
    return 1 if any(True for step in options.steps or steps for _ in nightly.failures(step)) else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
