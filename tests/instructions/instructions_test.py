#!/usr/bin/env python3
"""Counts the instructions of a tick for each leaf, of a study for each tick, and of loading for
each leaf, and compares them with a table.

    instructions_test.py DRIVER TABLE COMPILER [--write]
    instructions_test.py DRIVER

Without a table the counts are printed. The table holds for one compiler, C library and processor;
elsewhere the test is skipped. A case fails when it takes 2 % more than the table says. --write
writes the table.
"""
import glob
import os
import platform
import shutil
import subprocess
import sys
import tempfile

MOST = 1.02


def counts(driver):
    """The instructions of each case, by its name."""
    with tempfile.TemporaryDirectory() as where:
        out = os.path.join(where, "out")
        ran = subprocess.run(
            ["valgrind", "--tool=callgrind", "--toggle-collect=measured",
             "--dump-after=measured", "--callgrind-out-file=" + out, driver],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=True)
        found = {}
        for number, line in enumerate(ran.stdout.splitlines(), 1):
            parts, name = line.split(maxsplit=1)
            with open(f"{out}.{number}", encoding="ascii") as dump:
                total = next(line for line in dump if line.startswith("summary:"))
            found[name] = int(total.split()[1]) / int(parts)
        assert len(found) == len(glob.glob(out + ".*")), ran.stdout
        return found


def as_rows(found):
    return "".join(f"{count:7.1f}  {name}\n" for name, count in found.items())


def main():
    if len(sys.argv) == 2:
        print(as_rows(counts(sys.argv[1])), end="")
        return 0
    driver, table, compiler = sys.argv[1:4]
    here = f"{compiler}, {' '.join(platform.libc_ver())}, {platform.machine()}"
    if shutil.which("valgrind") is None:
        print("skipped: there is no valgrind")
        return 77
    if "--write" in sys.argv:
        with open(table, "w", encoding="ascii") as file:
            file.write(f"{here}\n{as_rows(counts(driver))}")
        return 0
    with open(table, encoding="ascii") as file:
        there, *rows = file.read().splitlines()
    if here != there:
        print(f"skipped: the table is for {there}; this is {here}")
        return 77
    expected = {row.split(maxsplit=1)[1]: float(row.split()[0]) for row in rows}
    found = counts(driver)
    wrong = expected.keys() ^ found.keys()
    for name in sorted(wrong):
        print(f"in one of table and driver only: {name}")
    for name in expected.keys() & found.keys():
        sign = "more" if found[name] > MOST * expected[name] else ""
        print(f"{expected[name]:7.1f} {found[name]:7.1f}  {name} {sign}")
        wrong = wrong or sign != ""
    if wrong:
        print("It takes more instructions than before. If it must, write the table: "
              f"{os.path.basename(__file__)} DRIVER TABLE COMPILER --write")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
