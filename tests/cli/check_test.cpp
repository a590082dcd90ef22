#include <catch2/catch.hpp>

#include "support/json.h"
#include "support/paths.h"
#include "support/program.h"

using namespace lockstep::host::test;

TEST_CASE("check says ok on stdout and what is wrong on stderr, for each file") {
  const TemporaryDirectory directory;
  const std::string good = directory.file("good.xml", tree_text("<Advance/>"));
  const std::string bad = directory.file("bad.xml", tree_text("<Advnce/>"));
  const Outcome outcome = run_lockstep({"check", bad, good});
  CHECK(outcome.code == 3);
  CHECK(outcome.out == good + ": ok\n");
  CHECK(contains(outcome.err, bad + ":1:"));
  CHECK(contains(outcome.err, "unknown node 'Advnce'"));
  CHECK(contains(outcome.err, "did you mean 'Advance'?"));
  CHECK(!contains(outcome.err, "\x1b"));
  CHECK(run_lockstep({"check", good}).code == 0);
}

TEST_CASE("check --format json is an array on stdout") {
  const TemporaryDirectory directory;
  const std::string bad = directory.file("bad.xml", tree_text("<Advnce/>"));
  const Outcome outcome = run_lockstep({"check", "--format", "json", bad});
  CHECK(outcome.code == 3);
  CHECK(outcome.err.empty());
  const auto messages = parse_json(outcome.out);
  REQUIRE(messages.size() == 1);
  CHECK(messages[0]["severity"] == "error");
  CHECK(messages[0]["file"] == bad);
  CHECK(messages[0]["line"] == 1);
  CHECK(messages[0]["hint"] == "did you mean 'Advance'?");
}

TEST_CASE("check --format json has the bytes of each message, and the edits that mend it") {
  const TemporaryDirectory directory;
  std::string text =
      "\xEF\xBB\xBF" + tree_text("<Sequnce memory=\"true\"><Wait seconds=\"1\"/></Sequnce>");
  const std::string tree = directory.file("tree.xml", text);
  for (const std::string& given : {tree, std::string("-")}) {
    const Outcome outcome =
        run({.arguments = {"check", "--format", "json", given}, .input = given == "-" ? text : ""});
    const auto messages = parse_json(outcome.out);
    REQUIRE(messages.size() == 1);
    const std::size_t begin = messages[0]["begin"], end = messages[0]["end"];
    CHECK(text.substr(begin, end - begin) == "<Sequnce");
    const auto& edit = messages[0]["edits"][0];
    CHECK(edit["title"] == "Replace 'Sequnce' by 'Sequence'");
    CHECK(edit["certain"] == true);
    std::string mended = text;
    for (std::size_t i = edit["patches"].size(); i-- > 0;) {
      const auto& patch = edit["patches"][i];
      const std::size_t from = patch["begin"], to = patch["end"];
      mended.replace(from, to - from, patch["text"].get<std::string>());
    }
    CHECK(contains(mended, "<Sequence memory=\"true\"><Wait seconds=\"1\"/></Sequence>"));
  }
}

TEST_CASE("a program that knows only the JSON of check mends a tree with five mistakes") {
  const TemporaryDirectory directory;
  std::string text = R"(<root lockstep="1" main_tree_to_execute="Mian">
  <plugin name="moton"/>
  <BehaviorTree ID="Main">
    <Sequnce memory="true">
      <ParallelAbsolute barriers="0.25;0.5">
        <Advance name="left" stp="0.1"/>
        <Advance name="right" step="0.1"/>
      </ParallelAbsolute>
      <SubTree ID="Releas"/>
    </Sequnce>
  </BehaviorTree>
  <BehaviorTree ID="Release">
    <Wait seconds="0.1"/>
  </BehaviorTree>
</root>
)";
  const std::string tree = directory.file("tree.xml", text);
  std::size_t edits = 0;
  Outcome outcome;
  for (; edits < 20; ++edits) {
    outcome = run_lockstep({"check", "--format", "json", tree});
    const auto messages = parse_json(outcome.out);
    const auto has_edit = [](const auto& it) { return !it["edits"].empty(); };
    const auto it = std::ranges::find_if(messages, has_edit);
    if (outcome.code == 0 || it == messages.end()) break;
    const auto& patches = (*it)["edits"][0]["patches"];
    for (std::size_t i = patches.size(); i-- > 0;) {
      const std::size_t from = patches[i]["begin"], to = patches[i]["end"];
      text.replace(from, to - from, patches[i]["text"].get<std::string>());
    }
    directory.file("tree.xml", text);
  }
  INFO(text << outcome.out << outcome.err);
  CHECK(outcome.code == 0);
  CHECK(edits == 5);
  CHECK(run_lockstep({"run", tree, "--clock", "virtual"}).code == 0);
}

