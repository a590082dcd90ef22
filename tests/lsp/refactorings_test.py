"""Refactorings: what is offered where, what the text is then, and that no tree gets an error by one. LOCKSTEP_REFACTORINGS
says at how many places of each tree of this project they are tried. '[' and ']' in a text are the selection, '|' the cursor."""
import json
import os
import random
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

from client import PLUGINS, Client, Session, edited, place

SOURCE = Path(os.environ["SOURCE"])
PLACES = int(os.environ.get("LOCKSTEP_REFACTORINGS", 1))

WRAPS = {"lockstep": ["Sequence", "Fallback", "Parallel", "ParallelAbsolute", "Inverter", "Retry", "Timeout"],
         "btcpp": ["Sequence", "Fallback", "Parallel", "ParallelAbsolute", "Inverter", "RetryUntilSuccessful", "Timeout"]}


def root(trees, language='lockstep="1"'):
    return f'<root {language} main_tree_to_execute="Main">\n{trees}</root>\n'


def main(nodes):
    return root(f'  <BehaviorTree ID="Main">\n{nodes}  </BehaviorTree>\n')


TWO = """    <Sequence>
      <!-- a while -->
      <Wait seconds="1"/>
      <Wait name="then" seconds="{later}"/>
    </Sequence>
"""
ONE = """    <Sequence>
      <Wait seconds="1"/>
    </Sequence>
"""


class Actions(Session):
    def put(self, text, path=None):
        path = path or self.path
        known = path in self.client.versions
        return self.client.change(path, text) if known else self.client.open(path, text)

    def actions(self, text, begin, end=None, path=None, **context):
        """What is offered for a part of the text that the file has: titles, and what they make of it."""
        path = path or self.path
        answer = self.client.about("textDocument/codeAction", path, context={"diagnostics": [], **context},
                                   range=Client.range(place(text, begin), place(text, begin if end is None else end)))
        self.kinds = {it["title"]: it["kind"] for it in answer}
        self.assertEqual(len(answer), len(self.kinds))
        for it in answer:
            self.assertEqual([path.as_uri()], list(it["edit"]["changes"]))
        return {it["title"]: edited(text, it["edit"]["changes"][path.as_uri()]) for it in answer}


