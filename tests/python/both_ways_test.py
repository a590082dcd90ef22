"""The same leaves in Python as a process plugin and in a lockstep.Tree: the recordings are equal, with results, faults,
reasons, log lines and values. The variable LOCKSTEP_TREES is the number of random trees."""
import importlib.util
import json
import os
import pathlib
import random
import re
import sys
import tempfile
import unittest
from xml.sax.saxutils import quoteattr

import lockstep

PROGRAMS = pathlib.Path(__file__).resolve().parents[1] / "programs"
TREES = 20
OF_LOCKSTEP = re.compile("; counted as Failure$|^the action '.*started and halted")


def leaves():
    spec = importlib.util.spec_from_file_location("both_ways", PROGRAMS / "both_ways.py")
    module = sys.modules["both_ways"] = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


LEAVES = leaves()


def element(name, inside="", **attributes):
    words = "".join(f" {key.replace('__', '.')}={quoteattr(value)}" for key, value in attributes.items())
    return f"<{name}{words}>{inside}</{name}>"


def recorded(file):
    "What a recording has of the leaves: everything but its header."
    if not os.path.exists(file):
        return None
    with open(file, encoding="utf-8") as lines:
        rows = [json.loads(line) for line in lines][1:]
    for row in rows:  # the command prints elsewhere what lockstep itself has found
        for part in (row, row.get("end", {})):
            part["logs"] = [it for it in part.get("logs", ()) if not OF_LOCKSTEP.search(it[2])]
    return rows


class BothWays(unittest.TestCase):
    def both(self, nodes, on_fault="stop", seed=1):
        "The rows of the recordings, after those are compared."
        with tempfile.TemporaryDirectory() as folder:
            tree = os.path.join(folder, "tree.xml")
            pathlib.Path(tree).write_text('<root lockstep="1"><plugin name="both_ways" program="both_ways.py"/>'
                                          f'<BehaviorTree ID="Main">{nodes}</BehaviorTree></root>', encoding="utf-8")
            files = [os.path.join(folder, it) for it in ("program.jsonl", "tree.jsonl")]
            ends = []
            try:
                run = lockstep.run(tree, record=files[0], plugin_path=PROGRAMS, seed=seed, on_fault=on_fault, max_ticks=60)
                ends.append((run.result, run.ticks))
            except lockstep.Error as error:
                ends.append(("error", error.code))
            try:
                with lockstep.Tree(tree, leaves=LEAVES, seed=seed, on_fault=on_fault, log=lambda *line: None) as it:
                    it.record(files[1])
                    run = it.run(max_ticks=60)
                    ends.append((run.result, run.ticks))
            except lockstep.Error as error:
                ends.append(("error", error.code))
            rows = [recorded(file) for file in files]
        self.assertEqual(ends[0], ends[1], nodes)
        self.maxDiff = None
        for line, (program, own) in enumerate(zip(*rows) if rows[0] else ()):
            self.assertEqual(program, own, f"line {line + 1} of {nodes}")
        self.assertEqual(rows[0], rows[1], nodes)
        return rows[0]

    def logs(self, nodes, **options):
        return [text for row in self.both(nodes, **options) or () for _, _, text in row["logs"]]

    def in_each_way(self, nodes):
        for on_fault in ("stop", "fail"):
            self.both(nodes, on_fault)

    def each(self, nodes):
        "All in one run: to start a program takes most of the time."
        self.both('<Fallback memory="true">' + "".join(f"<ForceFailure>{it}</ForceFailure>" for it in nodes) + "</Fallback>", "fail")

    def test_results_reasons_and_faults(self):
        for script in ("S", "F", "raise", "fail", "error", "odd", "X", "E", "0.5 0.2 raise", "0.5 error", "0.5 odd"):
            self.in_each_way(f'<Fallback memory="true">{act(script)}{act("S")}</Fallback>')
        for nodes in (element("Ends"), element("Ends", ok="false"),
                      *(element("Is", script=it) for it in ("S", "F", "N", "Q"))):
            self.in_each_way(nodes)
        reasons = [row["reasons"] for row in self.both(act("0.5 0.1 0.1 fail")) if "reasons" in row]
        self.assertEqual(reasons, [[[0, "at 0.5"]], [[0, ""]], [[0, "at 0.7"]], [[0, "returned"]]])

    def test_what_is_wrong_in_any_function(self):
        for where in ("__init__", "start", "tick", "progress", "none", "nan", "text", "halt", "no port", "input",
                      "set_pace", "pace", "pause", "resume"):
            fault, other = element("Fault", where=where), act("0.01")
            self.both(fault, "fail")
            for nodes in (fault, f'<Timeout seconds="0.01">{fault}</Timeout>',
                          f'<ParallelAbsolute barriers="0.15">{fault}{other}</ParallelAbsolute>',
                          f'<ParallelRelative delta="0.05" pace="true">{fault}{other}</ParallelRelative>'):
                self.both(nodes)

    def test_a_leaf_is_slowed(self):
        lines = self.logs(f'<ParallelRelative delta="0.1" pace="true">{act("0.02")}{act("0.1")}</ParallelRelative>')
        self.assertGreater(sum(line.startswith("pace 0.") for line in lines), 3)

    def test_log_lines(self):
        for how in ("log", "failed", "waiting", "error"):
            self.each(element("Says", text=text, how=how)
                      for text in ("'x'", "''", r"'a\0b'", r"'\udcff\ud800é'", "'x' * 5000", "'é' * 3000", "None", r"'\n'",
                                   "'x' * 40000"))
            self.both(element("Says", text="'x' * 2000000", how=how))
        self.both(element("Says", text="1", level="loud"))

    def test_values_of_each_type(self):
        values = {"flag": "true", "whole": str(-2**63), "real": "-0.0", "text": ' ü\u2028;\\"{x ', "flags": "true;false",
                  "wholes": f"1;{2**63 - 1}", "reals": "1;-0;1e300;0.1;5e-324", "texts": r"a\;b;;\ c ;"}
        outs = {f"to_{name}": f"{{{name}}}" for name in values}
        through = element("Pass", **{name: f"{{{name}}}" for name in values}, **outs)
        lines = self.logs(f'<Sequence memory="true">{element("Pass", **values, **outs)}{through}{through}</Sequence>')
        self.assertIn("reals [1.0, -0.0, 1e+300, 0.1, 5e-324]", lines)
        self.assertIn("real -0.0", lines)
        self.both(element("Pass", **outs))
        self.both(element("Pass"))
        for port, values in {"flag": ("1", "True"), "whole": ("1.0", "True", "2**63", "'1'", "-7"),
                             "real": ("1", "True", "float('inf')", "'1'", "None", "[1.0]", "10**400", "-0.0"),
                             "text": ("1", "b'x'", r"'a\0b'", r"'\udcff\ud800'", "''"),
                             "reals": ("1.0", "(1, 2)", "[1, 'x']", "[float('nan')]", "range(3)", "'ab'", "[True]"),
                             "limited": ("10", "9"), "nothing": ("3",), "value": ("'x'",)}.items():
            self.each(element("Sets", port=port, value=value) for value in values)
            if port not in ("nothing", "value"):
                self.each(element("Sets", port=port, value=value, **{port: "{it}"}) for value in values)

    def test_defaults(self):
        self.assertEqual(self.both(element("Defaults"))[-1]["end"]["result"], "success")

    def test_what_describe_is_given(self):
        self.assertIn("'reals': [10.0, 2.0, -0.0], 'texts': ['a', 'b;c', '', ' ', '\\\\']", self.logs(element(
            "Form", flag=" TRUE ", whole="+4", real="-0", text=" x ", flags="1, 0", wholes="1;2 3", reals="1e1,2;-0;",
            texts=r" a ; b\;c;;\  ;\\;", x__real="3", x__out="{o}"))[0])
        for port, values in {
                "text": ("refused", "wrong"), "flag": ("yes", ""), "flags": ("True False", "2"), "reals": ("1;;2", "."),
                "whole": ("1.0", "+-4", "9223372036854775808", "- 1", ""), "wholes": ("1;x", ";;", "1,,2"),
                "real": ("1e400", "1.", ".5", "1e", "inf", "nan", "0x1", "1_0", "٣", ""),
                "texts": ("", ";", ";;", " ; ", "a;", "\\", "a\\", r"\;", "\\ ", r"  \ x  ", " a b ", "a\tb;\n")}.items():
            for value in values:
                self.both(element("Form", **{port: value}))

    def test_random_trees(self):
        for seed in range(int(os.environ.get("LOCKSTEP_TREES", TREES))):
            choice = random.Random(seed)
            self.both(random_node(choice, 3), choice.choice(("stop", "fail")), seed)