// The mistakes that tests/public_trees makes in trees that others wrote.
TEST_CASE(
    "check has an edit for what is misspelt in a tree of BehaviorTree.CPP, a model or another "
    "file") {
  const TemporaryDirectory directory;
  directory.file("other.xml",
                 R"(<root BTCPP_format="4"><BehaviorTree ID="Grasp"><Fly/></BehaviorTree></root>)");
  struct Mistake {
    std::string root, node, title;
  };
  const std::string four = R"(BTCPP_format="4")", three;
  const Mistake mistakes[] = {
      {four, R"(<Gota target="1"/>)", "Replace 'Gota' by 'Goto'"},
      {four, R"(<Goto GotoPlaec="a"/>)", "Replace 'GotoPlaec' by 'GotoPlace'"},
      {four, R"(<Goto target="near"/>)", "Write target=\"1\""},
      {four, R"(<ParallelAbsolute barriers="1;0.5"><Fly/><Fly/></ParallelAbsolute>)",
       "Write barriers=\"0.5;1\""},
      {four, R"(<SubTree ID="Gasp"/>)", "Replace 'Gasp' by 'Grasp'"},
      {four, R"(<SubTree ID="Lift" tepic="a" height="1"/>)", "Replace 'tepic' by 'topic'"},
      {four, R"(<SubTree ID="Lift" hieght="1"/>)", "Replace 'hieght' by 'height'"},
      {three, R"(<SequenceStr><Fly/></SequenceStr>)", "Replace 'SequenceStr' by 'SequenceStar'"},
      {three, R"(<RetryUntilSuccesful num_attempts="few"><Fly/></RetryUntilSuccesful>)",
       "Write num_attempts=\"1\""},
  };
  for (const auto& [root, node, title] : mistakes) {
    directory.file(
        "tree.xml",
        "<root main_tree_to_execute=\"Main\" " + root + "><BehaviorTree ID=\"Main\">" + node +
            R"(</BehaviorTree><BehaviorTree ID="Lift"><Fly to="{topic}" at="{height}"/></BehaviorTree>
<TreeNodesModel><Action ID="Goto"><input_port name="target" type="int"/>
<input_port name="GotoPlace"/></Action>
<SubTree ID="Lift"><input_port name="topic" default="all"/><input_port name="height"/></SubTree>
</TreeNodesModel></root>)");
    const Outcome outcome = run_lockstep({"check", "--format", "json", directory.path("")});
    INFO(node << outcome.out << outcome.err);
    std::vector<std::string> titles;
    for (const auto& message : parse_json(outcome.out))
      for (const auto& edit : message["edits"]) titles.push_back(edit["title"]);
    REQUIRE_FALSE(titles.empty());
    CHECK(std::ranges::find(titles, title) != titles.end());
  }
}