class Refactorings(Actions):
    def setUp(self):
        super().setUp()
        self.client.start(self.directory.name)

    def ask(self, text, **context):
        begin, end = (text.find(it) for it in "[]")
        if begin >= 0:
            text, end = text.replace("[", "").replace("]", ""), end - 1
        else:
            begin = end = text.index("|")
            text = text.replace("|", "")
        self.text = text
        self.put(text)
        return self.actions(text, begin, end, **context)

    def test_kinds(self):
        with tempfile.TemporaryDirectory() as directory:
            client = Client()
            answer = client.start(directory)
            client.stop()
        self.assertEqual(["quickfix", "refactor.extract", "refactor.inline", "refactor.rewrite"],
                         answer["capabilities"]["codeActionProvider"]["codeActionKinds"])

    def test_what_is_offered(self):
        found = self.ask(main(TWO.replace("<Wait sec", "<Wa|it sec")))
        wraps = [f"Wrap in {it}" for it in WRAPS["lockstep"]]
        self.assertEqual(["Extract into the SubTree 'MainWait'", *wraps, "Move down", "Delete Wait"], list(found))
        self.assertEqual({"refactor.extract", "refactor.rewrite"}, set(self.kinds.values()))
        found = self.ask(main(TWO.replace("<Sequence>", "<|Sequence>")))
        self.assertEqual(["Extract into the SubTree 'MainSequence'", *wraps, "Replace Sequence by its children"][:-1], list(found))

    def test_in_the_other_language(self):
        text = main("    <Sequence>\n      <AlwaysSucc|ess/>\n      <AlwaysFailure/>\n    </Sequence>\n")
        found = self.ask(text.replace('lockstep="1"', 'BTCPP_format="4"'))
        wraps = [f"Wrap in {it}" for it in WRAPS["btcpp"]]
        self.assertEqual(["Extract into the SubTree 'MainAlwaysSuccess'", *wraps, "Move down", "Delete AlwaysSuccess"], list(found))
        self.assertIn("      <Timeout msec=\"10000\">\n        <AlwaysSuccess/>\n      </Timeout>\n", found["Wrap in Timeout"])

    def test_results(self):
        wait = '      <Wait name="then" seconds="{later}"/>\n'
        cases = [
            (TWO, '<Wait name', "Wrap in Retry", TWO.replace(wait, f'      <Retry attempts="3">\n  {wait}      </Retry>\n')),
            (TWO, '<Wait name', "Delete Wait", TWO.replace(wait, "")),
            (TWO, '<Wait name', "Move up", TWO.replace(wait, "").replace("      <!--", f"{wait}      <!--")),
            (TWO, '<Wait seconds', "Move down", TWO.replace(wait, "").replace("      <!--", f"{wait}      <!--")),
            (ONE, '<Sequence', "Replace Sequence by its child", '    <Wait seconds="1"/>\n'),
            (ONE, '</Sequence', "Replace Sequence by its child", '    <Wait seconds="1"/>\n'),
        ]
        for nodes, at, title, expected in cases:
            with self.subTest(title):
                found = self.ask(main(nodes.replace(at, "|" + at, 1)))
                self.assertEqual(main(expected), found[title])

    def test_extract_and_inline(self):
        text = main(TWO)
        found = self.ask(text.replace("<Wait name", "|<Wait name"))
        apart = found["Extract into the SubTree 'then'"]
        self.assertEqual(text.replace('<Wait name="then" seconds="{later}"/>', '<SubTree ID="then" later="{later}"/>').replace(
            "</root>", '  <BehaviorTree ID="then">\n    <Wait name="then" seconds="{later}"/>\n  </BehaviorTree>\n</root>'), apart)
        found = self.ask(apart.replace("<SubTree", "<SubTr|ee"))
        self.assertEqual("refactor.inline", self.kinds["Put the tree 'then' in the place of this SubTree"])
        self.assertFalse([it for it in found if it.startswith("Extract")])
        again = found["Put the tree 'then' in the place of this SubTree"]
        self.assertTrue(again.startswith(text[:text.index("</root>")]), again)
        # Trees that an empty line separates stay so.
        lines = self.ask(text.replace("  <Beh", "\n  <!-- one -->\n  <Beh").replace("<Wait name", "|<Wait name"))
        self.assertIn('</BehaviorTree>\n\n  <BehaviorTree ID="then">', lines["Extract into the SubTree 'then'"])
        # A name that is taken gets a number.
        found = self.ask(apart.replace("<Wait seconds", '<Wait name="then" |seconds'))
        self.assertIn("Extract into the SubTree 'then2'", found)
        found = self.ask(main(TWO.replace('"then"', '"a/{b}"').replace("<Wait name", "|<Wait name")))
        self.assertIn("Extract into the SubTree 'MainWait'", found)

    def test_files_with_a_name(self):
        """Names of a file that is included with `as` mean others than here."""
        truck = self.path.parent / "truck.xml"
        truck.write_text(root('  <BehaviorTree ID="Main">\n    <SubTree ID="Drive"/>\n  </BehaviorTree>\n'
                              '  <BehaviorTree ID="Drive">\n    <Wait seconds="1"/>\n  </BehaviorTree>\n'))
        text = root('  <include path="truck.xml" as="then"/>\n  <BehaviorTree ID="Main">\n    <Sequence>\n      <SubTree ID="then"/>\n'
                    '      <SubTree ID="then.Drive"/>\n      <SubTree ID="Drive"/>\n      <Wait name="then" seconds="2"/>\n    </Sequence>\n'
                    '  </BehaviorTree>\n  <BehaviorTree ID="Drive">\n    <Wait seconds="3"/>\n  </BehaviorTree>\n')
        for cursor in ('<SubTree ID="then"/>', '<SubTree ID="then.Drive"/>'):
            found = self.ask(text.replace(cursor, "|" + cursor))
            self.assertIn("Wrap in Retry", found)
            self.assertIn("Move down", found)
            self.assertFalse([it for it in found if it.startswith("Put the tree")])
        found = self.ask(text.replace('<SubTree ID="Drive"/>', '|<SubTree ID="Drive"/>'))
        self.assertIn('      <Wait seconds="3"/>\n', found["Put the tree 'Drive' in the place of this SubTree"])
        found = self.ask(text.replace("<Wait name", "|<Wait name"))
        self.assertIn('<BehaviorTree ID="then2">', found["Extract into the SubTree 'then2'"])
        found = self.ask(text.replace("<Sequence>", "|<Sequence>"))
        self.assertIn('      <SubTree ID="then.Drive"/>\n', found["Extract into the SubTree 'MainSequence'"])
        truck.unlink()

    def test_where(self):
        wait, sequence = "Delete Wait", "Wrap in Sequence"
        text = main(TWO)
        for cursor, title in [("|  <Wait seconds", wait), ("<Wait seconds=\"1\"/>|", wait), ("<Wait |seconds", wait),
                              ("|      <Wait name", wait), ("</Seque|nce>", sequence), ("[<Sequence>]", sequence)]:
            with self.subTest(cursor):
                plain = re.sub(r"[][|]", "", cursor)
                self.assertIn(plain, text)
                self.assertIn(title, self.ask(text.replace(plain, cursor, 1)))
        selection = text.replace('      <Wait seconds="1"/>\n', '[      <Wait seconds="1"/>\n]')
        self.assertIn(wait, self.ask(selection))
        nothing = ["<ro|ot", "<Behavior|Tree", "<!-- a |while", "\n|</root>", "</BehaviorTree>\n|</root>"]
        for cursor in nothing:
            with self.subTest(cursor):
                self.assertEqual({}, self.ask(text.replace(cursor.replace("|", ""), cursor)))
        self.assertEqual({}, self.ask("[" + text + "]"))

    def test_several_nodes(self):
        text = main(TWO.replace("    </Seq", '      <Wait seconds="3"/>\n    </Seq'))
        begin, middle, end = '      <Wait seconds="1"/>\n', '      <Wait name="then" seconds="{later}"/>\n', '      <Wait seconds="3"/>\n'
        inside = "".join("  " + it for it in (begin, middle))
        for selected in (f"[{begin}{middle}]", f"[{begin}{middle[:-1]}]\n", f"      [{begin[6:]}{middle[:20]}]{middle[20:]}"):
            with self.subTest(selected):
                found = self.ask(text.replace(begin + middle, selected))
                self.assertEqual(["Wrap in Sequence", "Wrap in Fallback", "Wrap in Parallel", "Wrap in ParallelAbsolute"], list(found))
                self.assertEqual(text.replace(begin + middle, f"      <Sequence>\n{inside}      </Sequence>\n"),
                                 found["Wrap in Sequence"])
        self.assertEqual({}, self.ask(text.replace(begin + middle, f"[{begin}{middle}").replace("</Beh", "]</Beh")))
        self.assertEqual({}, self.ask(text.replace("<!-- a", "[<!-- a").replace(end, end + "]")))

    def test_the_ticks_of_several_nodes_in_a_sequence(self):
        def keeps(around, language='lockstep="1"', wait='<Wait seconds="0.03"/>'):
            begin = f"      {wait}\n" * 2
            nodes = f"    <{around}>\n[{begin}]      {wait}\n    </{around.split()[0]}>\n"
            found = self.ask(root(f'  <BehaviorTree ID="Main">\n{nodes}  </BehaviorTree>\n', language))
            return leaf_ticks(self.path, self.text) == leaf_ticks(self.path, found["Wrap in Sequence"])
        other = 'BTCPP_format="4"', '<Sleep msec="30"/>'
        self.assertTrue(keeps("Sequence"))
        self.assertFalse(keeps('Sequence memory="true"'))
        self.assertFalse(keeps("Fallback"))
        self.assertTrue(keeps("Sequence", *other))
        self.assertFalse(keeps("Fallback", *other))

    def test_what_breaks_the_tree_is_not_offered(self):
        found = self.ask(main(ONE.replace("<Wait", "<Wa|it")))
        self.assertFalse([it for it in found if it.startswith(("Delete", "Move"))])
        branch = """    <IfThenElse>
      <AlwaysSuccess/>
      <Fall|back>
        <AlwaysSuccess/>
        <AlwaysSuccess/>
        <AlwaysSuccess/>
      </Fallback>
    </IfThenElse>
"""
        found = self.ask(main(branch))
        self.assertNotIn("Replace Fallback by its children", found)
        self.assertNotIn("Delete Fallback", found)
        self.assertIn("Move up", found)
        # A property that names the node.
        text = main(TWO).replace("</root>", '  <property name="p">never then.failure</property>\n</root>')
        errors = [it for it in self.put(text) if it["severity"] == 1]
        self.assertEqual([], errors)
        self.assertNotIn("Delete Wait", self.ask(text.replace("<Wait name", "<|Wait name")))
        # An entry with a start value cannot be one of nodes.
        text = root('  <BehaviorTree ID="Main">\n    <Sub|Tree ID="Other" k="5"/>\n  </BehaviorTree>\n'
                    '  <BehaviorTree ID="Other">\n    <Script code="k := k + 1"/>\n  </BehaviorTree>\n')
        found = self.ask(text)
        self.assertIn("Wrap in Retry", found)
        self.assertFalse([it for it in found if it.startswith("Put")])

    def test_a_subtree_and_its_first_node_with_scripts(self):
        text = root('  <BehaviorTree ID="Main">\n    <Sub|Tree ID="Other" success_if="1 == 1"/>\n  </BehaviorTree>\n'
                    '  <BehaviorTree ID="Other">\n    <Wait seconds="1" on_success="k += 1"/>\n  </BehaviorTree>\n')
        title = "Put the tree 'Other' in the place of this SubTree"
        self.assertNotIn(title, self.ask(text))
        found = self.ask(text.replace(' on_success="k += 1"', ""))
        self.assertIn('    <Wait seconds="1" success_if="1 == 1"/>\n', found[title])
        self.assertIn(title, self.ask(text.replace(' success_if="1 == 1"', "").replace("k +", "k :")))

    def test_a_condition_that_is_not_reset(self):
        def offered(condition):
            text = root('  <BehaviorTree ID="Main">\n    <WhileDoElse>\n      CONDITION\n      <Sleep msec="30"/>\n'
                        '    </WhileDoElse>\n  </BehaviorTree>\n  <BehaviorTree ID="Other">\n    '
                        '<AlwaysSuccess/>\n  </BehaviorTree>\n', 'BTCPP_format="4"')
            found = self.ask(text.replace("CONDITION", condition))
            at = self.text.index(condition[condition.index("|") + 1:]) - 1
            return {it.split(" '")[0] for it in found if keeps_the_run(self.text, at, it)}
        extract, put, wrap, unwrap = ("Extract into the SubTree", "Put the tree", "Wrap in Sequence",
                                      "Replace Sequence by its child")
        self.assertEqual({extract, wrap}, offered("<|AlwaysSuccess/>"))
        self.assertEqual(set(), offered('<|AlwaysSuccess _skipIf="k == 1"/>'))
        self.assertEqual(set(), offered('<|AlwaysSuccess _while="k == 1"/>'))
        self.assertEqual({extract, wrap}, offered('<|AlwaysSuccess _onSuccess="k = 1"/>'))
        self.assertEqual(set(), offered('<|Sleep msec="10"/>'))
        self.assertEqual({put, wrap}, offered('<|SubTree ID="Other"/>'))
        self.assertEqual(set(), offered('<|SubTree ID="Other" _failureIf="k == 1"/>'))
        self.assertEqual({extract, wrap, unwrap}, offered("<|Sequence><AlwaysSuccess/></Sequence>"))
        self.assertEqual({extract, wrap}, offered('<|Sequence><AlwaysSuccess _successIf="k == 1"/></Sequence>'))
        # Its other children are reset.
        self.assertEqual({extract, wrap}, offered('<AlwaysSuccess/>\n      <|Sleep msec="20" _skipIf="k == 1"/>'))

    def test_a_script_that_reads_a_node_by_its_place(self):
        def offered(reading):
            found = self.ask(main('    <Parallel>\n      <Sequence name="own">\n        <|Wait seconds="1"/>\n'
                                  '      </Sequence>\n      <Sequence>\n        <Wait name="w" seconds="2"/>\n'
                                  f'      </Sequence>\n      <WaitUntil code="status({reading}) == success"/>\n'
                                  '    </Parallel>\n'))
            return {it.split(" '")[0] for it in found} & {"Extract into the SubTree", "Wrap in Sequence"}
        self.assertEqual({"Extract into the SubTree", "Wrap in Sequence"}, offered("w"))
        self.assertEqual({"Extract into the SubTree", "Wrap in Sequence"}, offered("own"))
        self.assertEqual({"Extract into the SubTree"}, offered("Sequence"))
        self.assertEqual(set(), offered("Sequence/w"))
        self.assertEqual({"Wrap in Sequence"}, offered("Wait"))

    def test_in_a_tree_with_errors(self):
        text = main(TWO.replace("<Wait seconds", "<Wait secnds"))
        found = self.ask(text.replace("<Wait name", "<|Wait name"), only=["refactor"])
        self.assertIn("Wrap in Sequence", found)
        self.assertEqual({}, self.ask(main(TWO).replace("<Wait name", "<|Wait name").replace("</Sequence>", "")))

    def test_with_a_node_whose_entries_nobody_knows(self):
        text = main(TWO.replace("<Wait seconds", "<Grasp seconds"))
        for cursor in ("<Gra|sp", "<Seq|uence"):
            found = list(self.ask(text.replace(cursor.replace("|", ""), cursor)))
            self.assertEqual("Wrap in Sequence", found[0])
        self.assertIn("Extract into the SubTree 'then'", self.ask(text.replace("<Wait", "<|Wait")))
        text = text.replace('lockstep="1"', 'BTCPP_format="4"').replace("<Wait", "<Sleep").replace("seconds", "msec")
        model = '  <TreeNodesModel>\n    <Action ID="Grasp"><input_port name="msec"/></Action>\n  </TreeNodesModel>\n</root>'
        self.assertNotIn("Extract into the SubTree 'MainGrasp'", self.ask(text.replace("<Grasp", "<|Grasp")))
        self.assertIn("Extract into the SubTree 'MainGrasp'", self.ask(text.replace("<Grasp", "<|Grasp").replace("</root>", model)))

    def test_only_and_trigger(self):
        text = main(TWO.replace("<Wait seconds", "<Wait se|cond"))
        fix = "Replace 'second' by 'seconds'"
        all_titles = list(self.ask(text))
        self.assertIn(fix, all_titles)
        self.assertIn("Delete Wait", all_titles)
        cases = [
            ({"triggerKind": 1}, all_titles),
            ({"only": []}, all_titles),
            ({"only": [""]}, all_titles),
            ({"triggerKind": 2}, [it for it in all_titles if self.kinds[it] == "quickfix"]),
            ({"only": ["quickfix"]}, [it for it in all_titles if self.kinds[it] == "quickfix"]),
            ({"only": ["refactor"], "triggerKind": 2}, [it for it in all_titles if self.kinds[it] != "quickfix"]),
            ({"only": ["refactor.extract"]}, ["Extract into the SubTree 'MainWait'"]),
            ({"only": ["refactor.rewrite"]}, [it for it in all_titles if self.kinds[it] == "refactor.rewrite"]),
            ({"only": ["source"]}, []),
            ({"only": ["refactor.ex", "refactor.extract.function"]}, []),
        ]
        for context, expected in cases:
            with self.subTest(context):
                self.assertEqual(expected, list(self.ask(text, **context)))

    def test_byte_order_mark_and_line_ends(self):
        text = "\ufeff" + main(TWO).replace("\n", "\r\n")
        self.put(text)
        found = self.actions(text, text.index("<Wait name"))
        wait = '      <Wait name="then" seconds="{later}"/>\r\n'
        self.assertEqual(text.replace(wait, ""), found["Delete Wait"])
        self.assertEqual(0, len(re.findall("[^\r]\n", found["Extract into the SubTree 'then'"])))
        one = "\ufeff<root lockstep=\"1\"><BehaviorTree ID=\"Main\"><Wait seconds=\"1\"/></BehaviorTree></root>"
        self.put(one)
        self.assertEqual(one.replace("<Wait seconds=\"1\"/>", "<Inverter><Wait seconds=\"1\"/></Inverter>"),
                         self.actions(one, one.index("<Wait"))["Wrap in Inverter"])

    def test_a_tree_of_another_file(self):
        other = self.path.with_name("other.xml")
        other.write_text(root('  <BehaviorTree ID="Saved">\n    <Wait seconds="1"/>\n  </BehaviorTree>\n').replace(
            ' main_tree_to_execute="Main"', ""))
        unsaved = other.read_text().replace('"1"/>', '"2"/>')
        self.put(unsaved, other)
        text = main('    <SubTree ID="Saved"/>\n').replace("  <Beh", '  <include path="other.xml"/>\n  <Beh')
        self.put(text)
        found = self.actions(text, text.index("<SubTree"))
        self.assertEqual(text.replace('<SubTree ID="Saved"/>', '<Wait seconds="2"/>'),
                         found["Put the tree 'Saved' in the place of this SubTree"])

    def test_versions(self):
        self.client.versions = {}
        other = Client()
        other.ask("initialize", {"processId": None, "rootUri": None, "capabilities": {
            "workspace": {"workspaceEdit": {"documentChanges": True}}}})
        other.notify("initialized")
        text = main(TWO)
        other.open(self.path, text)
        other.send_change(self.path, text + "\n")
        actions = other.about("textDocument/codeAction", self.path, context={"diagnostics": []},
                              range=Client.range(place(text, text.index("<Wait name")), place(text, text.index("<Wait name"))))
        for it in actions:
            change = it["edit"]["documentChanges"][0]
            self.assertEqual({"uri": self.path.as_uri(), "version": 2}, change["textDocument"])
            self.assertNotEqual(text, edited(text, change["edits"]))
        self.assertTrue(actions)
        self.assertEqual(other.stop(), 0)