def act(script, **ports):
    return element("Act", script=script, **{"count": "{count}", **ports})


def random_node(choice, depth):
    if depth == 0 or choice.random() < 0.15:
        if choice.random() < 0.2:
            return element("Is", script="".join(choice.choices("SF", (3, 1), k=choice.randint(1, 9))))
        words = choice.choices(("0", "0.1", "0.25", "0.3", "-0.1"), k=choice.randint(0, 8))
        last = choice.choices(("S", "F", "raise", "fail", "X", "error", "odd", "E"), (40, 10, 10, 10, 3, 1, 1, 1))
        ports = {"sum": "{sum%d}" % choice.randint(1, 2)} if choice.random() < 0.5 else {}
        return act(" ".join(words + last), count="{count%d}" % choice.randint(1, 3), **ports)
    inside = "".join(random_node(choice, depth - 1) for _ in range(choice.randint(2, 3)))
    return choice.choice((
        lambda: element("Sequence", inside), lambda: element("Fallback", inside, memory="true"),
        lambda: element("Parallel", inside), lambda: element("Sequence", inside, memory="true"),
        lambda: element("ParallelAbsolute", inside, barriers=choice.choice(("0.5", "0.25;0.5;0.75"))),
        lambda: element("ParallelRelative", inside, delta=choice.choice(("0", "0.1", "0.3")),
                        pace=choice.choice(("true", "false"))),
        lambda: element("Retry", random_node(choice, depth - 1), attempts="2"),
        lambda: element("Repeat", random_node(choice, depth - 1), times="2"),
        lambda: element("Timeout", random_node(choice, depth - 1), seconds=choice.choice(("0.03", "0.08")))))()


if __name__ == "__main__":
    unittest.main()