TEST_CASE("check --checkpoint lists what leaves do after a cut") {
  const TemporaryDirectory directory;
  const auto check = [&](const std::string& nodes, const std::string& option = "--checkpoint") {
    const std::string tree =
        directory.file("tree.xml",
                       "<root lockstep=\"1\"><plugin name=\"cut\"/><BehaviorTree "
                       "ID=\"Main\"><Sequence memory=\"true\">" +
                           nodes + "</Sequence></BehaviorTree></root>");
    return run_lockstep({"check", "--plugin-path", LOCKSTEP_BINARY_DIR "/tests/cli", "--plugin",
                         LOCKSTEP_BINARY_DIR "/plugins/nav_control.so", option, tree});
  };
  const Outcome outcome = check(
      "<Wait seconds=\"1\"/><Move who=\"a\"/><Step name=\"again\"/>"
      "<Step name=\"fill\" on_resume=\"failure\" commit=\"true\"/>"
      "<Step name=\"look\" on_resume=\"success\"/><Move name=\"b\" on_resume=\"failure\"/>");
  CHECK(outcome.code == 0);
  CHECK(outcome.out == directory.path("tree.xml") + R"(: ok
  after a cut, built-in nodes continue, and of others:
  Main/Sequence/Move   Move  continues, if it can
  Main/Sequence/again  Step  starts again
  Main/Sequence/fill   Step  counts as failed; its success counts when it is on the disk
  Main/Sequence/look   Step  counts as succeeded
  Main/Sequence/b      Move  continues, if it can
)");
  const Outcome below =
      check("<RoundRobin><Move name=\"a\"/><Wait seconds=\"1\"/></RoundRobin>", "--checkpoint");
  CHECK(contains(below.out, "Main/Sequence/RoundRobin    RoundRobin  starts again\n"));
  CHECK(contains(below.out, "RoundRobin/a  Move        starts again with the node above it\n"));
  CHECK(contains(check("<Wait seconds=\"1\"/>").out, "ok\n  all of it continues after a cut\n"));
  CHECK_FALSE(contains(check("<Step/>", "--strict").out, "cut"));
  CHECK(check("<Stop/>").out.empty());
  CHECK(run_lockstep({"check", "--checkpoint", "--format", "json", "x.xml"}).code == 2);
}

TEST_CASE("check --fix mends what can be meant in one way only, and names each mend") {
  const TemporaryDirectory directory;
  const std::string text =
      tree_text("<Sequnce memroy=\"true\"><Wait secnds=\"1\"/><Wait/></Sequnce>");
  const std::string tree = directory.file("tree.xml", text);
  const Outcome outcome = run_lockstep({"check", "--fix", tree});
  CHECK(outcome.code == 3);
  CHECK(read_file(tree) ==
        tree_text("<Sequence memory=\"true\"><Wait seconds=\"1\"/><Wait/></Sequence>"));
  for (const char* what :
       {"Replace 'Sequnce' by 'Sequence' [unknown-node]",
        "Replace 'memroy' by 'memory' [unknown-port]",
        "Replace 'secnds' by 'seconds' [unknown-port]", "'Wait' needs the parameter 'seconds'"}) {
    INFO(what);
    CHECK(contains(outcome.err, what));
  }
  // What is left needs a decision; a second call changes nothing.
  const std::string mended = read_file(tree);
  const Outcome again = run_lockstep({"check", "--fix", "--format", "json", tree});
  CHECK(again.code == 3);
  CHECK(again.err.empty());
  CHECK(parse_json(again.out).size() == 1);
  CHECK(read_file(tree) == mended);
  CHECK(run_lockstep({"check", "--fix", "-"}).code == 2);
}

TEST_CASE("check --fix does not choose between words that are as near") {
  const TemporaryDirectory directory;
  const std::string text =
      "<root lockstep=\"1\" main_tree_to_execute=\"Main\"><BehaviorTree ID=\"Main\"><SubTree "
      "ID=\"Carx\"/>"
      "</BehaviorTree><BehaviorTree ID=\"Cart\"><Wait seconds=\"1\"/></BehaviorTree>"
      "<BehaviorTree ID=\"Cars\"><Wait seconds=\"1\"/></BehaviorTree></root>";
  const std::string tree = directory.file("tree.xml", text);
  const Outcome outcome = run_lockstep({"check", "--fix", tree});
  CHECK(outcome.code == 3);
  CHECK(contains(outcome.err, "did you mean 'Cart' or 'Cars'?"));
  CHECK(read_file(tree) == text);
}

namespace {

// In lines of their own.
std::string doubtful(const std::string& nodes) {
  return tree_text("<Sequence memory=\"true\">\n" + nodes + "</Sequence>");
}

}  // namespace

