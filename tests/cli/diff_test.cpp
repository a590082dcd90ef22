#include <catch2/catch.hpp>
#include <initializer_list>
#include <utility>

#include "support/json.h"
#include "support/paths.h"
#include "support/program.h"

using namespace lockstep::host::test;

namespace {

const std::string kTree = R"(<root lockstep="1" main_tree_to_execute="Main">
  <arg name="pause" default="2"/>
  <barrier name="meet" barriers="0.5"/>
  <property name="safe">never left.failure</property>
  <BehaviorTree ID="Main">
    <Sequence name="all">
      <Wait name="first" seconds="1"/>
      <Parallel name="arms">
        <Wait name="left" seconds="${pause}"/>
        <SyncProgress barrier="meet"><Wait name="middle" seconds="3"/></SyncProgress>
        <SyncProgress barrier="meet"><Wait name="right" seconds="3"/></SyncProgress>
      </Parallel>
      <Grasp name="grasp" force="5"/>
      <SubTree ID="Part" name="p1"/>
      <SubTree ID="Part" name="p2"/>
      <SubTree ID="Part" name="p3"/>
      <SubTree ID="Part" name="p4"/>
      <SubTree ID="Part" name="p5"/>
      <Sequence name="end"><Wait name="x" seconds="7"/><Check name="c" code="1 == 1"/></Sequence>
    </Sequence>
  </BehaviorTree>
  <BehaviorTree ID="Part"><Sequence><Move name="go" to="1"/><Move name="back" to="2"/></Sequence></BehaviorTree>
</root>
)";

using Edits = std::initializer_list<std::pair<std::string, std::string>>;

std::string edited(const Edits& edits) {
  std::string text = kTree;
  for (const auto& [from, to] : edits) {
    const auto place = text.find(from);
    REQUIRE(place != std::string::npos);
    text.replace(place, from.size(), to);
  }
  return text;
}

// What `diff` prints, without the places, which are at the ends of the lines.
std::string changes(const Edits& edits) {
  const TemporaryDirectory directory;
  const Outcome outcome = run_lockstep(
      {"diff", directory.file("a.xml", kTree), directory.file("b.xml", edited(edits))});
  CHECK(outcome.err.empty());
  CHECK(outcome.code == (outcome.out.empty() ? 0 : 1));
  std::string text;
  for (const std::string& line : lines(outcome.out)) {
    text += line.substr(0, line.find("  " + directory.path(""))) + '\n';
  }
  return text;
}

}  // namespace

TEST_CASE("diff: layout, comments, order of attributes and written defaults are no change") {
  CHECK(changes({}).empty());
  CHECK(changes({{"<root", "<!-- c -->\n\n<root"},
                 {"name=\"first\" seconds=\"1\"", "seconds=\"1.0\"\n  name=\"first\""},
                 {"1 == 1", "1==1"},
                 {"<Parallel name=\"arms\">", "<Parallel name=\"arms\" success_count=\"3\">"}})
            .empty());
}

TEST_CASE("diff: what an editor keeps of a node is no change, and what remaps an entry is one") {
  const TemporaryDirectory directory;
  const auto file = [&](const char* name, const std::string& attributes) {
    return directory.file(
        name, "<root BTCPP_format=\"4\"><BehaviorTree ID=\"A\"><SubTree ID=\"B\"" + attributes +
                  "/></BehaviorTree><BehaviorTree ID=\"B\"><AlwaysSuccess/>"
                  "</BehaviorTree></root>");
  };
  const std::string plain = file("a.xml", "");
  const auto code = [&](const std::string& attributes) {
    return run_lockstep({"diff", "--tree", "A", plain, file("b.xml", attributes)}).code;
  };
  CHECK(code(" _uid=\"7\" _fullpath=\"A/B\" _description=\"x\" _collapsed=\"true\"") == 0);
  CHECK(code(" _autoremap=\"false\"") == 0);
  CHECK(code(" _autoremap=\"true\"") == 1);
  CHECK(code(" _skipIf=\"1 == 1\"") == 1);
}

