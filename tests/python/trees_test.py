"Trees in the process of Python: lockstep.Tree, Project, Node and leaves that are classes."
import gc
import importlib.util
import logging
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import weakref

import lockstep
from lockstep_leaf import Action, Condition, InOut, Output, Port

SOURCES = pathlib.Path(__file__).resolve().parents[2]
calls = []


class Count(Action):
    "Counts its ticks."
    ticks: int = Port(4, min=1, doc="how many")
    step: float = 1.0
    label: str = "none"
    marks: list[float] = [0.5, 0.25]
    seen: Output[int]
    words: Output[list[str]]

    def __init__(self):
        self.made = self.name

    def start(self):
        calls.append(f"start {self.name}")
        self.done = 0

    def tick(self):
        if self.label == "broken":
            raise ValueError("cannot count")
        self.done += self.step
        self.seen = round(self.done)
        self.words = [self.label, "a;b"]
        return True if self.done >= self.ticks else None

    def progress(self):
        return self.done / self.ticks

    def halt(self):
        calls.append(f"halt {self.name}")

    def pause(self):
        calls.append(f"pause {self.name}")

    def resume(self):
        calls.append(f"resume {self.name}")


class Above(Condition):
    "Whether a number is above a limit."
    value: float
    limit: float = 1.0

    def tick(self):
        return self.value > self.limit


class Any(Action):
    "Sets every type of port."
    flag: InOut[bool]
    number: InOut[int]
    real: InOut[float]
    text: InOut[str]
    flags: InOut[list[bool]]
    numbers: InOut[list[int]]
    reals: InOut[list[float]]
    texts: InOut[list[str]]

    def tick(self):
        self.flag, self.number, self.real, self.text = not self.flag, -self.number, self.real / 2, self.text + "ü"
        self.flags, self.numbers = self.flags + [True], self.numbers + [2**62]
        self.reals, self.texts = self.reals + [0.5], self.texts + ["", "x;y"]
        return True


class Does(Action):
    "What a test wants."
    todo = None

    def tick(self):
        return Does.todo(self)


class Long(Action):
    "Returns when its tick was told to last too long."
    told = threading.Event()

    def tick(self):
        return "success" if self.told.wait(60) else "failure"


def text_of(nodes, head=""):
    return f'<root lockstep="1">{head}<BehaviorTree ID="Main">{nodes}</BehaviorTree></root>'


def tree(nodes, leaves=(Count, Above, Any, Does), **options):
    return lockstep.Tree(text=text_of(nodes), leaves=leaves, **options)