def files():
    found = [*(SOURCE / "trees").rglob("*.xml")]
    for folder in ("good", "bad", "btcpp/good", "btcpp/bad"):
        found += (SOURCE / "tests/trees" / folder).glob("*.xml")
    return sorted(it for it in found if not it.name.endswith((".test.xml", ".leaves.xml")))


def lockstep(path, text, command, *options):
    """About a text in the place of the file."""
    return subprocess.run([os.environ["LOCKSTEP"], command, "-", *PLUGINS, *options], input=text.encode(), cwd=path.parent,
                          capture_output=True)


def errors_of(path, text):
    return sorted(it["message"] for it in json.loads(lockstep(path, text, "check", "--format", "json").stdout)
                  if it["severity"] == "error")


def leaf_ticks(path, text):
    """Which leaf was ticked in each tick, was held, and is what then, as far as that changes; and how the run ended. Nothing
    if it cannot run, or does what real time says."""
    options = [it for name, value in re.findall(r"<!-- with (set|arg) (.*?) -->", text) for it in ("--" + name, value)]
    with tempfile.TemporaryDirectory() as directory:
        record = Path(directory) / "run.jsonl"
        lockstep(path, text, "run", "--clock", "virtual", "--max-ticks", "300", "--view", "none", "--record", record, *options)
        lines = [json.loads(it) for it in record.read_text().splitlines()] if record.exists() else []
    if not lines or 'name="exec"' in text:
        return None
    nodes = lines[0]["nodes"]
    parents = {it["parent"] for it in nodes}
    leaves = [it["index"] for it in nodes if it["index"] not in parents and it["kind"] != "SubTree" and "members" not in it]
    numbers = {index: number for number, index in enumerate(leaves)}
    states, ticks = {}, []
    for line in lines[1:]:
        # The progress of a leaf that begins is shown otherwise below a synchronized node.
        for index, status, _, is_ticked, is_held in line.get("nodes", []):
            if index in numbers and states.get(index) != (status, is_ticked, is_held):
                states[index] = (status, is_ticked, is_held)
                ticks.append((line["tick"], numbers[index], *states[index]))
    end = {name: lines[-1]["end"][name] for name in ("result", "ticks")}
    return [nodes[it]["kind"] for it in leaves], end, ticks


