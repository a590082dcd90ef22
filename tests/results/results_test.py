"""tests/results/results.py on files of ctest itself: results_test.py CTEST."""
import pathlib
import subprocess
import sys
import tempfile

CTEST, SCRIPT = sys.argv[1], pathlib.Path(__file__).with_name("results.py")


def ran(folder, tests):
    """The file of these tests: (name, command, properties)."""
    folder.mkdir()
    (folder / "CTestTestfile.cmake").write_text("".join(
        f'add_test("{name}" {command})\nset_tests_properties("{name}" PROPERTIES {properties})\n'
        for name, command, properties in tests))
    file = folder / "results.xml"
    subprocess.run([CTEST, "--test-dir", folder, "--output-junit", file], capture_output=True)
    return file


def table(*arguments):
    done = subprocess.run([sys.executable, SCRIPT, *arguments], capture_output=True, text=True)
    assert done.stderr == "", done.stderr
    # The seconds are of this machine.
    lines = [line.rsplit(None, 1)[0] if line.startswith(("one", "other")) else line for line in done.stdout.splitlines()]
    return done.returncode, lines


with tempfile.TemporaryDirectory() as directory:
    directory = pathlib.Path(directory)
    good = ran(directory / "good", [("unit: <b> & c", "true", "TIMEOUT 9"), ("unit: a", "true", "TIMEOUT 9")])
    mixed = ran(directory / "mixed", [
        ("cli: fails", "false", "TIMEOUT 9"), ("cli:passes", "true", "TIMEOUT 9"), ("cli: too long", "sleep 9", "TIMEOUT 0.1"),
        ("cli: crashes", 'sh -c "kill -SEGV \\$\\$"', "TIMEOUT 9"), ("help: not here", 'sh -c "exit 77"', "SKIP_RETURN_CODE 77"),
        ("web_NOT_BUILT", "/nowhere/web", "TIMEOUT 9")])

    code, lines = table(f"one={good}")
    assert code == 0, lines
    assert lines == ["     tests  passed  failed  skipped  seconds", "one  unit        2       0        0",
                     "one  all         2       0        0"], lines

    code, lines = table(f"one={good}", f"other={mixed}", f"third={directory / 'absent'}")
    assert code == 1, lines
    assert [line.split() for line in lines[3:7]] == [
        ["other", "cli", "1", "3", "0"], ["other", "help", "0", "0", "1"], ["other", "web_NOT_BUILT", "0", "1", "0"],
        ["other", "all", "1", "4", "1"]], lines
    assert lines[8:] == ["skipped, other: help: not here", "failed, third: no test ran", "failed, other: web_NOT_BUILT",
                         "failed, other: cli: too long", "failed, other: cli: fails", "failed, other: cli: crashes"], lines