class TreesTest(unittest.TestCase):
    def setUp(self):
        gc.collect()  # a tree of another test that nobody closed halts its leaves
        calls.clear()
        logging.getLogger("lockstep").setLevel(logging.ERROR)

    def test_a_tree_is_ticked_and_its_nodes_are_seen(self):
        with tree('<Sequence memory="true"><Count name="a" seen="{n}"/><Above value="2"/></Sequence>') as it:
            self.assertEqual([node.path for node in it.nodes], ["Main/Sequence", "Main/Sequence/a", "Main/Sequence/Above"])
            self.assertEqual(it.status, "idle")
            a = it.node("Main/Sequence/a")
            self.assertEqual((a.name, a.id, a.index, a.parent, a.children), ("a", "Count", 1, it.root, []))
            self.assertEqual(it.root.children, [a, it.nodes[2]])
            self.assertIsNone(it.root.parent)
            seen = []
            while it.tick() == "running":
                seen.append((a.status, a.progress, a.ticked, a.held, it.entries["n"]))
            self.assertEqual(seen, [("running", 0.25 * i, True, False, i) for i in (1, 2, 3)])
            self.assertEqual((it.status, a.status, it.entries["n"]), ("success", "success", 4))
            self.assertEqual(it.tick(), "running")
            it.halt()
            self.assertEqual((it.status, calls), ("idle", ["start a", "start a", "halt a"]))
            with self.assertRaisesRegex(KeyError, "there is no node 'Main/Sequence/b'; did you mean"):
                it.node("Main/Sequence/b")

    def test_a_run_is_that_of_the_program(self):
        with tempfile.TemporaryDirectory() as directory:
            file = os.path.join(directory, "tree.xml")
            nodes = ('<ParallelAbsolute barriers="0.25;0.5"><Advance name="arm" step="0.02"/>'
                     '<Advance name="base" step="0.05"/></ParallelAbsolute>')
            pathlib.Path(file).write_text(text_of(nodes, '<plugin name="motion"/>'))
            recording = os.path.join(directory, "run.jsonl")
            expected = lockstep.run(file, record=recording)
            rows = lockstep.read(recording)
            rows = rows if isinstance(rows, list) else rows.to_dict("records")
            # A recording has the progress at the start of a tick.
            expected_states = [(row["tick"], row["node"], row["status"], bool(row["held"])) for row in rows]
            expected_progress = {(row["tick"] - 1, row["node"]): row["progress"] for row in rows if row["tick"]}

            spec = importlib.util.spec_from_file_location("motion", SOURCES / "tests/programs/advance_class.py")
            motion = importlib.util.module_from_spec(spec)
            sys.modules["motion"] = motion
            before = sys.stdout
            spec.loader.exec_module(motion)
            self.assertIs(sys.stdout, before)  # serve() at its end does nothing
            states, progress = [], {}

            def observe(tick, seconds, status):
                for node in it.nodes:
                    states.append((tick, node.index, node.status, node.held))
                    progress[tick, node.index] = node.progress
            with lockstep.Tree(file, leaves=motion) as it:
                it.on_tick(observe)
                result = it.run()
            self.assertEqual((result.result, result.ticks, result.time_s, result.reason),
                             (expected.result, expected.ticks, expected.time_s, expected.reason))
            active = {row[:2] for row in expected_states}
            self.assertEqual([row for row in states if row[:2] in active], expected_states)
            self.assertEqual({key: progress[key] for key in expected_progress}, expected_progress)

    def test_tables_are_the_same_with_pandas_and_without(self):
        with tempfile.TemporaryDirectory() as directory:
            file, recording = SOURCES / "trees/door_pulling.xml", os.path.join(directory, "run.jsonl")
            lockstep.run(file, args={"barriers": [0.5]}, seed=3, record=recording)
            grid = {"barriers": ["", "0.5", "0.25;0.5"], "slack": [0.4]}
            out = os.path.join(directory, "study")
            tables = [lockstep.read(recording), lockstep.study(file, runs=3, grid=grid, measure=["spread"], out=out),
                      lockstep.read_study(out, "summary")]
            if not isinstance(tables[0], list):
                recorded, runs, summary = tables
                self.assertEqual([str(recorded[it].dtype) for it in ("tick", "time_s", "status", "progress", "held")],
                                 ["int64", "float64", "object", "float64", "bool"])
                self.assertEqual([str(runs[it].dtype) for it in ("barriers", "slack", "seed")],
                                 ["object", "float64", "uint64"])
                self.assertEqual(dict(runs.groupby("barriers").size()), {"": 3, "0.5": 3, "0.25;0.5": 3})
                self.assertGreater(recorded[recorded.held].progress.min(), 0)
                self.assertTrue(summary.gap.isna().all())
                tables = [it.astype(object).where(it.notna(), None).to_dict("records") for it in tables]
            recorded, runs, summary = tables
            self.assertEqual(recorded[0], {"tick": 0, "time_s": 0.0, "node": 0, "path": "OpenDoor/open", "ticked": True,
                                           "status": "running", "progress": 0.0, "held": False, "results": None})
            self.assertEqual({row["barriers"] for row in runs}, {"", "0.5", "0.25;0.5"})
            self.assertEqual({row["slack"] for row in runs}, {0.4})
            self.assertIsInstance(runs[0]["spread OpenDoor/open/pull"], float)
            self.assertEqual([(row["barriers"], row["measure"], row["gap"]) for row in summary],
                             [("", "spread", None), ("0.5", "spread", None), ("0.25;0.5", "spread", None)])
            self.assertEqual(summary[1]["success"], 1)

    def test_every_type_of_entry_and_port(self):
        names = ("flag", "number", "real", "text", "flags", "numbers", "reals", "texts")
        with tree("<Any " + " ".join(f'{it}="{{{it}}}"' for it in names) + "/>") as it:
            self.assertEqual(dict(it.entries), {})
            values = (True, 7, 3, "x", [], [-1], [1, 0.25], ["", "\\;"])
            for name, value in zip(names, values):
                it.entries[name] = value
            self.assertEqual(dict(it.entries), dict(zip(names, values)))
            self.assertIs(type(it.entries["real"]), float)
            self.assertEqual(it.tick(), "success")
            self.assertEqual(dict(it.entries), dict(zip(names, (
                False, -7, 1.5, "xü", [True], [-1, 2**62], [1.0, 0.25, 0.5], ["", "\\;", "", "x;y"]))))
            self.assertEqual((len(it.entries), "flag" in it.entries, "flga" in it.entries), (8, True, False))
            for name, value in (("flag", 1), ("number", 1.5), ("number", True), ("real", None), ("real", [1.0]),
                                ("reals", 1.0), ("numbers", ["a"]), ("text", 3)):
                with self.assertRaisesRegex(TypeError, f"the entry '{name}' is of type .*, not "):
                    it.entries[name] = value
            for name, value in (("number", 2**63), ("real", float("nan")), ("number", "many")):
                with self.assertRaises(ValueError):
                    it.entries[name] = value
            it.entries["text"] = "a\0b"
            self.assertEqual(it.entries["text"], "a\0b")
            it.entries["numbers"] = "1;2"  # as in XML
            self.assertEqual(it.entries["numbers"], [1, 2])
            with self.assertRaisesRegex(KeyError, "no node uses an entry 'flga'; did you mean 'flag'"):
                it.entries["flga"] = True
            with self.assertRaises(KeyError):
                it.entries.get("flga")

    def test_an_entry_without_a_value(self):
        with tree('<Above value="{v}"/>') as it:
            self.assertIsNone(it.entries.get("v"))
            with self.assertRaisesRegex(KeyError, "nothing has written the entry 'v'"):
                it.entries["v"]
            with self.assertRaisesRegex(lockstep.Error, "the port 'value' has no value .trees_test.py:") as caught:
                it.tick()
            self.assertIsInstance(caught.exception.__cause__, AttributeError)
            it.restart()
            it.entries["v"] = 3
            self.assertEqual(it.tick(), "success")

    def test_an_exception_of_a_leaf_is_its_fault(self):
        it = tree('<Parallel><Count name="good"/><Count name="bad" label="broken"/></Parallel>')
        for _ in range(2):
            with self.assertRaisesRegex(lockstep.Error, r"^Main/Parallel/bad: ValueError: cannot count \(trees_test.py:\d+\)$") as caught:
                it.tick()
            self.assertEqual((caught.exception.code, caught.exception.node), (5, "Main/Parallel/bad"))
        self.assertEqual(calls, ["start good", "start bad", "halt good", "halt bad"])
        self.assertEqual(it.root.status, "idle")
        with self.assertRaises(lockstep.Error):
            it.run()
        it.close()
        with tree('<Fallback><Count label="broken"/><Count ticks="1"/></Fallback>', on_fault="fail") as it:
            self.assertEqual(it.tick(), "success")

    def test_what_a_leaf_may_not_do_is_its_fault(self):
        Sets = type("Sets", (Action,), {"__annotations__": {"width": Output[float]}, "tick": lambda leaf: todo(leaf)})

        def sets(value):
            def do(leaf):
                leaf.width = value
                return True
            return do
        for todo, why in ((lambda leaf: "done", "ValueError: tick returned 'done', expected None"),
                          (sets("wide"), "TypeError: set 'width', a port of type double, to 'wide'"),
                          (sets(float("nan")), "width"), (lambda leaf: leaf.log("x", "loud"), "the level is 'loud'"),
                          (lambda leaf: sys.exit(3), None), (lambda leaf: it.tick(), "the tree is in use"),
                          (lambda leaf: it.close(), "the tree is in use")):
            it = tree('<Sets width="{w}"/>', [Sets])
            expected = lockstep.Error if why else SystemExit
            with self.assertRaisesRegex(expected, why or "3"):
                it.tick()
            it.close()
        todo = sets(1)
        self.assertEqual(tree("<Sets/>", [Sets]).tick(), "success")  # nobody wants it

    def test_a_leaf_that_cannot_be_made(self):
        class Shy(Action):
            shy = True

            def __init__(self):
                if Shy.shy:
                    raise OSError("no driver")

            def tick(self):
                return True
        with self.assertRaisesRegex(lockstep.Error, r"Main/Shy: could not be created: OSError: no driver \(trees_test.py:") as caught:
            tree("<Shy/>", [Shy])
        self.assertIsInstance(caught.exception.__cause__, OSError)
        Shy.shy = False
        it = tree("<Shy/>", [Shy])
        Shy.shy = True
        with self.assertRaisesRegex(lockstep.Error, "no driver"):
            it.restart()
        with self.assertRaisesRegex(lockstep.Error, "no driver"):
            it.tick()
        Shy.shy = False
        it.restart()
        self.assertEqual(it.tick(), "success")

    def test_a_tree_asks(self):
        with tree('<Ask text="Now?" options="yes;no"/>') as it:
            self.assertIsNone(it.root.question)
            self.assertEqual((it.tick(), it.root.question), ("running", "Now?"))
            with self.assertRaisesRegex(ValueError, "'maybe' is no answer"):
                it.root.answer("maybe")
            it.root.answer("no", who="a test")
            self.assertEqual((it.tick(), it.root.question), ("failure", None))

    def test_held_leaves_are_paused(self):
        with tree('<ParallelAbsolute barriers="0.5"><Count name="fast"/><Count name="slow" ticks="8"/></ParallelAbsolute>') as it:
            it.tick(), it.tick(), it.tick()
            self.assertTrue(it.node("Main/ParallelAbsolute/fast").held)
            self.assertEqual(it.run().result, "success")
        self.assertIn("pause fast", calls)
        self.assertIn("resume fast", calls)

    def test_what_a_leaf_knows(self):
        known = []

        def todo(leaf):
            known.append((leaf.name, leaf.path, leaf.clock, leaf.period, leaf.now, leaf.random.random()))
            leaf.log("here")
            return None
        Does.todo = todo
        lines = []
        with tree('<Does name="it"/>', seed=3, period=0.5, log=lambda *line: lines.append(line)) as it:
            it.tick(), it.tick(), it.tick(7)
            self.assertEqual([row[:5] for row in known], [("it", "Main/it", "virtual", 0.5, now) for now in (0, 0.5, 7)])
            self.assertEqual(lines[0], ("Main/it", "info", "here"))
            for wrong in (6, -1, float("nan"), float("inf"), "8", 1e10):
                with self.assertRaisesRegex(ValueError, "the time of a tick is"):
                    it.tick(wrong)
            it.restart(3)
            it.tick()
            self.assertEqual(known[3], known[0])
            it.restart(4)
            it.tick()
            self.assertNotEqual(known[4][5], known[0][5])
        with self.assertLogs("lockstep", "INFO") as logged, tree('<Does name="it"/>') as it:
            it.tick()
        self.assertEqual(logged.output, ["INFO:lockstep:Main/it: here"])

    def test_a_leaf_logs_from_any_thread_until_it_is_destroyed(self):
        kept, lines = [], []

        def todo(leaf):
            kept.append(leaf)
            thread = threading.Thread(target=leaf.log, args=("from a thread", "warning"))
            thread.start()
            thread.join()
            leaf.log("nothing is hidden\0 here")
            return None
        Does.todo = todo
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "run.jsonl")
            with tree("<Does/>", log=lambda *line: lines.append(line)) as it:
                it.record(file)
                it.tick()
                kept[0].log("between two ticks")
            kept[0].log("gone")
            recorded = pathlib.Path(file).read_text(encoding="utf-8")
        told = ["from a thread", "nothing is hidden here", "between two ticks"]
        self.assertEqual([text for _, _, text in lines], [*told, "gone"])
        self.assertEqual([text for text in [*told, "gone"] if text in recorded], told)

    def test_an_exception_of_the_log_function_is_raised_after_the_tick(self):
        def refuse(*line):
            raise ZeroDivisionError("no room")
        Does.todo = lambda leaf: leaf.log("x")
        with tree("<Does/>", log=refuse) as it, self.assertRaisesRegex(ZeroDivisionError, "no room"):
            it.tick()

    def test_what_a_leaf_does_is_read_as_that_of_a_program(self):
        wrong = type("Wrong", (Action,), {"behavior": {"tick": "2"}, "tick": lambda leaf: True})
        with self.assertRaisesRegex(lockstep.Error, "'tick'"):
            tree("<Wrong/>", [wrong])

    def test_the_random_numbers_are_those_of_the_program(self):
        with tempfile.TemporaryDirectory() as directory:
            program = os.path.join(directory, "dice.py")
            pathlib.Path(program).write_text(
                "#!/usr/bin/python3\nfrom lockstep_leaf import Action, Output, serve\nclass Dice(Action):\n"
                "    out: Output[float]\n    def tick(self):\n        self.out = self.random.random()\n"
                "        return True\nserve()\n")
            os.chmod(program, 0o755)
            file = os.path.join(directory, "tree.xml")
            pathlib.Path(file).write_text(text_of('<Dice out="{out}"/>', '<plugin name="dice" program="dice.py"/>'))
            with lockstep.Tree(file, plugin_path=directory, seed=9) as it:  # a program beside this process
                it.run()
                expected = it.entries["out"]
            spec = importlib.util.spec_from_file_location("dice", program)
            dice = importlib.util.module_from_spec(spec)
            sys.modules["dice"] = dice
            spec.loader.exec_module(dice)
            with lockstep.Tree(file, leaves=[dice.Dice], seed=9) as it:
                it.run()
                self.assertEqual(it.entries["out"], expected)

    def test_a_tree_that_is_wrong(self):
        for nodes, why in (("<Cuont/>", "text:1:44: error: unknown node 'Cuont' .did you mean 'Count'?"),
                           ('<Count ticks="0"/>', "error: .*ticks"), ("<Count", "text:1")):
            with self.assertRaisesRegex(lockstep.Error, why) as caught:
                tree(nodes)
            self.assertEqual(caught.exception.code, 3)
            self.assertEqual(caught.exception.diagnostics[0].severity, "error")
        with self.assertRaisesRegex(lockstep.Error, "none.xml: error: cannot be read"):
            lockstep.Tree("none.xml")
        with self.assertRaisesRegex(lockstep.Error, "two of one name|has the leaf|'Count'"):
            other = type("Count", (Count,), {"__module__": "elsewhere"})
            tree("<Count/>", [Count, other])
        with self.assertRaisesRegex(TypeError, "is no leaf"):
            tree("<Count/>", [str])
        with self.assertRaisesRegex(ValueError, "has no leaves"):
            tree("<Count/>", os)
        for wrong in ({"seed": -1}, {"seed": 2**64}, {"period": 0}, {"clock": "real"}, {"on_fault": "go"}):
            with self.assertRaises(ValueError):
                tree("<Count/>", **wrong)

    def test_ids_of_leaves(self):
        with tree("<Wärmen/>", [type("Wärmen", (Count,), {})]) as it:
            it.run()
        with self.assertRaisesRegex(lockstep.Error, "has the id '_Hidden' .an id is a letter, then letters"):
            tree("<Count/>", [type("_Hidden", (Count,), {})])

    def test_arguments_values_and_main_tree(self):
        text = ('<root lockstep="1"><arg name="n" default="2"/><BehaviorTree ID="A"><Count ticks="${n}" step="{s}"/>'
                '</BehaviorTree><BehaviorTree ID="B"><AlwaysFailure/></BehaviorTree></root>')
        with lockstep.Tree(text=text, leaves=Count, main_tree="A", args={"n": 6}, set={"s": 2}) as it:
            self.assertEqual((it.run().ticks, it.entries["s"]), (3, 2.0))
        with lockstep.Tree(text=text, leaves=Count, main_tree="B") as it:
            self.assertEqual((it.run().result, it.run().code), ("failure", 1))
        with self.assertRaisesRegex(lockstep.Error, "^error: unknown argument 'm'"):
            lockstep.Tree(text=text, leaves=Count, main_tree="A", args={"m": 6})

    def test_texts_of_a_list_are_given_as_they_are(self):
        for texts in ([], [""], ["", ""], [" x "], ["a", "b;c", "\\", "\t"], ["x", ""]):
            with tree('<Count words="{l}"/>', set={"l": texts}) as it:
                self.assertEqual(it.entries["l"], texts)
        with self.assertRaisesRegex(ValueError, "the grid of 'g' has the value 'a,b', which --grid splits at its commas"):
            lockstep.study("tree.xml", runs=1, grid={"g": ["a,b"]})

    def test_the_tick_after_one_with_a_time_is_a_period_later(self):
        with tree('<Wait seconds="0.05"/>', period=0.01) as it:
            self.assertEqual(it.tick(5.0), "running")
            ticks = 1
            while it.tick() == "running":
                ticks += 1
            self.assertEqual(ticks, 5)

    def test_an_exception_that_has_no_text_is_a_fault(self):
        class Wordless(Exception):
            def __str__(self):
                return "error " + 3

        class Broken(Action):
            def start(self):
                raise Wordless()

            def tick(self):
                return True

        class Surrogate(Action):
            def start(self):
                raise ValueError("\udcff")

            def tick(self):
                return True

        for cls, message in ((Broken, "Wordless: its __str__ raised TypeError"), (Surrogate, "ValueError: ")):
            with lockstep.Tree(text=f'<root lockstep="1"><BehaviorTree ID="Main"><{cls.__name__}/></BehaviorTree></root>',
                               leaves=[cls]) as it:
                with self.assertRaisesRegex(lockstep.Error, message):
                    it.tick()

    def test_a_run_that_a_property_ends_is_a_run(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder, "tree.xml")
            file.write_text('<root lockstep="1"><BehaviorTree ID="Main"><Wait seconds="1"/></BehaviorTree></root>')
            end = lockstep.run(file, property="p: never Wait.running", on_violation="end")
            self.assertEqual((end.reason, end.code, end.ticks), ("property", 10, 1))

    def test_limits_of_a_run(self):
        with tree('<Count ticks="100000"/>', period=0.001) as it:
            end = it.run(max_ticks=10)
            self.assertEqual((end.result, end.reason, end.ticks, end.code), ("stopped", "max_ticks", 10, 124))
            self.assertEqual(it.run(timeout=0.5).reason, "timeout")
            end = it.run(timeout=0)
            self.assertEqual((end.result, end.reason, end.ticks, end.code), ("stopped", "timeout", 0, 124))
            for wrong in ({"max_ticks": 0}, {"max_ticks": -1}, {"max_ticks": 1.5}, {"timeout": -1}, {"timeout": float("nan")}):
                with self.assertRaisesRegex(ValueError, "expected"):
                    it.run(**wrong)
        with tree('<Count ticks="5"/>', period=0.001, clock="wall") as it:
            self.assertGreaterEqual(it.run().time_s, 0.004)
            it.restart()
            it.tick()
            self.assertEqual(it.status, "running")

    def test_observers(self):
        seen = []
        with tree('<Count seen="{n}"/>') as it:
            it.on_tick(lambda tick, seconds, status: seen.append((tick, seconds, status, it.progress, it.entries["n"])))
            it.run()
            self.assertEqual(seen[0], (0, 0.0, "running", 0.25, 1))
            self.assertEqual(len(seen), 4)

            @it.on_tick
            def refuse(tick, seconds, status):
                if tick == 2:
                    raise ZeroDivisionError("enough")
            with self.assertRaises(ZeroDivisionError):
                it.run()
            self.assertEqual(len(seen), 7)
        with tree("<Count/>") as it:
            it.on_tick(lambda *_: it.halt())
            with self.assertRaisesRegex(lockstep.Error, "the tree is in use"):
                it.tick()

    def test_a_recording_and_a_monitor(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "run.jsonl")
            with tree("<AlwaysSuccess/>") as it:
                it.record(file)
                self.assertTrue(it.monitor().startswith("http://127.0.0.1:"))
                with self.assertRaisesRegex(lockstep.Error, "is recorded already"):
                    it.record(file)
                self.assertEqual(it.tick(), "success")
                with self.assertRaisesRegex(lockstep.Error, "has been ticked already"):
                    it.monitor()
            with open(file, encoding="utf-8") as lines:
                self.assertEqual(len(list(lines)), 3)

    def test_a_call_that_takes_long(self):
        lines, hangs = [], []

        def on_hang(*call):
            hangs.append(call)
            Long.told.set()
        with tree("<Long/>", leaves=[Long], log=lambda *it: lines.append(it), clock="wall", tick_budget=1e-9,
                  hang_limit=0.01, on_hang=on_hang) as it:
            self.assertEqual(it.tick(), "success")
        (who, function, seconds), = hangs
        self.assertEqual(who, "'Main/Long' (Long of plugin 'trees_test')")
        self.assertEqual(function, "tick")
        self.assertGreaterEqual(seconds, 0.01)
        self.assertIn("budget", "".join(text for _, _, text in lines))

    def test_groot2(self):
        project = lockstep.Project(text=text_of("<AlwaysSuccess/>"), groot2=True)
        with lockstep.Tree(project) as it:
            it.groot2("0")
        with tree("<AlwaysSuccess/>") as it:
            with self.assertRaisesRegex(lockstep.Error, "Groot2"):
                it.groot2("0")

    def test_a_closed_tree(self):
        it = tree("<Count/>")
        node, entries = it.root, it.entries
        it.tick()
        it.close()
        it.close()
        self.assertTrue(it.closed)
        self.assertEqual(calls, ["start Count", "halt Count"])
        for use in (it.tick, it.run, it.halt, it.restart, lambda: it.status, lambda: node.progress, it.__enter__,
                    lambda: it.on_tick(print)):
            with self.assertRaisesRegex(lockstep.Error, "^the tree is closed"):
                use()
        with self.assertRaises((lockstep.Error, KeyError)):
            entries["seen"] = 1
        project = lockstep.Project(text=text_of("<Count/>"), leaves=Count)
        first = lockstep.Tree(project)
        project.close()
        project.close()
        with self.assertRaisesRegex(lockstep.Error, "the project is closed"):
            lockstep.Tree(project)
        del project
        gc.collect()
        self.assertEqual(first.run().result, "success")

    def test_a_leaf_that_is_kept_outlives_its_tree(self):
        kept = []
        Does.todo = kept.append
        it = tree("<Does/>")
        it.tick()
        kept[0].log("still there")
        it.close()
        kept[0].log("gone")

    def test_ports_are_read_where_the_tree_is_ticked(self):
        kept = []

        class Keeps(Action):
            size: float = 2.0

            def tick(self):
                kept.append(self)
                return True
        it = tree("<Keeps/>", [Keeps])
        it.tick()
        with self.assertRaisesRegex(RuntimeError, "in the thread that ticks"):
            kept[0].size
        it.close()
        with self.assertRaisesRegex(AttributeError, "has no value"):
            kept[0].size

    def test_a_tree_that_nobody_has_is_halted_and_freed(self):
        it = tree("<Count/>")
        it.tick()
        gone = weakref.ref(it)
        del it
        gc.collect()
        self.assertIsNone(gone())
        self.assertEqual(calls, ["start Count", "halt Count"])

    def test_many_trees_in_threads(self):
        project = lockstep.Project(text=text_of('<Count ticks="200" seen="{n}"/>'), leaves=Count)
        ends = []

        def work(seed):
            with lockstep.Tree(project, seed=seed) as it:
                ends.append((it.run().ticks, it.entries["n"]))
        threads = [threading.Thread(target=work, args=(seed,)) for seed in range(8)]
        for thread in threads:
            thread.start()
        project.close()
        for thread in threads:
            thread.join()
        self.assertEqual(ends, [(200, 200)] * 8)

    def test_one_tree_in_two_threads_is_refused(self):
        inside, go_on = threading.Event(), threading.Event()

        def todo(leaf):
            inside.set()
            go_on.wait(60)
            return True
        Does.todo = todo
        it = tree("<Does/>")
        thread = threading.Thread(target=it.tick)
        thread.start()
        inside.wait(60)
        for use in (it.tick, it.close, it.halt, lambda: it.status):
            with self.assertRaisesRegex(lockstep.Error, "the tree is in use"):
                use()
        go_on.set()
        thread.join()
        self.assertEqual(it.status, "success")

    def test_a_plugin_is_loaded_and_isolated(self):
        plain = lockstep.Tree(SOURCES / "trees/door_pulling.xml", args={"barriers": [0.5]}, seed=3).run()
        isolated = lockstep.Tree(SOURCES / "trees/door_pulling.xml", args={"barriers": [0.5]}, seed=3, isolate=True).run()
        program = lockstep.run(SOURCES / "trees/door_pulling.xml", args={"barriers": [0.5]}, seed=3)
        self.assertEqual((plain.ticks, plain.result), (program.ticks, program.result))
        self.assertEqual(isolated.ticks, program.ticks)

    def test_the_process_of_a_held_program_is_stopped(self):
        with tempfile.TemporaryDirectory() as directory:
            pids = pathlib.Path(directory) / "pids"
            os.environ["PIDS"] = str(pids)
            nodes = '<ParallelAbsolute barriers="0.002"><Steady/><Count ticks="100000"/></ParallelAbsolute>'
            with lockstep.Tree(text=text_of(nodes, '<plugin name="steady" program="steady.py" hold="signal"/>'),
                               leaves=Count, plugin_path=SOURCES / "tests/programs") as it:
                stat = pathlib.Path("/proc") / pids.read_text().split()[-1] / "stat"
                while not it.nodes[1].held:
                    self.assertNotIn(") T ", stat.read_text())
                    began = time.perf_counter()
                    it.tick()
                while ") T " not in stat.read_text():
                    self.assertLess(time.perf_counter() - began, 60)
                print(f"stopped {1e6 * (time.perf_counter() - began):.0f} us after the begin of the tick")
            self.assertFalse(stat.exists())

    def test_ports_by_pattern_are_those_of_the_element(self):
        spec = importlib.util.spec_from_file_location("shapes_class", SOURCES / "tests/programs/shapes_class.py")
        shapes = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(shapes)
        nodes = ('<Sequence><Shape kind="round" size.radius="2" out.area="{a}" out.text="{t}"/>'
                 '<Box kind="square" size.side="{a}" out.area="{b}"/></Sequence>')
        with lockstep.Tree(text=text_of(nodes), leaves=shapes) as it:
            self.assertEqual(it.tick(), "success")
            self.assertEqual(dict(it.entries), {"a": 12.0, "t": "round of 2", "b": 144.0})
        for nodes, column, message in (
                ('<Shape kind="round" size.radius="1" size.side="2"/>', 37, "'Shape' has no parameter 'size.side'"),
                ('<Shape kind="oval"/>', 14, "there is no such shape")):
            with self.assertRaises(lockstep.Error) as caught:
                lockstep.Tree(text=text_of("\n" + nodes), leaves=shapes)
            self.assertEqual((caught.exception.diagnostics[0].column, caught.exception.diagnostics[0].message),
                             (column, message))

    def test_a_leaf_ticks_another_tree(self):
        inner = tree('<Count label="broken"/>')

        def todo(leaf):
            return {"running": None, "success": True}[inner.tick()]
        Does.todo = todo
        with tree("<Does/>") as it, self.assertRaisesRegex(
                lockstep.Error, "Main/Does: Error: Main/Count: ValueError: cannot count .trees_test.py") as caught:
            it.tick()
        self.assertIsInstance(caught.exception.__cause__.__cause__, ValueError)
        inner.close()
        inner = tree('<Count ticks="3"/>')
        with tree("<Does/>") as it:
            self.assertEqual(it.run().ticks, 3)

    def test_ctrl_c_where_no_python_runs(self):
        # The signal comes while lockstep sleeps between two ticks, or before a function of the leaf has begun.
        Does.todo = lambda leaf: None
        before = signal.getsignal(signal.SIGINT)
        with tree("<Parallel><Does/><Count ticks=\"1000000\"/></Parallel>", clock="wall", period=0.01) as it:
            timer = threading.Timer(0.05, lambda: os.kill(os.getpid(), signal.SIGINT))
            timer.start()
            with self.assertRaises(KeyboardInterrupt):
                it.run(timeout=60)
            timer.join()
            self.assertEqual((it.status, calls), ("idle", ["start Count", "halt Count"]))
        self.assertIs(signal.getsignal(signal.SIGINT), before)

    @unittest.skipIf(sys.version_info < (3, 9, 8), "a thread of Python may then never seem to end (bpo-45274)")
    def test_ctrl_c_again_and_again(self):
        script = """
import os, signal, sys, threading, time
import lockstep
from lockstep_leaf import Action
class Quick(Action):
    def tick(self):
        return None
    def progress(self):
        return 0.5
def shoot():
    while time.time() < end:
        time.sleep(0.001)
        os.kill(os.getpid(), signal.SIGINT)
tree = lockstep.Tree(text='<root lockstep="1"><BehaviorTree ID="Main"><Parallel><Quick/><Quick/></Parallel></BehaviorTree></root>',
                     leaves=[Quick])
hits = ticks = 0
end = time.time() + 0.5
thread = threading.Thread(target=shoot)
while True:
    try:
        if thread.ident is None:
            thread.start()
        while thread.is_alive():
            try:
                tree.tick()
                ticks += 1
            except lockstep.Error as error:
                assert "KeyboardInterrupt" in str(error), error
                tree.restart()
        break
    except KeyboardInterrupt:
        hits += 1
tree.restart()
print(tree.tick(), hits > 9, ticks > 9, signal.getsignal(signal.SIGINT) is signal.default_int_handler)
"""
        done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
        self.assertEqual((done.stdout, done.stderr), ("running True True True\n", ""))

    def test_ctrl_c_in_a_leaf_that_never_returns(self):
        def todo(leaf):
            os.kill(os.getpid(), signal.SIGINT)
            while True:
                pass
        Does.todo = todo
        it = tree("<Parallel><Count/><Does/></Parallel>")
        with self.assertRaises(KeyboardInterrupt):
            it.tick()
        self.assertEqual(calls, ["start Count", "halt Count"])
        with self.assertRaisesRegex(lockstep.Error, "KeyboardInterrupt"):
            it.tick()
        it.restart()
        self.assertEqual(it.status, "idle")

    def test_another_process_does_not_end_the_leaves(self):
        it = tree("<Count/>")
        it.tick()
        child = os.fork()
        if child == 0:
            it.close()
            os._exit(len(calls))
        self.assertEqual(os.waitpid(child, 0)[1], 1 << 8)
        self.assertEqual(it.tick(), "running")

    def test_the_library_is_found_or_it_is_said_how(self):
        def ask(**environment):
            done = subprocess.run([sys.executable, "-c", "import lockstep; lockstep.Tree(text='')"], capture_output=True, text=True,
                                  env={"PYTHONPATH": os.environ["PYTHONPATH"], "PATH": "/nowhere", **environment})
            return done.stderr.splitlines()[-1]
        if not pathlib.Path(lockstep.__file__).parents[2].joinpath("bin").exists():
            self.assertIn("liblockstep-runtime.so is not found: set the variable LOCKSTEP_LIBRARY to its path", ask())
        self.assertIn("LOCKSTEP_LIBRARY is '/nowhere', which is not a file", ask(LOCKSTEP_LIBRARY="/nowhere"))


if __name__ == "__main__":
    unittest.main()