TEST_CASE("diff: a value, a guard, an argument, a barrier, a property, a kind") {
  CHECK(changes({{"force=\"5\"", "force=\"8\""}}) ==
        "changed  Main/all/grasp  force 5 → 8\n1 changed\n");
  CHECK(changes({{"force=\"5\"", "force=\"5\" failure_if=\"1 == 2\""}}) ==
        "changed  Main/all/grasp  failure_if 1 == 2 added\n1 changed\n");
  CHECK(changes({{"default=\"2\"", "default=\"4\""}}) ==
        "changed  Main/all/arms/left  seconds 2 → 4\n1 changed\n");
  CHECK(changes({{"barriers=\"0.5\"", "barriers=\"0.25;0.5\""}}) ==
        "changed  Main/meet  barriers 0.5 → 0.25;0.5\n1 changed\n");
  CHECK(changes({{"never left", "never right"}}) ==
        "changed  property safe  never left.failure → never right.failure\n1 property\n");
  CHECK(changes({{"<Sequence name=\"end\">", "<Fallback name=\"end\">"},
                 {"</Sequence>\n    </Sequence>", "</Fallback>\n    </Sequence>"}}) ==
        "changed  Main/all/end  Sequence → Fallback\n1 changed\n");
  CHECK(changes({{"<Parallel name=\"arms\">", "<Parallel name=\"arms\" success_count=\"2\">"}}) ==
        "changed  Main/all/arms  success_count 3 (default) → 2\n1 changed\n");
}

TEST_CASE("diff: nodes that come, go, move, or get another name") {
  const std::string end =
      "<Sequence name=\"end\"><Wait name=\"x\" seconds=\"7\"/><Check name=\"c\" code=\"1 == "
      "1\"/></Sequence>";
  CHECK(changes({{"<Wait name=\"first\" seconds=\"1\"/>", ""}}) ==
        "gone     Main/all/first  Wait 'first' seconds=\"1\"\n1 gone\n");
  CHECK(changes({{"name=\"grasp\"", "name=\"grab\""}}) ==
        "renamed  Main/all/grab  grasp → grab\n1 renamed\n");
  CHECK(changes({{end, ""}, {"<Parallel", end + "<Parallel"}}) ==
        "moved    Main/all/end  child 9 → 2 of all\n1 moved\n");
  CHECK(changes({{"<Grasp name=\"grasp\" force=\"5\"/>", ""},
                 {"<Wait name=\"x\"", "<Grasp name=\"grasp\" force=\"5\"/><Wait name=\"x\""}}) ==
        "moved    Main/all/end/grasp  from Main/all/grasp\n1 moved\n");
  CHECK(changes({{"main_tree_to_execute=\"Main\"", "main_tree_to_execute=\"Top\""},
                 {"ID=\"Main\"", "ID=\"Top\""}})
            .starts_with("renamed  the tree  Main → Top"));
}

TEST_CASE("diff: a node that is put around another one, also if that one changes") {
  const std::string grasp = "<Grasp name=\"grasp\" force=\"5\"/>";
  CHECK(changes({{grasp, "<Retry name=\"retry\" attempts=\"3\">" + grasp + "</Retry>"}}) ==
        "new      Main/all/retry  Retry 'retry' attempts=\"3\" around Main/all/grasp\n1 new\n");
  CHECK(changes({{grasp, "<Retry attempts=\"3\"><Grasp name=\"grasp\" force=\"9\"/></Retry>"}}) ==
        "new      Main/all/Retry  Retry attempts=\"3\" around Main/all/grasp\n"
        "changed  Main/all/Retry/grasp  force 5 → 9\n"
        "1 changed, 1 new\n");
  CHECK(changes({{"<Sequence name=\"all\">", "<Retry attempts=\"2\"><Sequence name=\"all\">"},
                 {"</Sequence>\n  </Beh", "</Sequence></Retry>\n  </Beh"}}) ==
        "new      Main/Retry  Retry attempts=\"2\" around Main/all\n1 new\n");
  // Another child of the parallel waits at the barrier.
  CHECK(changes(
            {{"<Wait name=\"left\" seconds=\"${pause}\"/>",
              "<SyncProgress barrier=\"meet\"><Wait name=\"left\" "
              "seconds=\"${pause}\"/></SyncProgress>"},
             {"<SyncProgress barrier=\"meet\"><Wait name=\"right\" seconds=\"3\"/></SyncProgress>",
              "<Wait name=\"right\" seconds=\"3\"/>"}}) ==
        "new      Main/all/arms/SyncProgress  SyncProgress barrier=\"meet\" around "
        "Main/all/arms/left\n"
        "gone     Main/all/arms/SyncProgress#2  SyncProgress barrier=\"meet\" around "
        "Main/all/arms/SyncProgress#2/right\n"
        "1 new, 1 gone\n");
}