TEST_CASE("check takes the files of a project, each as it is") {
  const TemporaryDirectory directory;
  const auto theirs = [&](const std::string& name, const std::string& content) {
    return directory.file(name, "<root BTCPP_format=\"4\">" + content + "</root>");
  };
  const std::string open = "<BehaviorTree ID=\"Open\"><AlwaysSuccess/></BehaviorTree>";
  const std::string library =
      theirs("library.xml", open + "<BehaviorTree ID=\"Close\"><AlwaysSuccess/></BehaviorTree>");
  const std::string palette =
      theirs("palette.xml", "<TreeNodesModel><Action ID=\"Grip\"/></TreeNodesModel>");
  const std::string project =
      theirs("all.btproj", "<include path=\"library.xml\"/><include path=\"palette.xml\"/>");
  const std::string user =
      theirs("user.xml", "<BehaviorTree ID=\"Main\"><SubTree ID=\"Open\" x=\"1\"/></BehaviorTree>");
  for (const std::string& file : {library, palette, project}) {
    const Outcome outcome = run_lockstep({"check", "--strict", file});
    INFO(outcome.err);
    CHECK(outcome.code == 0);
    CHECK(outcome.out == file + ": ok\n");
  }
  const Outcome alone = run_lockstep({"check", user});
  CHECK(alone.code == 0);
  CHECK(contains(alone.err, "warning: unknown tree 'Open'"));
  const Outcome strict = run_lockstep({"check", "--strict", user});
  CHECK(strict.code == 3);
  CHECK(contains(strict.err, "error: unknown tree 'Open'"));
  const Outcome all = run_lockstep({"check", "--strict", user, library});
  CHECK(all.code == 0);
  CHECK(contains(all.err, "note: the tree 'Open' is in another file"));
  // A tree that another file uses gets its entries from there.
  const std::string part = theirs(
      "part.xml", "<BehaviorTree ID=\"Shut\"><ScriptCondition code=\"x > 1\"/></BehaviorTree>");
  const std::string uses =
      theirs("uses.xml", "<BehaviorTree ID=\"Main\"><SubTree ID=\"Shut\" x=\"1\"/></BehaviorTree>");
  CHECK(run_lockstep({"check", "--strict", part}).code == 3);
  CHECK(run_lockstep({"check", "--strict", part, uses}).code == 0);
}

TEST_CASE("check takes a part with a file that includes it, which has what it uses") {
  const TemporaryDirectory directory;
  const std::string part = directory.file(
      "part.xml",
      "<root lockstep=\"1\"><BehaviorTree ID=\"Part\"><Sequence memory=\"true\">"
      "<Check code=\"far > 2\"/><Advance step=\"${step}\"/><SyncProgress barrier=\"meet\"><SubTree "
      "ID=\"Other\"/></SyncProgress>"
      "</Sequence></BehaviorTree></root>");
  const std::string main = directory.file(
      "main.xml",
      "<root lockstep=\"1\" main_tree_to_execute=\"Main\"><include path=\"part.xml\"/>"
      "<plugin name=\"motion\"/><arg name=\"step\" default=\"0.5\"/>"
      "<barrier name=\"meet\" barriers=\"0.5\"/><BehaviorTree ID=\"Main\"><Parallel>"
      "<SubTree ID=\"Part\" far=\"3\"/><SyncProgress barrier=\"meet\"><Wait seconds=\"1\"/>"
      "</SyncProgress></Parallel></BehaviorTree><BehaviorTree ID=\"Other\"><Wait seconds=\"1\"/>"
      "</BehaviorTree></root>");
  CHECK(run_lockstep({"check", part}).code == 3);
  const Outcome both = run_lockstep({"check", part, main});
  INFO(both.err);
  CHECK(both.code == 0);
  CHECK(both.out == part + ": checked with " + main + ", which includes it\n" + main + ": ok\n");
  CHECK(run_lockstep({"check", directory.path("")}).code == 0);
  // Only one of two has it all: the message is at the part, and a line names the other.
  const std::string lacking = directory.file(
      "lacking.xml",
      "<root lockstep=\"1\" main_tree_to_execute=\"Main\"><include path=\"part.xml\"/>"
      "<BehaviorTree ID=\"Main\"><SubTree ID=\"Part\"/></BehaviorTree></root>");
  const Outcome one = run_lockstep({"check", part, main, lacking});
  CHECK(one.code == 3);
  CHECK(contains(one.err, "unknown node 'Advance'"));
  CHECK(contains(one.err, lacking + ": a file that it uses has the errors above\n"));
  CHECK(!contains(one.err, main + ": a file"));
  std::filesystem::remove(lacking);
  // One with a mistake, and one that is a mission itself.
  directory.file("part.xml",
                 "<root lockstep=\"1\"><BehaviorTree ID=\"Part\"><Advance steps=\"1\"/>"
                 "</BehaviorTree></root>");
  const Outcome wrong = run_lockstep({"check", part, main});
  CHECK(wrong.code == 3);
  CHECK(contains(wrong.err, "part.xml:1:"));
  directory.file("part.xml",
                 "<root lockstep=\"1\" main_tree_to_execute=\"Part\"><BehaviorTree ID=\"Part\">"
                 "<Advance step=\"0.5\"/></BehaviorTree></root>");
  CHECK(contains(run_lockstep({"check", part, main}).err, "unknown node 'Advance'"));
}

