"""Runs, studies and recordings of lockstep from Python.

    import lockstep
    run = lockstep.run("trees/door_pulling.xml", args={"slack": 0.4}, seed=7, record="run.jsonl")
    print(run.result, run.ticks)
    table = lockstep.read("run.jsonl")              # a row for each tick and active node
    runs = lockstep.study("trees/paper/example5.xml", runs=100, grid={"barrier_count": [0, 5]})

Tables are pandas.DataFrame where pandas is installed, otherwise lists of dicts. The program lockstep is
found by the variable LOCKSTEP, next to this package, or in PATH. docs/programs.md has the leaves.
"""
import csv
import io
import json
import os
import pathlib
import subprocess
import tempfile

from lockstep_leaf import _plain

from ._error import Error
from ._program import library, program
from ._nodes import Entries, Node
from ._project import Diagnostic, Project
from ._trees import Tree

__all__ = ["Diagnostic", "Entries", "Error", "Node", "Project", "Run", "Tree", "library", "program", "read",
           "read_study", "run", "study"]


class Run:
    "How a run has ended: what `lockstep run --json` prints, as attributes."

    def __init__(self, summary, code, messages):
        self.summary, self.code, self.messages = summary, code, messages

    def __getattr__(self, name):
        try:
            return self.summary[name]
        except KeyError:
            raise AttributeError(name) from None

    def __repr__(self):
        return f"<lockstep run: {self.result} after {self.ticks} ticks>"


def _call(words, good=(0,)):
    done = subprocess.run([program(), *map(str, words)], capture_output=True, text=True)
    if done.returncode not in good:
        raise Error(done.returncode, done.stderr)
    return done


def _options(**options):
    "--max-ticks 10 for max_ticks=10; a dict or a list is given several times."
    words = []
    for name, value in options.items():
        option = "--" + name.replace("_", "-")
        if value is True:
            words.append(option)
        elif isinstance(value, dict):
            for key, it in value.items():
                words += [option, f"{key}={_plain(it)}"]
        elif isinstance(value, (list, tuple)):
            for it in value:
                words += [option, _plain(it)]
        elif value is not None and value is not False:
            words += [option, _plain(value)]
    return words


def run(tree, args=None, *, set=None, seed=0, clock="virtual", plugins=(), plugin_path=(), record=None,
        **options):
    """Runs a tree. `options` are those of `lockstep run`: max_ticks=100, on_fault="fail", isolate=True.
    A fault of a leaf raises Error, as a tree that is wrong does. `code` of the Run is the exit code."""
    words = _options(arg=args or {}, set=set or {}, seed=seed, clock=clock, plugin=plugins,
                     plugin_path=plugin_path, record=record, **options)
    done = _call(["run", tree, "--json", "--view", "none", *words], good=(0, 1, 7, 8, 10, 124, *range(129, 160)))
    return Run(json.loads(done.stdout), done.returncode, done.stderr)


def study(tree, *, runs=None, grid=None, args=None, measure=(), out=None, plots=False, **options):
    """Makes a study, and returns a row for each run, as read_study does. `grid` has lists of values:
    {"noise": [0, 0.05]}. Without `out` its directory is temporary."""
    axes = {name: _axis(name, values) for name, values in (grid or {}).items()}
    words = _options(runs=runs, grid=axes, arg=args or {}, measure=measure, no_plots=not plots, **options)
    with tempfile.TemporaryDirectory() as directory:
        where = out or os.path.join(directory, "study")
        _call(["study", tree, "--out", where, *words])
        return read_study(where)


def _axis(name, values):
    texts = [_plain(it) for it in values]
    for text in texts:
        if "," in text:
            raise ValueError(f"the grid of '{name}' has the value {text!r}, which --grid splits at its commas")
    return ",".join(texts)


def read(recording):
    "A recording as a table: tick, time_s, node, path, status, progress, ticked, held, results."
    return _table(_call(["log", "csv", recording]).stdout, flags=("ticked", "held"))


def read_study(directory, table="runs"):
    'The runs of a study ("runs"), or what its cells have in common ("summary").'
    file = pathlib.Path(directory) / f"{table}.csv"
    if table == "runs" and not file.exists() and (file.parent / "study.json").exists():
        raise FileNotFoundError(f"no '{file}': the study was made with --rows zst (unpack it: zstd -d '{file}.zst') or "
                                "with --rows none, which has a summary only")
    text = file.read_text(encoding="utf-8")
    names = next(csv.reader(io.StringIO(text)), [])
    begin, end = (1, "run") if table == "runs" else (0, "node")
    return _table(text, arguments=names[begin:names.index(end)] if end in names else ())


def _table(text, flags=(), arguments=()):
    """A DataFrame, or a list of dicts. A column has numbers, or texts where one of its values is none. What is left
    out of numbers is None, or NaN; an argument may be empty, which is a value like any other."""
    try:
        import pandas
    except ImportError:
        names, *rows = csv.reader(io.StringIO(text))
        columns = [_column(name, values, flags, arguments) for name, values in zip(names, zip(*rows))]
        return [dict(zip(names, row)) for row in zip(*columns)]
    names = next(csv.reader(io.StringIO(text)))
    table = pandas.read_csv(io.StringIO(text), dtype=dict.fromkeys(arguments, str), keep_default_na=False,
                            float_precision="round_trip",
                            na_values={name: [""] for name in names if name not in arguments})
    for name in arguments:
        table[name] = _column(name, table[name], flags, arguments)
    return table.astype(dict.fromkeys(flags, bool))


def _column(name, values, flags, arguments):
    if name in flags:
        return [it == "1" for it in values]
    for kind in (int, float):
        try:
            return [None if it == "" and name not in arguments else kind(it) for it in values]
        except ValueError:
            pass
    return list(values)