TEST_CASE("diff: a change of a tree that is used five times is one change") {
  const std::string also =
      "         also Main/all/p2/Sequence/go, Main/all/p3/Sequence/go, Main/all/p4/Sequence/go "
      "and 1 more\n";
  CHECK(changes({{"to=\"1\"", "to=\"3\""}}) ==
        "changed  Main/all/p1/Sequence/go  to 1 → 3\n" + also + "1 changed\n");
  CHECK(changes({{"<Move name=\"go\" to=\"1\"/><Move name=\"back\" to=\"2\"/>",
                  "<Move name=\"back\" to=\"2\"/><Move name=\"go\" to=\"1\"/>"}})
            .starts_with("moved    Main/all/p1/Sequence/back  child 2 → 1 of Sequence\n"));
}

TEST_CASE("diff: a long list of equal leaves without names, with one more in it") {
  const TemporaryDirectory directory;
  const auto tree = [](const std::string& nodes) {
    return "<root lockstep=\"1\"><BehaviorTree ID=\"M\"><Sequence>" + nodes +
           "</Sequence></BehaviorTree></root>";
  };
  std::string waits;
  for (int i = 0; i < 2000; ++i) waits += "<Wait seconds=\"1\"/>";
  const std::string a = directory.file("a.xml", tree(waits + waits)),
                    b = directory.file("b.xml", tree(waits + "<Wait seconds=\"2\"/>" + waits));
  const Outcome outcome = run_lockstep({"diff", a, b});
  CHECK(outcome.out.starts_with("new      M/Sequence/Wait#2001  Wait seconds=\"2\""));
  CHECK(outcome.out.ends_with("\n1 new\n"));
}

TEST_CASE("diff --format: JSON, both trees in one as text and as a drawing") {
  const TemporaryDirectory directory;
  const std::string a = directory.file("a.xml", kTree);
  const std::string b = directory.file(
      "b.xml",
      edited({{"force=\"5\"", "force=\"8\""}, {"<Wait name=\"first\" seconds=\"1\"/>", ""}}));
  const Outcome json = run_lockstep({"diff", a, b, "--format", "json"});
  CHECK(json.code == 1);
  CHECK(contains(json.out, "\"change\":\"gone\""));
  CHECK(contains(json.out, "\"values\":[{\"name\":\"force\",\"old\":\"5\",\"new\":\"8\"}]"));
  CHECK(contains(json.out, "\"line\":13"));
  const Outcome tree = run(
      {.arguments = {"diff", a, b, "--format", "tree"}, .environment = {{"LC_ALL", "C.UTF-8"}}});
  CHECK(tree.out ==
        "Main\n"
        "  ├── Sequence 'all'\n"
        "- │   ├── Wait 'first' seconds=\"1\"\n"
        "  │   ├── Parallel 'arms'  … 5 nodes\n"
        "~ │   ├── Grasp 'grasp' force=\"8\"  (force 5 → 8)\n"
        "  │   └── … 23 nodes\n"
        "  └── barrier 'meet' barriers=\"0.5\"\n");
  const Outcome svg = run_lockstep({"diff", a, b, "--format", "svg"});
  CHECK(svg.out.starts_with("<svg "));
  CHECK(contains(svg.out, "class=\"gone\">Wait 'first' seconds=&quot;1&quot;</text>"));
  const Outcome page = run_lockstep({"diff", a, b, "--format", "html"});
  CHECK(contains(page.out, "</svg>"));
  CHECK(contains(page.out, "gone     Main/all/first"));
}

TEST_CASE("diff: files with trees for other files are compared tree by tree") {
  const TemporaryDirectory directory;
  const std::string a = directory.file(
      "a.xml",
      "<root lockstep=\"1\"><BehaviorTree ID=\"A\"><Wait seconds=\"1\"/></BehaviorTree>"
      "<BehaviorTree ID=\"B\"><Wait seconds=\"1\"/></BehaviorTree></root>");
  const std::string b = directory.file(
      "b.xml",
      "<root lockstep=\"1\"><BehaviorTree ID=\"A\"><Wait seconds=\"2\"/></BehaviorTree>"
      "<BehaviorTree ID=\"C\"><Wait seconds=\"1\"/></BehaviorTree></root>");
  const Outcome outcome = run_lockstep({"diff", a, b});
  CHECK(outcome.code == 1);
  CHECK(contains(outcome.out, "changed  A/Wait  seconds 1 → 2"));
  CHECK(contains(outcome.out, "gone     B  the tree"));
  CHECK(contains(outcome.out, "new      C  the tree"));
  CHECK(run_lockstep({"diff", a, b, "--format", "svg"}).code == 2);
  CHECK(run_lockstep({"diff", a, b, "--tree", "A", "--format", "svg"}).code == 1);
}