TEST_CASE("check warns of a branch that can never run") {
  const TemporaryDirectory directory;
  const std::string dead =
      directory.file("dead.xml", doubtful("<Fallback><AlwaysSuccess/>\n<Advance name=\"late\"/>"
                                          "</Fallback>"));
  const Outcome outcome = run_lockstep({"check", dead});
  CHECK(outcome.code == 0);
  CHECK(
      contains(outcome.err, "dead.xml:3:1: warning: 'late' can never run, whatever the leaves do"));
  CHECK(contains(outcome.err, "hint: 'AlwaysSuccess' before it never fails"));
  CHECK(run_lockstep({"check", "--strict", dead}).code == 3);
}

TEST_CASE("check advises a condition in front of an action whose failure others mend") {
  const TemporaryDirectory directory;
  const auto hint = [&](const std::string& node) {
    return run_lockstep({"check", "--mock",
                         directory.file("t.xml",
                                        "<root BTCPP_format=\"4\">"
                                        "<BehaviorTree ID=\"M\"><" +
                                            node +
                                            "><Action ID=\"A\"/><Action ID=\"B\"/>"
                                            "</" +
                                            node + "></BehaviorTree></root>")})
        .err;
  };
  CHECK(contains(hint("ReactiveFallback"), "put a condition before the action"));
  CHECK(contains(hint("ReactiveSequence"), "put the action before this node"));
}

TEST_CASE("check --strict takes warnings for errors, and notes not") {
  const TemporaryDirectory directory;
  const std::string fine = directory.file("fine.xml", tree_text("<Advance/>"));
  const std::string warned = directory.file("warned.xml", doubtful("<Advance step=\"{x}\"/>"));
  CHECK(run_lockstep({"check", "--strict", fine}).code == 0);
  CHECK(run_lockstep({"check", warned}).code == 0);
  const Outcome outcome = run_lockstep({"check", "--strict", warned, fine});
  CHECK(outcome.code == 3);
  CHECK(outcome.out == fine + ": ok\n");
  CHECK(contains(outcome.err, "warning: nothing writes '{x}'"));
  CHECK(contains(outcome.err, warned + ": 1 warning, an error with --strict\n"));
  const Outcome json = run_lockstep({"check", "--strict", "--format", "json", warned});
  CHECK(json.code == 3);
  CHECK(parse_json(json.out)[0]["severity"] == "warning");
}

TEST_CASE("check --format github is a workflow command for each message") {
  const TemporaryDirectory directory;
  const std::string name = directory.file(
      "a,b:c%.xml",
      doubtful("<Advance step=\"{x}\"/>\n<Advnce/>\n<Wait seconds=\"5%&#10;::error::6\"/>"));
  const Outcome outcome = run_lockstep({"check", "--format", "github", name});
  CHECK(outcome.code == 3);
  CHECK(outcome.err.empty());
  const auto told = lines(outcome.out);
  REQUIRE(told.size() == 2);
  const auto slash = name.rfind('/');
  const std::string file = name.substr(0, slash) + "/a%2Cb%3Ac%25.xml";
  CHECK(told[0] == "::error file=" + file +
                       ",line=3,col=1,title=lockstep unknown-node::unknown node "
                       "'Advnce'%0Ahint: did you mean 'Advance'?");
  CHECK(told[1].starts_with("::error file=" + file +
                            ",line=4,col=16,title=lockstep bad-value::'5%25"));
  CHECK(contains(told[1], "'5%25\\x0A::error::6' is not a number"));
  const Outcome fine = run_lockstep(
      {"check", "--format", "github", directory.file("fine.xml", tree_text("<Advance/>"))});
  CHECK(fine.code == 0);
  CHECK(fine.out.empty());
}

