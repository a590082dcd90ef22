"""./dev nightly with steps of its own: nightly_test.py."""
import contextlib
import io
import pathlib
import sys
import tempfile

import nightly


def parts(*commands):
    return lambda _: iter(commands)


with tempfile.TemporaryDirectory() as directory:
    build = pathlib.Path(directory) / "build"
    folder, trace, stone = build / "nightly", build / "trace", build / "stone"
    build.mkdir()

    def note(word):
        return (word, ("sh", "-c", f"echo {word} >>{trace}"))

    # The middle part interrupts the run once, as Ctrl-C does.
    def interrupted(_):
        yield note("first")
        if not stone.exists():
            stone.touch()
            raise KeyboardInterrupt
        yield note("second")

    steps = {
        "good": ("a step that passes", parts(note("good")), nightly.is_here),
        "stopped": ("a step of two parts", interrupted, nightly.is_here),
        "bad": ("a step that fails", parts(note("bad"), ("fails", ("sh", "-c", "echo reason; exit 3"))), nightly.is_here),
        "absent": ("a step that cannot run here", parts(note("absent")), lambda: "there is no robot"),
    }

    def run(*arguments):
        with contextlib.redirect_stdout(io.StringIO()) as out, contextlib.redirect_stderr(io.StringIO()) as err:
            code = nightly.main(list(arguments), folder, steps)
        return code, out.getvalue(), err.getvalue()

    def rows():
        return {cells[1]: cells[2:-1] for cells in (
            [cell.strip() for cell in line.split("|")] for line in (folder / "report.md").read_text().splitlines()) if len(cells) > 3}

    code, out, _ = run("--list")
    assert code == 0 and "never run" in out and not trace.exists(), out

    code, _, err = run()
    assert code == 130 and "./dev nightly continues here" in err, err
    assert trace.read_text().split() == ["good", "first"]
    assert rows()["stopped"][-1] == "stopped after 1 parts", rows()
    assert rows()["bad"][-1] == "never run", rows()

    # It continues: nothing that has ended runs again.
    code, out, _ = run()
    assert code == 1
    assert trace.read_text().split() == ["good", "first", "second", "bad"]
    assert out == (folder / "report.md").read_text()
    assert rows()["good"][-1] == "passed" and rows()["stopped"][-1] == "passed", rows()
    assert rows()["bad"][-1] == "1 of 2 parts failed", rows()
    assert rows()["absent"][-1] == "there is no robot", rows()
    assert "- bad, fails: exit code 3; build/nightly/bad/fails.log" in out, out
    assert (folder / "bad/fails.log").read_text() == "reason\n"

    # Of all that has ended, only what is named runs again.
    code, _, _ = run()
    assert code == 1 and len(trace.read_text().split()) == 4
    code, _, _ = run("stopped")
    assert code == 0 and trace.read_text().split()[4:] == ["first", "second"]

    # At another commit all of it.
    nightly.commit = lambda: "another"
    code, _, _ = run()
    assert code == 1 and trace.read_text().split()[6:] == ["good", "first", "second", "bad"]
    assert rows()["good"][1] == "another", rows()

    code, _, err = run("nonsense")
    assert code == 2 and err == "nightly: no step 'nonsense'; steps are good, stopped, bad, absent\n", err