TEST_CASE("diff: a property of files with trees for other files is compared once") {
  const TemporaryDirectory directory;
  const auto file = [&](const std::string& name, const std::string& result) {
    return directory.file(
        name, "<root lockstep=\"1\"><property name=\"p\">never Wait." + result +
                  "</property><BehaviorTree ID=\"A\"><Wait seconds=\"1\"/></BehaviorTree>"
                  "<BehaviorTree ID=\"B\"><Wait seconds=\"1\"/></BehaviorTree></root>");
  };
  const Outcome outcome = run_lockstep({"diff", file("a.xml", "failure"), file("b.xml", "idle")});
  INFO(outcome.out << outcome.err);
  CHECK(outcome.code == 1);
  CHECK(contains(outcome.out, "Wait.idle"));
  CHECK(outcome.out.find("Wait.idle") == outcome.out.rfind("Wait.idle"));
}

TEST_CASE("diff: the time for files with many trees is in proportion to their number") {
  const TemporaryDirectory directory;
  const auto seconds = [&](int trees) {
    std::string text = "<root lockstep=\"1\">\n";
    for (int tree = 0; tree < trees; ++tree) {
      text += "<BehaviorTree ID=\"T" + std::to_string(tree) +
              "\"><Sequence><Wait seconds=\"1\"/><Wait seconds=\"2\"/></Sequence></BehaviorTree>\n";
    }
    const std::string file = directory.file("many.xml", text + "</root>");
    const Outcome outcome = run_lockstep({"diff", file, file});
    CHECK(outcome.code == 0);
    return outcome.cpu_seconds;
  };
  const double few = seconds(2000), many = seconds(8000);
  INFO(few << " s, " << many << " s");
  CHECK(many < 9 * few);
}

TEST_CASE("diff: exit codes for what cannot be compared") {
  const TemporaryDirectory directory;
  const std::string a = directory.file("a.xml", kTree), bad = directory.file("bad.xml", "<root");
  CHECK(run_lockstep({"diff", a, bad}).code == 3);
  CHECK(run_lockstep({"diff", a, directory.path("none.xml")}).code == 3);
  CHECK(run_lockstep({"diff", a, a, a}).code == 2);
  CHECK(run_lockstep({"diff", "-", "-"}).code == 2);
}

TEST_CASE("diff git:REV reads a file and its includes as the revision has them") {
  const TemporaryDirectory directory;
  directory.file("main.xml",
                 "<root lockstep=\"1\" main_tree_to_execute=\"M\"><include path=\"part.xml\"/>"
                 "<BehaviorTree ID=\"M\"><SubTree ID=\"P\"/></BehaviorTree></root>\n");
  directory.file("part.xml",
                 "<root lockstep=\"1\"><BehaviorTree ID=\"P\">"
                 "<Wait seconds=\"1\"/></BehaviorTree></root>\n");
  const Outcome outcome = shell(R"(
    export GIT_CONFIG_GLOBAL=/dev/null GIT_CONFIG_SYSTEM=/dev/null HOME=$PWD
    git init -q . && git config user.email a@example.com && git config user.name a
    git add . && git commit -qm one
    sed -i s/seconds=.1./seconds=\"2\"/ part.xml && git commit -qam two
    git mv main.xml top.xml
    sed -i s/seconds=.2./seconds=\"3\"/ part.xml
    lockstep diff git:HEAD~1:main.xml git:HEAD; echo $?
    lockstep diff git:HEAD:main.xml top.xml; echo $?
    lockstep diff part.xml; echo $?
    lockstep diff git:none part.xml; echo $?
    lockstep diff git:HEAD none.xml; echo $?
    git config diff.lockstep.command 'lockstep diff --git'
    echo '*.xml diff=lockstep' > .gitattributes
    git diff; echo $?
    echo '<root' > part.xml; git diff 2>&1 | tail -1)",
                                directory);
  CHECK(outcome.out ==
        "changed  M/P/Wait  seconds 1 → 2  HEAD~1:part.xml:1 → HEAD:part.xml:1\n1 changed\n1\n"
        "changed  M/P/Wait  seconds 2 → 3  HEAD:part.xml:1 → part.xml:1\n1 changed\n1\n"
        "changed  P/Wait  seconds 2 → 3  HEAD:part.xml:1 → part.xml:1\n1 changed\n1\n"
        "2\n2\n"
        "lockstep diff a/part.xml b/part.xml\n"
        "changed  P/Wait  seconds 2 → 3  a/part.xml:1 → b/part.xml:1\n1 changed\n0\n"
        "not compared; `git diff --no-ext-diff` shows the texts\n");
  CHECK(contains(outcome.err, "git has no revision 'none'"));
  CHECK(contains(outcome.err, "the revision 'HEAD' has no file 'none.xml'"));
}