TEST_CASE("a directory for plugins that is not there is warned of") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file("t.xml", tree_text("<Advance/>"));
  const std::string lost = directory.path("lost"), found = directory.path(".");
  const std::vector<std::string> commands[] = {{"check", tree}, {"nodes", "Sequence"}};
  for (std::vector<std::string> arguments : commands) {
    for (const std::string& path : {lost, found}) {
      arguments.insert(arguments.end(), {"--plugin-path", path});
    }
    const Outcome outcome = run_lockstep(arguments);
    INFO(outcome.err);
    CHECK(outcome.code == 0);
    CHECK(contains(outcome.err, "warning: --plugin-path " + lost +
                                    ": there is no such directory [missing-directory]\n"));
    CHECK(lines(outcome.err).size() == 1);
  }
}

TEST_CASE("check tells usage, trees and plugins apart") {
  const TemporaryDirectory directory;
  const std::string good = directory.file("good.xml", tree_text("<Advance step=\"{x}\"/>"));
  const std::string lost =
      directory.file("lost.xml",
                     "<root lockstep=\"1\"><plugin name=\"lost\"/><BehaviorTree "
                     "ID=\"A\"><X/></BehaviorTree></root>");
  struct Row {
    int code;
    std::vector<std::string> arguments;
    std::string message;
  };
  const Row rows[] = {
      {2, {}, "tree is required"},
      {2, {good, "--format", "xml"}, "--format"},
      {2, {good, "--arg", "x"}, "expected name=value"},
      {2, {good, "--arg", "x=1"}, "unknown argument 'x'"},
      {2, {good, "--set", "y=1"}, "the main tree does not use '{y}'"},
      {2, {good, "--tree", "Mian"}, "did you mean 'Main'?"},
      {3, {good, "--set", "x=fast"}, "is not a number"},
      {3, {directory.path("none.xml")}, "No such file or directory"},
      {4, {lost}, "plugin 'lost' is not found"},
      {4, {good, "--plugin", LOCKSTEP_BINARY_DIR "/tests/abi/plugins/wrong_abi.so"}, "ABI"},
      {4, {good, "--plugin", good}, "good.xml"}};
  for (const Row& row : rows) {
    std::vector<std::string> arguments{"check"};
    arguments.insert(arguments.end(), row.arguments.begin(), row.arguments.end());
    const Outcome outcome = run_lockstep(arguments);
    INFO(outcome.err);
    CHECK(outcome.code == row.code);
    CHECK(contains(outcome.err, row.message));
  }
}

TEST_CASE("the program itself") {
  CHECK(run_lockstep({"--version"}).out.rfind("lockstep ", 0) == 0);
  const Outcome help = run_lockstep({"--help"});
  CHECK(help.code == 0);
  CHECK(help.err.empty());
  for (const std::string command : {"run", "check", "show", "nodes", "schema", "log"}) {
    CHECK(contains(help.out, "  " + command + " "));
    const Outcome its = run_lockstep({command, "--help"});
    CHECK(its.code == 0);
    CHECK(contains(its.out, "Example"));
    CHECK(run_lockstep({command, "--no-such-option"}).code == 2);
  }
  CHECK(run_lockstep({}).code == 2);
  const Outcome unknown = run_lockstep({"chekc"});
  CHECK(unknown.code == 2);
  CHECK(contains(unknown.err, "unknown command 'chekc'"));
  CHECK(contains(unknown.err, "did you mean 'check'?"));
}

TEST_CASE("a full disk is said, never a crash") {
  const TemporaryDirectory directory;
  const std::string bad = directory.file("bad.xml", tree_text("<Sequence>" + [] {
                                           std::string nodes;
                                           for (int i = 0; i < 100; ++i) nodes += "<Unknown/>";
                                           return nodes;
                                         }() + "</Sequence>"));
  const Outcome outcome = run({.arguments = {"-c", "\"$0\" check --format json \"$1\" > /dev/full",
                                             LOCKSTEP_BINARY_DIR "/lockstep", bad},
                               .program = "/bin/sh"});
  CHECK(outcome.code == 2);
  CHECK(contains(outcome.err, "No space left on device"));
}
