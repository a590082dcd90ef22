"""What the server answers about places in a text. '|' in a text is the cursor, and not of the text."""
import os
import subprocess
import unittest
from pathlib import Path

from client import Client, Session, edited

SOURCE = Path(os.environ["SOURCE"])

HEAD = """<root lockstep="1" main_tree_to_execute="Main">
  <plugin name="motion"/>
  <arg name="pace" default="0.5" doc="How fast."/>
  <barrier name="table" barriers="0.5"/>
  <resources name="tools" resources="drill;saw"/>
  <BehaviorTree ID="Other" _description="The other one.">
    <Script code="inner := 1"/>
  </BehaviorTree>
  <BehaviorTree ID="Main">
    <Sequence>
      <Script code="word := 'grüß'; limit := 2"/>
"""
TAIL = """
    </Sequence>
  </BehaviorTree>
</root>
"""


class Features(Session):
    def setUp(self):
        super().setUp()
        self.client.start(self.directory.name)

    def put(self, text, path=None):
        """Opens or changes the file; the place of the cursor."""
        path = path or self.path
        before, cursor, after = text.partition("|")
        text = before + after if cursor else text
        if path in self.client.versions:
            self.client.change(path, text)
        else:
            self.client.open(path, text)
        self.text = text
        return before.count("\n"), len(before.rpartition("\n")[2].encode("utf-16-le")) // 2

    def complete(self, text, path=None):
        line, character = self.put(text, path)
        items = self.client.at("textDocument/completion", path or self.path, line, character)["items"]
        return {it["label"]: it for it in sorted(items, key=lambda it: it["sortText"])}

    def here(self, line):
        """The labels where that line stands in a Sequence of a tree."""
        return list(self.complete(HEAD + line + TAIL))

    def applied(self, item):
        edit = item["textEdit"]
        return self.edited([edit])

    def edited(self, edits):
        return edited(self.text, edits)

    def test_completion_of_nodes(self):
        for line in ("<|", "<Wa|", "<Wa|\n<Wait seconds=\"1\"/>", "|", "<Fallback><|", "<Fallback>\n<Se|\n</Fallback>"):
            with self.subTest(line):
                labels = self.here(line)
                self.assertIn("Wait", labels)
                self.assertIn("Advance", labels)  # of the plugin
                self.assertIn("SubTree", labels)
                self.assertNotIn("barrier", labels)
                self.assertNotIn("BehaviorTree", labels)
        items = self.complete(HEAD + "<Wa|" + TAIL)
        self.assertIn("Wait seconds=\"$1\"/>$0", self.applied(items["Wait"]))
        self.assertEqual(self.applied(items["Wait"]), HEAD + "<Wait seconds=\"$1\"/>$0" + TAIL)
        self.assertIn("seconds", items["Wait"]["documentation"]["value"])
        items = self.complete(HEAD + "<Wa| seconds=\"1\"/>" + TAIL)
        self.assertEqual(self.applied(items["Wait"]), HEAD + "<Wait seconds=\"1\"/>" + TAIL)
        items = self.complete(HEAD + "Wa|" + TAIL)
        self.assertEqual(self.applied(items["Wait"]), HEAD + "<Wait seconds=\"$1\"/>$0" + TAIL)

    def test_completion_beside_trees(self):
        labels = self.complete("<root lockstep=\"1\">\n <|\n</root>")
        self.assertEqual({"BehaviorTree", "plugin", "include", "arg", "property", "scenario", "barrier",
                          "resources", "team"}, set(labels))
        inside = self.complete("<root lockstep=\"1\">\n <scenario name=\"a\">\n  <|\n </scenario>\n</root>")
        self.assertIn("expect", inside)
        self.assertNotIn("Sequence", inside)
        self.assertEqual(["root"], list(self.complete("<|")))
        self.assertEqual([], self.here("<Wait seconds=\"1\"><|</Wait>"))
        self.assertEqual([], self.here("<!-- <| -->"))

    def test_completion_of_end_tags(self):
        items = self.complete(HEAD + "<Fallback>\n</|" + TAIL)
        self.assertEqual(["Fallback"], list(items))
        self.assertEqual(self.applied(items["Fallback"]), HEAD + "<Fallback>\n</Fallback>" + TAIL)

    def test_completion_of_attributes(self):
        for line in ("<Wait |/>", "<Wait sec|", "<Wait |\n<Wait seconds=\"1\"/>", "<Wait sec|\n</Sequence>"):
            with self.subTest(line):
                labels = self.here(line)
                self.assertEqual("seconds", labels[0])
                self.assertIn("name", labels)
                self.assertIn("skip_if", labels)
        labels = self.here("<Wait seconds=\"1\" | name=\"a\"/>")
        self.assertNotIn("seconds", labels)
        self.assertNotIn("name", labels)
        items = self.complete(HEAD + "<Wait sec|=\"1\"/>" + TAIL)
        self.assertEqual(self.applied(items["seconds"]), HEAD + "<Wait seconds=\"1\"/>" + TAIL)
        self.assertIn("number", items["seconds"]["detail"] + "number")
        self.assertIn("inner", self.here("<SubTree ID=\"Other\" |/>"))

    def test_completion_of_values(self):
        cases = {
            "<SubTree ID=\"|\"/>": ["Main", "Other"],
            "<SubTree ID=\"|": ["Main", "Other"],
            "<SubTree ID=\"O|\n<Wait seconds=\"1\"/>": ["Main", "Other"],
            "<Sequence memory=\"|\"/>": ["false", "true"],
            "<SyncProgress barrier=\"|\"/>": ["table"],
            "<UseResources pool=\"tools\" resources=\"drill;|\"/>": ["drill", "saw"],
            "<UseResources pool=\"tools\" resources=\"any(|\"/>": ["drill", "saw"],
            "<UseResources pool=\"tools\" on_change=\"|\"/>": ["exchange", "keep", "release"],
            "<Wait seconds=\"${|\"/>": ["${pace}"],
            "<Wait seconds=\"$|": ["${pace}"],
            "<Wait seconds=\"${p|}\"/>": ["${pace}"],
        }
        for line, expected in cases.items():
            with self.subTest(line):
                labels = self.here(line)
                for label in expected:
                    self.assertIn(label, labels)
        items = self.complete(HEAD + "<Wait seconds=\"${p|}\"/>" + TAIL)
        self.assertEqual(self.applied(items["${pace}"]), HEAD + "<Wait seconds=\"${pace}\"/>" + TAIL)
        items = self.complete(HEAD + "<Wait seconds=\"{li|\n<Wait seconds=\"2\"/>" + TAIL)
        self.assertEqual(self.applied(items["{limit}"]),
                         HEAD + "<Wait seconds=\"{limit}\n<Wait seconds=\"2\"/>" + TAIL)
        self.assertIn("{word}", items)

    def test_completion_in_scripts(self):
        items = self.complete(HEAD + "<Script code=\"limit = li|\"/>" + TAIL)
        self.assertEqual(self.applied(items["limit"]), HEAD + "<Script code=\"limit = limit\"/>" + TAIL)
        self.assertIn("word", items)
        self.assertIn("progress()", items)
        self.assertIn("limit", self.here("<Wait seconds=\"1\" skip_if=\"|"))

    def test_completion_behind_a_blank_in_an_open_quote(self):
        for typed in ("<Check code=\"limit == |", "<Check code=\"limit > 3 &amp;&amp; |", "<Check code=\"limit == 1 &amp;&amp;  l|",
                      "<Script code=\"word = 'a'; limit=|", "<Check code=\"limit == |/>", "<Check code=\"limit == |\n<Wait seconds=\"1\"/>",
                      "<Wait seconds=\"1\" on_success=\"limit |", "<WaitUntil code=\"limit > 3 &amp;&amp; |"):
            for end in (TAIL, ""):
                with self.subTest(typed + end):
                    items = self.complete(HEAD + typed + end)
                    self.assertIn("limit", items)
                    self.assertNotIn("skip_if", items)
        self.assertIn("table", self.here("<SyncProgress barrier=\"a |"))

    def test_completion_in_properties(self):
        text = HEAD + "<Wait name=\"pause\" seconds=\"1\"/>" + TAIL
        for typed, expected in (("|", "never"), ("never pau|", "pause"), ("never pause.|", "held"),
                                ("never pause.r|", "running")):
            with self.subTest(typed):
                items = self.complete(text.replace("</root>", f"<property name=\"p\">{typed}</property></root>"))
                self.assertIn(expected, items)
        self.assertIn("never pause.running</property>", self.applied(items["running"]))

    def test_names_of_nodes_in_properties(self):
        text = HEAD + """<Wait name="pick up" seconds="1"/>
      <SubTree ID="Other"/>
      <Wait name="left-arm" seconds="1"/>
      <Wait name="O'Hara &amp; co" seconds="1"/>
      <Wait name="grüß.2#1" seconds="1"/>
      <Wait name="after" seconds="1"/>
      <Wait name="12" seconds="1"/>""" + TAIL

        def items(typed):
            return self.complete(text.replace("</root>", f"<property name=\"p\">{typed}</property></root>"))
        found = items("never |")
        names = ("'pick up'", "Other", "left-arm", "\"O'Hara &amp; co\"", "grüß.2#1", "'after'", "'12'", "Sequence")
        written = {it: self.applied(found[it]) for it in names}
        for name in names:  # as a property reads them, too
            with self.subTest(name):
                self.put(written[name].replace("</property>", ".running</property>"))
                self.assertEqual([], [it["message"] for it in self.client.diagnostics(self.path) if it["severity"] == 1])
        self.assertFalse({"pick up", "SubTree"} & set(found))
        self.assertIn("never left-arm</property>", self.applied(items("never left-a|")["left-arm"]))
        for typed in ("never 'pi|", "never 'pick u|", "never 'x'.running and 'pick|"):
            with self.subTest(typed):
                after = typed.rpartition("'")[0] + "'pick up'</property>"
                self.assertIn(after, self.applied(items(typed)["'pick up'"]))
        self.assertIn("held", items("never 'pick up'.|"))

    def test_keys_of_the_right_type(self):
        text = HEAD + """<Advance step="{step}"/>
          <Wait seconds="1" name="{step}"/>
          <UseResources pool="tools" resources="{text}"><AlwaysSuccess/></UseResources>
          <Wait seconds="{|"/>""" + TAIL
        labels = self.complete(text)
        self.assertIn("{step}", labels)  # a number
        self.assertNotIn("{text}", labels)

    def test_other_files(self):
        leaves = Path(self.directory.name) / "tree.leaves.xml"
        labels = self.complete("<leaves lockstep=\"1\"><|</leaves>", leaves)
        self.assertEqual({"tree", "fact", "leaf", "accept"}, set(labels))
        labels = self.complete("<leaves lockstep=\"1\"><fact name=\"a\" changes=\"|</leaves>", leaves)
        self.assertEqual({"never", "freely", "rises", "falls"}, set(labels))
        tests = Path(self.directory.name) / "tree.test.xml"
        labels = self.complete("<scenarios lockstep=\"1\"><scenario name=\"a\"><|", tests)
        self.assertIn("leaf", labels)
        self.assertIn("expect", labels)
        labels = self.complete("<scenarios lockstep=\"1\"><scenario name=\"a\"><leaf |", tests)
        self.assertIn("does", labels)

    def test_the_other_language(self):
        text = "<root BTCPP_format=\"4\"><BehaviorTree ID=\"M\"><Sequence><|</Sequence></BehaviorTree></root>"
        labels = self.complete(text)
        self.assertIn("ReactiveSequence", labels)
        self.assertNotIn("Wait", list(labels))
        self.assertIn("_skipIf", self.complete(text.replace("<|", "<Sleep |")))

    def test_hover(self):
        def hover(line):
            place = self.put(HEAD + line + TAIL)
            found = self.client.at("textDocument/hover", self.path, *place)
            return found and found["contents"]["value"]
        self.assertIn("<Wait seconds=", hover("<Wa|it seconds=\"1\"/>"))
        self.assertIn("required", hover("<Wait sec|onds=\"1\"/>"))
        self.assertIn("default 0.5", hover("<Wait seconds=\"${pa|ce}\"/>"))
        self.assertIn("How fast.", hover("<Wait seconds=\"${pa|ce}\"/>"))
        entry = hover("<Wait seconds=\"{li|mit}\"/>")
        self.assertIn("entry limit", entry)
        self.assertIn("written by Script, line 11", entry)
        self.assertIn("The other one.", hover("<SubTree ID=\"Ot|her\"/>"))
        self.assertIsNone(hover("|"))

    def test_hover_of_an_entry_that_a_name_writes(self):
        text = """<root BTCPP_format="4"><BehaviorTree ID="Main"><Sequence>
<SetBlackboard value="1" output_key="go|al"/>
<ScriptCondition code="goal == 1"/></Sequence></BehaviorTree></root>"""
        found = self.client.at("textDocument/hover", self.path, *self.put(text))["contents"]["value"]
        self.assertIn("written by SetBlackboard, line 2", found)
        self.assertIn("read by ScriptCondition, line 3", found)

    def test_definition_and_references(self):
        def places(method, line):
            place = self.put(HEAD + line + TAIL)
            return [(it["range"]["start"]["line"], it["range"]["start"]["character"])
                    for it in self.client.at(method, self.path, *place)]
        self.assertEqual([(5, 20)], places("textDocument/definition", "<SubTree ID=\"Ot|her\"/>"))
        self.assertEqual([(2, 13)], places("textDocument/definition", "<Wait seconds=\"${pa|ce}\"/>"))
        self.assertEqual([(10, 36)], places("textDocument/definition", "<Wait seconds=\"{li|mit}\"/>"))
        self.assertEqual([(3, 17)], places("textDocument/definition", "<SyncProgress barrier=\"ta|ble\"/>"))
        self.assertEqual([(10, 36), (11, 16)], places("textDocument/references", "<Wait seconds=\"{li|mit}\"/>"))
        self.assertEqual([], places("textDocument/references", "<Wait| seconds=\"1\"/>"))

    def test_included_files(self):
        part = Path(self.directory.name) / "part.xml"
        part.write_text("<root lockstep=\"1\"><BehaviorTree ID=\"Saved\"><AlwaysSuccess/></BehaviorTree></root>")
        text = """<root lockstep="1" main_tree_to_execute="Main"><include path="part.xml"/>
<BehaviorTree ID="Main"><SubTree ID="Unsav|ed"/></BehaviorTree></root>"""
        place = self.put(text)
        self.assertIn("unknown", self.client.change(self.path, self.text)[0]["message"])
        # What is not saved counts.
        self.client.open(part, part.read_text().replace("Saved", "Unsaved"))
        self.assertEqual([], self.client.diagnostics(self.path))
        found = self.client.at("textDocument/definition", self.path, *place)
        self.assertEqual([part.as_uri()], [it["uri"] for it in found])
        # While it is broken, the file that includes it has a message.
        whole = part.read_text().replace("Saved", "Unsaved")
        self.client.change(part, whole.replace("</BehaviorTree>", ""))
        self.assertNotEqual([], self.client.diagnostics(self.path))
        self.client.change(part, whole)
        self.assertEqual([], self.client.diagnostics(self.path))
        self.assertIn("Unsaved", self.complete(text.replace("Unsav|ed", "|")))

    def renamed(self, text, name):
        place = self.put(text)
        params = {"textDocument": {"uri": self.path.as_uri()}, "newName": name,
                  "position": {"line": place[0], "character": place[1]}}
        answer = self.client.answer(self.client.send("textDocument/rename", params))
        if "error" in answer:
            return answer["error"]["message"]
        return self.edited(answer["result"]["changes"][self.path.as_uri()])

    def test_rename(self):
        text = HEAD + """<SubTree ID="Other" inner="{limit}"/>
      <Wait seconds="{limit}" skip_if="limit &gt; 3 &amp;&amp; limit != 5"/>
      <Wait seconds="${pace}"/>
      <SyncProgress barrier="table"><AlwaysSuccess/></SyncProgress>""" + TAIL
        changes = {
            "<SubTree ID=\"Oth|er\"": ("Other", "Else", 2),
            "{lim|it}\"/>": ("limit", "most", 5),
            "in|ner=": ("inner", "its", 2),
            "${pa|ce}": ("pace", "speed", 2),
            "barrier=\"ta|ble": ("table", "desk", 2),
        }
        for cursor, (old, new, count) in changes.items():
            with self.subTest(old):
                self.assertEqual(text.count(cursor.replace("|", "")), 1)
                found = self.renamed(text.replace(cursor.replace("|", ""), cursor), new)
                self.assertEqual(found.count(new), count)
                self.assertNotRegex(found, rf"\b{old}\b")
                messages = [it["message"] for it in self.client.diagnostics(self.path)]
                again = [it["message"] for it in self.client.change(self.path, found)]
                self.assertEqual([it.replace(old, new) for it in messages], again)
        limit = text.replace("{limit}\"/>", "{lim|it}\"/>")
        self.assertIn("has an entry 'word' already", self.renamed(limit, "word"))
        self.assertIn("cannot be a key", self.renamed(limit, "a b"))
        self.assertIn("cannot be a name", self.renamed(text.replace("\"table\">", "\"ta|ble\">"), "a b"))
        self.assertIn("cannot be a name", self.renamed(text.replace("\"table\">", "\"ta|ble\">"), "a.b"))
        self.assertIn("cannot be read", self.renamed(limit + "<", "most"))
        self.assertEqual("\ufeff" + self.renamed(limit, "most"), self.renamed("\ufeff" + limit, "most"))
        # A SubTree that passes on all entries binds this one with an attribute from now on.
        found = self.renamed(limit.replace("inner=\"", "_autoremap=\"true\" inner=\""), "most")
        self.assertIn("_autoremap=\"true\" inner=\"{most}\"", found)

    def test_rename_of_a_team_also_in_its_pools(self):
        text = """<root lockstep="1"><team name="trucks" members="a;b"/><resources name="R" team="trucks" as="a" resources="x"/>
<BehaviorTree ID="M"><InStep team="trucks" as="a" barriers="0.5"><Wait seconds="1"/></InStep></BehaviorTree></root>
"""
        for cursor in ("name=\"tru|cks", "team=\"tru|cks\" as=\"a\" resources", "team=\"tru|cks\" as=\"a\" barriers"):
            found = self.renamed(text.replace(cursor.replace("|", ""), cursor), "diggers")
            self.assertEqual(text.replace("trucks", "diggers"), found)

    def test_rename_in_files_that_are_included_as(self):
        part = Path(self.directory.name) / "truck.xml"
        part.write_text("""<root lockstep="1" main_tree_to_execute="Trip"><BehaviorTree ID="Trip"><SubTree ID="Load"/></BehaviorTree>
<BehaviorTree ID="Load"><AlwaysSuccess/></BehaviorTree></root>""")
        text = """<root lockstep="1" main_tree_to_execute="Load"><include path="truck.xml" as="one"/><include path="truck.xml" as="two"/>
<BehaviorTree ID="Load"><Sequence memory="true"><SubTree ID="one.Load"/><SubTree ID="two.Load"/><SubTree ID="two"/>
</Sequence></BehaviorTree></root>"""
        found = self.renamed(text.replace("one.Load", "one.Lo|ad"), "one.Fill")
        self.assertEqual(text.replace("one.Load", "one.Fill").replace("two.Load", "two.Fill"), found)
        place = self.put(text.replace("two.Load", "two.L|oad"))
        changes = self.client.at("textDocument/rename", self.path, *place, newName="two.Fill")["changes"]
        self.assertEqual(["Fill", "Fill"], [it["newText"] for it in changes[part.as_uri()]])
        self.assertIn("its new name must begin with 'one.'", self.renamed(text.replace("one.Load", "one.Lo|ad"), "Fill"))
        self.assertIn("the main tree of an included file", self.renamed(text.replace("ID=\"two\"", "ID=\"tw|o\""), "three"))
        self.assertEqual(text.replace("\"Load\"", "\"All\""), self.renamed(text.replace("ID=\"Load", "ID=\"Lo|ad"), "All"))

    def all_renamed(self, path, text, cursor, name):
        """The texts of the files that a rename changes, by their names; `text` is that of the file."""
        at = text.index(cursor.replace("|", "")) + cursor.index("|")
        place = (text.count("\n", 0, at), at - (text.rfind("\n", 0, at) + 1))
        changes = self.client.at("textDocument/rename", path, *place, newName=name)["changes"]
        return {Path(uri[len("file://"):]).name: sorted(it["newText"] for it in edits) for uri, edits in changes.items()}

    def test_rename_in_a_file_that_others_include(self):
        part = Path(self.directory.name) / "common.xml"
        own = """<root lockstep="1"><barrier name="grab" barriers="0.5"/><BehaviorTree ID="Common"><Sequence>
<Script code="load := 1"/><SyncProgress barrier="grab"><AlwaysSuccess/></SyncProgress></Sequence></BehaviorTree></root>"""
        part.write_text(own)
        for named, prefix in (("", ""), (" as=\"one\"", "one.")):
            with self.subTest(named):
                text = f"""<root lockstep="1"><include path="common.xml"{named}/><barrier name="both" barriers="0.5"/>
<BehaviorTree ID="Main"><SubTree ID="{prefix}Common" load="{{l}}" grab="both"/></BehaviorTree></root>"""
                self.put(text.replace("Main", "Mai|n"))
                self.client.change(part, own) if part in self.client.versions else self.client.open(part, own)
                self.assertEqual({"common.xml": ["All"], self.path.name: [prefix + "All"]},
                                 self.all_renamed(part, own, "ID=\"Com|mon", "All"))
                self.assertEqual({"common.xml": ["it"], self.path.name: ["it"]},
                                 self.all_renamed(part, own, "lo|ad :=", "it"))
                self.assertEqual({"common.xml": ["take", "take"], self.path.name: ["take"]},
                                 self.all_renamed(part, own, "name=\"gr|ab", "take"))
                self.assertEqual({self.path.name: ["meet", "meet"]},
                                 self.all_renamed(self.path, text, "name=\"bo|th", "meet"))

    def test_a_rename_waits_for_what_changes_in_other_files(self):
        part, other = (Path(self.directory.name) / name for name in ("dock.xml", "other.xml"))
        own = """<root lockstep="1"><BehaviorTree ID="Dock"><AlwaysSuccess/></BehaviorTree></root>"""
        part.write_text(own)
        uses = """<root lockstep="1"><include path="dock.xml"/><BehaviorTree ID="Main"><SubTree ID="Dock"/></BehaviorTree></root>"""
        self.client.open(part)
        self.client.open(other, uses.replace("Dock", "Main"))
        for _ in range(10):
            self.client.send_change(other, uses)
            self.assertEqual({"dock.xml": ["All"], "other.xml": ["All"]}, self.all_renamed(part, own, "ID=\"Do|ck", "All"))
            self.client.change(other, uses.replace("Dock", "Main"))

    def test_definition_in_files_that_are_included_as(self):
        part = Path(self.directory.name) / "truck.xml"
        part.write_text("""<root lockstep="1" main_tree_to_execute="Trip"><resources name="road"/>
<BehaviorTree ID="Trip"><SubTree ID="Load"/></BehaviorTree>
<BehaviorTree ID="Load"><UseResources pool="road"><AlwaysSuccess/></UseResources></BehaviorTree></root>""")
        text = """<root lockstep="1" main_tree_to_execute="Main"><include path="truck.xml" as="one"/><include path="truck.xml" as="two"/>
<resources name="road"/>
<BehaviorTree ID="Main"><Sequence><SubTree ID="one.Load" road="road"/><SubTree ID="two"/></Sequence></BehaviorTree></root>"""

        def places(request, cursor):
            at = self.put(text.replace(cursor.replace("|", ""), cursor))
            found = self.client.at(request, self.path, *at, context={"includeDeclaration": True})
            return [(Path(it["uri"]).name, it["range"]["start"]["line"]) for it in found]
        own = self.path.name
        self.assertEqual([("truck.xml", 2)], places("textDocument/definition", "one.Lo|ad"))
        self.assertEqual([("truck.xml", 1)], places("textDocument/definition", "ID=\"tw|o\"/>"))
        self.assertEqual([("truck.xml", 0)], places("textDocument/definition", " ro|ad="))
        self.assertEqual([(own, 1)], places("textDocument/definition", "=\"roa|d\"/><SubTree"))
        self.assertEqual([(own, 1), (own, 2)], places("textDocument/references", "<resources name=\"ro|ad"))
        self.assertEqual({("truck.xml", 2), ("truck.xml", 1), (own, 2)},
                         set(places("textDocument/references", "one.Lo|ad")))
        self.client.open(part)
        found = self.client.at("textDocument/references", part, 2, 18, context={"includeDeclaration": True})
        self.assertEqual({("truck.xml", 2), ("truck.xml", 1), (own, 2)},
                         {(Path(it["uri"]).name, it["range"]["start"]["line"]) for it in found})

    def test_names_that_a_rename_refuses(self):
        text = HEAD + "<Wait seconds=\"{lim|it}\" skip_if=\"limit == 3\"/>" + TAIL
        for name in ("true", "and", "or"):
            self.assertIn(f"'{name}' cannot be a key: scripts have this word", self.renamed(text, name))
        for name in ("name", "ID", "_description", "_autoremap", "skip_if", "while", "on_halt"):
            self.assertIn(f"'{name}' cannot be a key: a SubTree has an attribute", self.renamed(text, name))
        self.assertIn("begins with '_'", self.renamed(text, "_limit"))
        tree = text.replace("lim|it", "limit").replace("ID=\"Oth", "ID=\"O|th")
        for name in ("Sequence", "Wait", "Advance"):
            self.assertIn(f"'{name}' cannot be the ID of a tree: there is a node", self.renamed(tree, name))
        self.assertIn("ID=\"Waits\"", self.renamed(tree, "Waits"))

    def test_a_rename_that_makes_an_error(self):
        text = HEAD + """<Parallel>
        <SubTree ID="Used" own="5"/>
        <SyncProgress barrier="table"><Wait seconds="1"/></SyncProgress>
      </Parallel>""" + TAIL.replace("</root>", """
  <BehaviorTree ID="Used">
    <Sequence><Script code="o|wn := 1"/><SyncProgress barrier="table"><Wait seconds="1"/></SyncProgress></Sequence>
  </BehaviorTree>
</root>""")
        self.put(text)
        self.assertEqual([], [it for it in self.client.diagnostics(self.path) if it["severity"] == 1])
        self.assertIn("the text would have an error: ", self.renamed(text, "table"))
        self.assertIn("its=\"5\"", self.renamed(text, "its"))
        # A path in a property keeps the ID of a tree.
        text = text.replace("o|wn", "own").replace("ID=\"Main\"", "ID=\"Ma|in\"").replace(
            "</root>", "<property>never Main/Sequence.failure</property></root>")
        self.assertIn("never Main/", self.renamed(text, "First"))

    def test_rename_of_an_entry_of_the_main_tree(self):
        text = """<root BTCPP_format="4" main_tree_to_execute="Main">
  <BehaviorTree ID="Main">
    <Sequence><Script code="g := 1; h := 2"/><SubTree ID="Inner" x="{@g}"/><SubTree ID="Inner" x="{g}"/></Sequence>
  </BehaviorTree>
  <BehaviorTree ID="Inner">
    <Sequence><Script code="@g = x + 1; g := 5"/><Script code="@only := @g"/></Sequence>
  </BehaviorTree>
</root>
"""
        after = text.replace("@g", "@all").replace("g := 1", "all := 1").replace("{g}", "{all}")
        for cursor in ("\"@|g = x", "@only := @g|", "\"|@g = x", "{@|g}", "\"g| := 1", "{g|}"):
            with self.subTest(cursor):
                self.assertEqual(1, text.count(cursor.replace("|", "")))
                marked = text.replace(cursor.replace("|", ""), cursor)
                self.assertEqual(after, self.renamed(marked, "all"))
        place = self.put(text.replace("\"@g", "\"@|g"))
        found = self.client.at("textDocument/prepareRename", self.path, *place)
        self.assertEqual("g", found["placeholder"])
        begin, end = found["range"]["start"], found["range"]["end"]
        self.assertEqual("g", text.split("\n")[begin["line"]][begin["character"]:end["character"]])
        marked = text.replace("\"@g", "\"@|g")
        self.assertEqual(after, self.renamed(marked, "@all"))
        self.assertIn("has an entry 'h' already", self.renamed(marked, "h"))
        self.assertIn("has an entry 'only' already", self.renamed(marked, "only"))
        only = text.replace("@only", "@on|ly")
        self.assertEqual(text.replace("@only", "@one"), self.renamed(only, "one"))
        # The entry of the tree that is called so stays.
        own = text.replace("; g :=", "; g| :=")
        self.assertEqual(text.replace("; g :=", "; own :="), self.renamed(own, "own"))
        self.assertIn("does not name its main tree", self.renamed(marked.replace(" main_tree_to_execute=\"Main\"", ""), "all"))

    def test_words_of_scripts_are_no_entries(self):
        text = HEAD + "<Script code=\"w := tr|ue\"/>" + TAIL
        self.assertIn("nothing here has a name", self.renamed(text, "yes"))
        labels = self.complete(HEAD + "<Script code=\"w := true and false\"/><Wait seconds=\"{|\"/>" + TAIL)
        for label in ("{true}", "{false}", "{and}"):
            self.assertNotIn(label, labels)
        self.assertIn("{w}", labels)

    def test_rename_in_what_is_beside_the_trees(self):
        text = HEAD + "<Wait seconds=\"{lim|it}\"/>" + TAIL.replace("</root>", """  <property>{limit} &gt;= 0</property>
  <scenario name="short" main="Main"><set key="limit" value="1"/><expect>{limit} == 1</expect></scenario>
</root>""")
        self.assertNotIn("limit", self.renamed(text, "most"))
        self.assertIn("main=\"First\"", self.renamed(text.replace("lim|it", "limit").replace(
            "BehaviorTree ID=\"Main", "BehaviorTree ID=\"Ma|in"), "First"))

    def test_formatting(self):
        for text in (HEAD + "<Wait    seconds='1'   />" + TAIL, "\ufeff<root   lockstep=\"1\"><BehaviorTree/></root>"):
            with self.subTest(text[:20]):
                self.put(text)
                edits = self.client.about("textDocument/formatting", self.path, options={"tabSize": 2})
                formatted = subprocess.run([os.environ["LOCKSTEP"], "fmt", "-"], input=text.encode(),
                                           capture_output=True, check=True).stdout.decode()
                self.assertNotEqual(text, formatted)
                self.assertEqual(formatted, self.edited(edits))
        self.put("<root")
        self.assertIsNone(self.client.about("textDocument/formatting", self.path, options={}))

    def test_structure(self):
        self.put(HEAD + "<Wait name=\"pause\" seconds=\"1\"/>" + TAIL)
        root = self.client.about("textDocument/documentSymbol", self.path)[0]
        self.assertEqual("root", root["name"])
        names = [it["name"] for it in root["children"]]
        self.assertEqual(["motion", "pace", "table", "tools", "Other", "Main"], names)
        self.assertEqual("pause", root["children"][-1]["children"][0]["children"][1]["name"])
        folds = self.client.about("textDocument/foldingRange", self.path)
        self.assertIn({"startLine": 8, "endLine": 13}, folds)

    def test_lenses_and_hints(self):
        self.put(HEAD + "<Wait seconds=\"${pace}\"/>" + TAIL)
        lenses = self.client.about("textDocument/codeLens", self.path)
        self.assertEqual(["lockstep.run", "lockstep.verify"] * 2, [it["command"]["command"] for it in lenses])
        self.assertEqual("Main", lenses[2]["command"]["arguments"][0]["name"])
        hints = self.client.about("textDocument/inlayHint", self.path, range=Client.range((0, 0), (99, 0)))
        self.assertEqual({"= 0.5", "1/2"}, {it["label"] for it in hints})

    def test_shares_in_the_other_language(self):
        self.put("""<root BTCPP_format="4"><BehaviorTree ID="Main"><ReactiveSequence>
          <Repeat num_cycles="3"><AlwaysSuccess/></Repeat><AlwaysSuccess/>
          </ReactiveSequence></BehaviorTree></root>""")
        hints = self.client.about("textDocument/inlayHint", self.path, range=Client.range((0, 0), (99, 0)))
        self.assertEqual(["1/2", "1/2", "1/3"], sorted(it["label"] for it in hints))

    def test_tokens(self):
        self.put(HEAD + "<Wait seconds=\"${pace}\"/>" + TAIL)
        data = self.client.about("textDocument/semanticTokens/full", self.path)["data"]
        self.assertEqual(0, len(data) % 5)
        # inner := 1, word := 'grüß' ; limit := 2, ${pace}
        self.assertEqual([0, 3, 1, 0, 3, 2, 0, 3, 1, 4], data[3::5])
        # A status is no entry, and neither is the node.
        self.put(HEAD + "<WaitUntil code=\"status(word/limit) == running\"/>" + TAIL)
        data = self.client.about("textDocument/semanticTokens/full", self.path)["data"]
        self.assertEqual([0, 3, 1, 0, 3, 2, 0, 3, 1, 5, 3, 2], data[3::5])

    def fixes(self, line):
        self.put(HEAD + line + TAIL)
        whole = Client.range((0, 0), (99, 0))
        actions = self.client.about("textDocument/codeAction", self.path, range=whole, context={"diagnostics": []})
        return {it["title"]: self.edited(it["edit"]["changes"][self.path.as_uri()]) for it in actions}

    def test_quick_fixes(self):
        cases = {
            "<Fallbak>\n<AlwaysSuccess/>\n</Fallbak>": "<Fallback>\n<AlwaysSuccess/>\n</Fallback>",
            "<Wait second=\"1\"/>": "<Wait seconds=\"1\"/>",
            "<SubTree ID=\"Othr\"/>": "<SubTree ID=\"Other\"/>",
            "<Parallel policy=\"1\"><AlwaysSuccess/></Parallel>": None,
            "<SyncProgress barrier=\"tabel\"><AlwaysSuccess/></SyncProgress>":
                "<SyncProgress barrier=\"table\"><AlwaysSuccess/></SyncProgress>",
        }
        for line, expected in cases.items():
            if expected:
                with self.subTest(line):
                    self.assertIn(HEAD + expected + TAIL, self.fixes(line).values())
        self.assertIn("<Wait seconds=\"1\"/>", self.fixes("<Wait/>")["Add seconds=\"1\""])


if __name__ == "__main__":
    unittest.main()