TEST_CASE("diff shows what has changed in a team at what stands for the other robots") {
  const TemporaryDirectory directory;
  const auto team = [&](const std::string& name, const std::string& attributes) {
    return directory.file(name, R"(<root lockstep="1"><team name="t" )" + attributes +
                                    R"(/><resources name="R" team="t" as="a" resources="x"/>
<BehaviorTree ID="M"><Sequence><InStep team="t" as="a" barriers="0.5"><Wait seconds="1"/></InStep>
<UseResources pool="R" resources="x"><Wait seconds="1"/></UseResources></Sequence></BehaviorTree></root>)");
  };
  const std::string old = team("a.xml", R"(members="a;b" deadline="2")");
  const Outcome deadline =
      run_lockstep({"diff", old, team("b.xml", R"(members="a;b" deadline="0.5")")});
  CHECK(deadline.code == 1);
  CHECK(contains(deadline.out, "M/Sequence/InStep/b  deadline 2 → 0.5"));
  const Outcome order = run_lockstep({"diff", old, team("c.xml", R"(members="b;a" deadline="2")")});
  CHECK(contains(order.out, "members a;b → b;a"));
  CHECK(run_lockstep({"diff", old, old}).code == 0);
}

TEST_CASE("diff: what the model of a SubTree adds is a part of the tree") {
  const TemporaryDirectory directory;
  const auto tree = [&](const std::string& name, const std::string& attributes,
                        const std::string& port) {
    return directory.file(
        name,
        "<root BTCPP_format=\"4\" main_tree_to_execute=\"M\"><BehaviorTree ID=\"M\"><Sequence>"
        "<SubTree ID=\"S\"" +
            attributes +
            "/><Sleep msec=\"1\"/></Sequence></BehaviorTree>"
            "<BehaviorTree ID=\"S\"><ScriptCondition code=\"go == 'yes'\"/></BehaviorTree>"
            "<TreeNodesModel><SubTree ID=\"S\"><input_port name=\"go\"" +
            port + "/></SubTree></TreeNodesModel></root>");
  };
  const std::string yes = tree("yes.xml", "", " default=\"yes\"");
  const Outcome outcome = run_lockstep({"diff", yes, tree("no.xml", "", " default=\"no\"")});
  CHECK(outcome.code == 1);
  CHECK(contains(outcome.out, "M/Sequence/S  go yes → no"));
  CHECK(run_lockstep({"diff", yes, tree("written.xml", " go=\"yes\"", "")}).code == 0);
}

TEST_CASE("diff git:REV writes nothing outside of its folder, and follows links within it") {
  const TemporaryDirectory directory;
  const Outcome outcome = shell(R"(
    export GIT_CONFIG_GLOBAL=/dev/null GIT_CONFIG_SYSTEM=/dev/null HOME=$PWD TMPDIR=$PWD/tmp
    mkdir tmp repo && cd repo && git init -q . 2>/dev/null
    git config user.email a@example.com && git config user.name a
    mkdir real && ln -s real linked
    echo '<root lockstep="1"><BehaviorTree ID="P"><Wait seconds="1"/></BehaviorTree></root>' > real/p.xml
    echo '<root lockstep="1" main_tree_to_execute="M"><include path="linked/p.xml"/><BehaviorTree ID="M"><SubTree ID="P"/></BehaviorTree></root>' > t.xml
    git add . && git commit -qm one
    sed -i s/seconds=.1./seconds=\"2\"/ real/p.xml
    lockstep diff t.xml
    blob=$(git rev-parse HEAD:t.xml); part=$(git rev-parse HEAD:real)
    outside=$(printf "100644 blob $blob\tevil.xml\n" | git mktree)
    up=$(printf "040000 tree $outside\t..\n" | git mktree)
    tree=$(printf "100644 blob $blob\tt.xml\n040000 tree $part\tlinked\n040000 tree $up\tx\n040000 tree $up\t..\n" | git mktree)
    lockstep diff git:$tree t.xml; ls -A ../tmp; find .. -name evil.xml)",
                                directory);
  CHECK(outcome.out.starts_with(
      "changed  M/P/Wait  seconds 1 → 2  HEAD:linked/p.xml:1 → linked/p.xml:1\n1 changed\n"));
  CHECK(contains(outcome.out, ":linked/p.xml:1 → linked/p.xml:1\n1 changed\n"));
  CHECK(!contains(outcome.out, "evil"));
  CHECK(outcome.out.ends_with("1 changed\n"));
}
