// Nodes written for BehaviorTree.CPP, compiled unchanged: what they print with lockstep is what
// they print with that library (the .txt beside each).
#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>

#include "support/program.h"

using namespace lockstep::host::test;

namespace {

constexpr const char* kSources = LOCKSTEP_SOURCE_DIR "/tests/btcpp/leaves/";

std::string plugin(const std::string& name) {
  return LOCKSTEP_BTCPP_PLUGINS "/" + name + ".so";
}

Outcome run_tree(const std::string& tree, const std::string& leaves,
                 std::vector<std::string> more = {}) {
  std::vector<std::string> arguments{"run",     tree,      "--plugin", plugin(leaves),
                                     "--clock", "virtual", "--view",   "none"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_lockstep(arguments);
}

// What leaves print goes to stderr; the result is the first word on stdout.
std::vector<std::string> printed(const Outcome& outcome) {
  auto all = lines(outcome.err);
#if defined(__SANITIZE_ADDRESS__)
  std::erase_if(all, [](const std::string& line) {  // what it says of a coroutine
    return contains(line, "ASan doesn't fully support makecontext/swapcontext");
  });
#endif
  all.push_back(outcome.out.substr(0, outcome.out.find(' ')));
  return all;
}

std::string tree_of(const std::string& node) {
  return "<root BTCPP_format=\"4\"><BehaviorTree ID=\"Main\">" + node + "</BehaviorTree></root>";
}

}  // namespace

TEST_CASE(
    "leaves for BehaviorTree.CPP: they print with lockstep what they print with the library") {
  int seen = 0;
  for (const auto& file : std::filesystem::directory_iterator(kSources)) {
    if (file.path().extension() != ".txt") continue;
    ++seen;
    const std::string name = file.path().stem();
    INFO(name);
    CHECK(printed(run_tree(kSources + name + ".xml", name)) == lines(read_file(file.path())));
  }
  CHECK(seen >= 8);
}

TEST_CASE("leaves for BehaviorTree.CPP: an error in a literal in JSON is what the converter says") {
  const TemporaryDirectory directory;
  const auto error = [&](const std::string& order) {
    const std::string node = "<Deliver order='json:" + order + "'/>";
    const Outcome outcome = run_tree(directory.file("t.xml", tree_of(node)), "words");
    CHECK(outcome.code == 3);
    CHECK(!contains(outcome.err, "convertFromString"));
    return outcome.err;
  };
  CHECK(contains(error(R"({"name":"cup"})"), "key 'count' not found"));
  CHECK(contains(error(R"({"name":"cup","count":"two"})"), "type must be number"));
  CHECK(contains(error(R"({"name":"cup")"), "parse error"));
}

TEST_CASE("programs for BehaviorTree.CPP: they print what they print with the library") {
  int seen = 0;
  for (const auto& file :
       std::filesystem::directory_iterator(LOCKSTEP_SOURCE_DIR "/tests/btcpp/programs")) {
    if (file.path().extension() != ".txt") continue;
    ++seen;
    const std::string name = file.path().stem();
    INFO(name);
    const Outcome outcome =
        run({.arguments = {}, .program = LOCKSTEP_BTCPP_PLUGINS "/program_" + name});
    CHECK(outcome.code == 0);
    CHECK(lines(outcome.out) == lines(read_file(file.path())));
  }
  CHECK(seen >= 1);
}

TEST_CASE("leaves for BehaviorTree.CPP: another thread of one ends the wait for the next period") {
  const TemporaryDirectory directory;
  const auto tree = directory.file("tree.xml", tree_of("<Sequence><Reply/><Work/></Sequence>"));
  const Outcome outcome = run_lockstep({"run", tree, "--plugin", plugin("wakes"), "--clock", "wall",
                                        "--view", "none", "--rate", "0.01", "--timeout", "60"});
  INFO(outcome.err);
  CHECK(outcome.code == 0);
}

TEST_CASE("leaves for BehaviorTree.CPP: they print the same from a separate process") {
  for (const std::string name : {"asked", "halts", "register", "waiting"}) {
    INFO(name);
    CHECK(printed(run_tree(kSources + name + ".xml", name, {"--isolate"})) ==
          lines(read_file(kSources + name + ".txt")));
  }
  // Those that carry objects without bytes stay here.
  const Outcome parts = run_tree(std::string(kSources) + "first.xml", "first", {"--isolate"});
  CHECK(contains(parts.err, "first.so' is isolated only in part: "));
  CHECK(contains(parts.err, "' has no to_bytes and from_bytes"));
  const auto isolated = [](const std::string& name) {
    return run_tree(std::string(kSources) + name + ".xml", name, {"--isolate"});
  };
  // What does not work from there is told, not ignored.
  CHECK(contains(isolated("entries").err, "' uses entries by their names"));
  CHECK(contains(isolated("words").err, "nothing makes the entry 'Red'"));
}

TEST_CASE("leaves for BehaviorTree.CPP: what a node does wrong is its fault") {
  struct Case {
    std::string how, message;
  };
  const Case kCases[] = {
      {"throws in its constructor", "could not be created: no device"},
      {"throws", "it is broken"},
      {"throws 42", "an exception that is not a std::exception"},
      {"runs", "node 'Wrong' is a SyncActionNode and has returned RUNNING"},
      {"is idle", "node 'Wrong' has returned IDLE, which is no result of a tick"},
      {"reads nothing", "port 'number' has no value and no default"},
      {"reads no port", "'Wrong' has no port 'speed': list it in its providedPorts()"},
      {"writes an input", "port 'number' is an input"},
  };
  const TemporaryDirectory directory;
  for (const Case& it : kCases) {
    const auto tree = directory.file("tree.xml", tree_of("<Wrong how=\"" + it.how + "\"/>"));
    const Outcome outcome = run_tree(tree, "faulty");
    INFO(it.how);
    CHECK(outcome.code == 5);
    CHECK(contains(outcome.out, " s: Main/Wrong: " + it.message));
    CHECK(run_tree(tree, "faulty", {"--isolate"}).out == outcome.out);
  }
  const auto tree = directory.file("tree.xml", tree_of("<Wrong how=\"throws\"/>"));
  CHECK(run_tree(tree, "faulty", {"--on-fault", "fail"}).code == 1);
}

TEST_CASE("leaves for BehaviorTree.CPP: NaN is a value, also from a separate process") {
  const TemporaryDirectory directory;
  const auto tree = directory.file(
      "tree.xml",
      tree_of(R"(<Sequence><Lost value="{v}"/><Lost seen="{v}" value="{v}"/></Sequence>)"));
  const auto whole = directory.file(
      "whole.xml", tree_of(R"(<Sequence><Script code="v := 1"/><Lost value="{v}"/></Sequence>)"));
  const std::string recording = directory.path("run.jsonl");
  std::vector<std::string> more{"--record", recording};
  for (int i = 0; i < 2; ++i) {
    CHECK(printed(run_tree(tree, "faulty", more)) == std::vector<std::string>{"nan", "success"});
    CHECK(contains(read_file(recording), R"("entries":[[0,"nan"]])"));
    const Outcome refused = run_tree(whole, "faulty", more);
    INFO(refused.err);
    CHECK(contains(refused.out, "cannot set 'value': the entry '{v}' has whole numbers only"));
    more.emplace_back("--isolate");
  }
}

TEST_CASE("leaves for BehaviorTree.CPP: progress, onPaused and onResumed keep a barrier") {
  const TemporaryDirectory directory;
  const auto tree = directory.file(
      "tree.xml", tree_of("<ParallelAbsolute barriers=\"0.5\"><Reach name=\"fast\" step=\"0.25\"/>"
                          "<Reach name=\"slow\" step=\"0.125\"/></ParallelAbsolute>"));
  CHECK(printed(run_tree(tree, "faulty")) ==
        std::vector<std::string>{"fast holds at 0.5", "fast goes on", "success"});
}

TEST_CASE("leaves for BehaviorTree.CPP: reason() is why a node fails") {
  const TemporaryDirectory directory;
  const auto tree = directory.file("tree.xml", tree_of("<Blind/>"));
  const Outcome outcome = run_tree(tree, "faulty");
  CHECK(contains(outcome.out, "    Blind: failure: the lens is covered\n"));
  CHECK(run_tree(tree, "faulty", {"--isolate"}).out == outcome.out);
}

TEST_CASE("leaves for BehaviorTree.CPP: IDs of lockstep's own nodes, '-' and UTF-8") {
  const TemporaryDirectory directory;
  const auto theirs = directory.file(
      "theirs.xml",
      tree_of("<Sequence><Wait wait-time=\"5\"/><Wärmen-bis wait-time=\"7\"/></Sequence>"));
  CHECK(printed(run_tree(theirs, "faulty")) ==
        std::vector<std::string>{"Wait 5", "Wärmen-bis 7", "success"});
  // In lockstep's own language, Wait is lockstep's.
  const auto ours = directory.file("ours.xml",
                                   "<root lockstep=\"1\"><BehaviorTree ID=\"Main\">"
                                   "<Wait seconds=\"0.1\"/></BehaviorTree></root>");
  CHECK(run_tree(ours, "faulty").out.substr(0, 23) == "success after 11 ticks,");
}

TEST_CASE("leaves for BehaviorTree.CPP: a plugin that registers an ID twice is refused") {
  const Outcome outcome = run_lockstep({"nodes", "--plugin", plugin("twice")});
  CHECK(outcome.code != 0);
  CHECK(contains(outcome.err, "cannot be used: ID [Same] is registered already"));
}

TEST_CASE("leaves for BehaviorTree.CPP: a literal that its type does not read is found by check") {
  const TemporaryDirectory directory;
  const auto tree = directory.file("tree.xml", tree_of("<Move goal=\"here\"/>"));
  const Outcome outcome = run_lockstep({"check", tree, "--plugin", plugin("first")});
  CHECK(outcome.code == 3);
  CHECK(contains(outcome.err, "error: 'here' is not the text of a Position, which 'goal' must be"));
}

TEST_CASE("leaves for BehaviorTree.CPP: a type without a conversion says so, by its name") {
  const TemporaryDirectory directory;
  const std::string type = "std::map<std::string, std::vector<Position>>";
  const std::string lacks =
      "there is no conversion from a text to " + type + "; specialize BT::convertFromString for it";
  const auto literal = directory.file("literal.xml", tree_of("<Look places=\"a\"/>"));
  const Outcome check = run_lockstep({"check", literal, "--plugin", plugin("first")});
  CHECK(
      contains(check.err, "error: 'a' is not the text of a " + type + ", which 'places' must be"));
  CHECK(contains(check.err, "hint: its plugin reports: " + lacks));
  const auto start = directory.file("start.xml", tree_of("<Look places=\"{p}\"/>"));
  CHECK(contains(run_tree(start, "first", {"--set", "p=1"}).err, "its plugin reports: " + lacks));
  const auto text = directory.file(
      "text.xml", tree_of("<Sequence><Think text=\"{p}\"/><Look places=\"{p}\"/></Sequence>"));
  CHECK(contains(run_tree(text, "first").out, "Main/Sequence/Look: " + lacks));
  // One that refuses a text says why.
  const auto wrong = directory.file("wrong.xml", tree_of("<Move goal=\"1\"/>"));
  CHECK(contains(run_lockstep({"check", wrong, "--plugin", plugin("first")}).err,
                 "hint: its plugin reports: a position is two numbers"));
}

TEST_CASE(
    "leaves for BehaviorTree.CPP: a port of an own type reads a text, wherever it comes from") {
  const TemporaryDirectory directory;
  const std::string in_subtree =
      "<root BTCPP_format=\"4\" main_tree_to_execute=\"Main\"><BehaviorTree ID=\"Main\">"
      "<SubTree ID=\"Go\" goal=\"1;2\"/></BehaviorTree><BehaviorTree ID=\"Go\">"
      "<Move goal=\"{goal}\"/></BehaviorTree></root>";
  const std::string text = "<SetBlackboard value=\"1;2\" output_key=\"goal\"/>";
  const std::string move = "<Move goal=\"{goal}\"/>";
  const std::string kTrees[] = {
      in_subtree, tree_of("<Sequence>" + text + move + "</Sequence>"),
      tree_of("<Sequence><Script code=\"goal := '1;2'\"/>" + move + "</Sequence>"),
      // The first port makes it a text.
      tree_of("<Sequence><Think text=\"{goal}\"/>" + text + move + "</Sequence>")};
  for (const std::string& it : kTrees) {
    INFO(it);
    const auto tree = directory.file("tree.xml", it);
    CHECK(run_lockstep({"check", tree, "--plugin", plugin("first")}).code == 0);
    CHECK(printed(run_tree(tree, "first")) == std::vector<std::string>{"move to 1 2", "success"});
  }
  const auto set = directory.file("set.xml", tree_of(move));
  CHECK(printed(run_tree(set, "first", {"--set", "goal=3;4"})) ==
        std::vector<std::string>{"move to 3 4", "success"});
  const auto no_position = run_tree(set, "first", {"--set", "goal=here"});
  CHECK(no_position.code == 1);
  CHECK(contains(no_position.out, "failure"));
}

TEST_CASE(
    "leaves for BehaviorTree.CPP: entries by name are not in trees of lockstep's own language") {
  const TemporaryDirectory directory;
  const auto tree = directory.file(
      "tree.xml", "<root lockstep=\"1\"><BehaviorTree ID=\"Main\"><Put/></BehaviorTree></root>");
  const Outcome outcome = run_tree(tree, "entries");
  CHECK(outcome.code == 5);
  CHECK(contains(outcome.out, "Main/Put: entries cannot be used by their names here"));
}
