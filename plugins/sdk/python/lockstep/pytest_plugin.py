"""For pytest: each scenario in a NAME.test.xml is a test. pip installs it with the package; without pip, write
`pytest -p lockstep.pytest_plugin`. `lockstep test` plays the scenarios of a file at once, when the first one runs."""
import json
import os
import subprocess

import pytest

from ._program import program


def pytest_addoption(parser):
    group = parser.getgroup("lockstep", "scenarios of trees")
    group.addoption("--lockstep-option", action="append", default=[], metavar="OPTION",
                    help="an option of `lockstep test`, as --lockstep-option=--plugin-path=build; may be repeated")


def pytest_collect_file(file_path, parent):
    if file_path.name.endswith(".test.xml"):
        return ScenarioFile.from_parent(parent, path=file_path)
    return None


def _test(*words):
    return subprocess.run([program(), "test", *map(os.fspath, words)], capture_output=True, text=True, check=False)


class ScenarioFile(pytest.File):
    def collect(self):
        listed = _test("--list", self.path)
        if listed.returncode != 0:
            raise self.CollectError(listed.stderr)
        for line in listed.stdout.splitlines():
            place, _, name = line.partition(": ")
            yield Scenario.from_parent(self, name=name, line=int(place.rsplit(":", 2)[-2]))

    def results(self):
        "By name; played once."
        if not hasattr(self, "_results"):
            played = _test("--json", *self.config.getoption("--lockstep-option"), self.path)
            if not played.stdout:
                raise ScenarioError(played.stderr)
            self._results = {it["name"]: it for it in json.loads(played.stdout)["scenarios"]}
        return self._results


class ScenarioError(Exception):
    "A scenario is not as expected."


class Scenario(pytest.Item):
    def __init__(self, *, line, **rest):
        super().__init__(**rest)
        self._line = line

    def runtest(self):
        result = self.parent.results()[self.name]
        if result["outcome"] == "passed":
            return
        lines = []
        for failure in result.get("failures", []):
            lines.append(f"{failure['place']}: {failure['message']}")
            lines += [f"  {line}" for line in failure["more"]]
        if "recording" in result:
            lines.append(f"lockstep replay {result['recording']}")
        raise ScenarioError("\n".join(lines))

    def repr_failure(self, excinfo):
        if isinstance(excinfo.value, ScenarioError):
            return str(excinfo.value)
        return super().repr_failure(excinfo)

    def reportinfo(self):
        return self.path, self._line - 1, self.name