def keeps_the_run(text, at, title):
    bare = re.match(r'<Sequence( name="[^"]*"| memory="\w+")*>', text[at:]) is not None
    return title == "Wrap in Sequence" or title.startswith(("Extract", "Put ")) or (
        bare and title == "Replace Sequence by its child")


class EveryTree(Actions):
    def test_no_tree_gets_an_error(self):
        self.client.start(SOURCE)
        choose = random.Random(34)
        tried, runs = {}, 0
        for path in files():
            try:
                text = path.read_bytes().decode()
            except UnicodeDecodeError:
                continue  # no editor has such a text
            places = [it.start() for it in re.finditer(r"<[A-Z]", text)]
            self.put(text, path)
            errors, before = errors_of(path, text), None
            for at in choose.sample(places, min(PLACES, len(places))):
                found = self.actions(text, at, path=path, only=["refactor"])
                titles = [it for it in found if PLACES > 2 or keeps_the_run(text, at, it)]
                titles += choose.sample(sorted(found), min(2, len(found)))
                for title in dict.fromkeys(titles):
                    with self.subTest(f"{path}:{place(text, at)[0] + 1}: {title}"):
                        after = found[title]
                        known = list(errors)
                        for it in errors_of(path, after):
                            self.assertIn(it, known, after)
                            known.remove(it)
                        kind = title.split(" '")[0]
                        tried[kind] = tried.get(kind, 0) + 1
                        if errors or not keeps_the_run(text, at, title):
                            continue
                        before = before or leaf_ticks(path, text)
                        if before:
                            self.assertEqual(before, leaf_ticks(path, after), after)
                            runs += 1
            self.client.close(path)
        print(sum(tried.values()), "refactorings,", runs, "runs", tried)
        self.assertGreater(sum(tried.values()), 200)
        self.assertGreater(runs, 60)


if __name__ == "__main__":
    unittest.main()
