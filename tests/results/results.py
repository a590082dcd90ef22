"""A table of what ran and what failed, from the files that `ctest --output-junit` writes.

usage: results.py NAME=FILE…

A row for each program of tests in each file: the words of a test's name before its colon. Below it, each test that failed or was
skipped, by name. The exit code is 1 if a test failed, or if a file is absent or has no test: then its build has failed."""
import sys
import xml.etree.ElementTree as xml
from collections import defaultdict

HEAD = ("", "tests", "passed", "failed", "skipped", "seconds")


class Row:
    def __init__(self):
        self.passed, self.failed, self.skipped, self.seconds = 0, 0, 0, 0.0

    def count(self, outcome, seconds):
        setattr(self, outcome, getattr(self, outcome) + 1)
        self.seconds += seconds

    def cells(self, name, tests):
        return (name, tests, str(self.passed), str(self.failed), str(self.skipped), f"{self.seconds:.0f}")


def outcome_of(case):
    if case.get("status") == "run":
        return "passed"
    skipped = case.find("skipped")
    is_absent = skipped is not None and skipped.get("message", "").startswith("Unable to find executable")
    return "failed" if is_absent or case.get("status") == "fail" else "skipped"


def read(file):
    """(name, outcome, seconds) of each test."""
    try:
        cases = xml.parse(file).getroot().iter("testcase")
    except (OSError, xml.ParseError):
        return []
    return [(it.get("name"), outcome_of(it), float(it.get("time") or 0)) for it in cases]


def main(arguments):
    table, notes, failed = [HEAD], [], False
    for name, file in (it.split("=", 1) for it in arguments):
        tests = read(file)
        rows, whole = defaultdict(Row), Row()
        for test, outcome, seconds in sorted(tests):
            for row in (rows[test.split(":")[0]], whole):
                row.count(outcome, seconds)
            if outcome != "passed":
                notes.append(f"{outcome}, {name}: {test}")
        table += [row.cells(name, program) for program, row in rows.items()]
        table.append(whole.cells(name, "all"))
        if not tests:
            notes.append(f"failed, {name}: no test ran")
        failed = failed or not tests or whole.failed > 0
    widths = [max(map(len, column)) for column in zip(*table)]
    for row in table:
        cells = [it.ljust(width) if at < 2 else it.rjust(width) for at, (it, width) in enumerate(zip(row, widths))]
        print("  ".join(cells).rstrip())
    for note in sorted(notes, reverse=True):  # those that failed are last, where one looks first
        print(note)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
