// Actions of programs: on the wall clock, a tick does not wait for an answer, so that it counts in
// the next one. What is proved of them holds on both clocks.
#include <catch2/catch.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "support/program.h"

namespace lockstep::host::test {
namespace {

constexpr const char* kList =
    R"({"lockstep":1,"leaves":[{"id":"Move","kind":"action","ports":[],"progress":true},)"
    R"({"id":"Pub","kind":"action","ports":[{"name":"width","type":"int","direction":"output"}]}]})";

// Of a header, from the first node on.
constexpr const char* kMove = R"({"index":0,"path":"T/a","kind":"Move","name":"a","parent":null}])";
constexpr const char* kPubAndCheck =
    R"({"index":0,"path":"T/Sequence","kind":"Sequence","name":"Sequence","parent":null},)"
    R"({"index":1,"path":"T/Sequence/a","kind":"Pub","name":"a","parent":0,"ports":{"width":"{w}"}},)"
    R"({"index":2,"path":"T/Sequence/c","kind":"Check","name":"c","parent":0,"reads":["w"]}],)"
    R"("entries":[{"key":"w","type":"int","writers":[1]}])";
constexpr const char* kEnd = R"({"end":{"result":"success","reason":"completed","ticks":4,)"
                             R"("time_s":4e-1,"overruns":0,"skipped":0}})"
                             "\n";

// The program is never started: its list is enough.
struct Programs {
  TemporaryDirectory directory;
  std::string program = directory.file("arm.py", "#!/usr/bin/python3\n");
  std::string list = directory.file("arm.leaves.json", kList);
  Programs() { std::filesystem::permissions(program, std::filesystem::perms::owner_all); }

  std::string tree(const std::string& nodes) {
    return directory.file("t.xml",
                          "<root lockstep=\"1\"><plugin name=\"arm\" program=\"arm.py\"/>"
                          "<plugin name=\"motion\"/><BehaviorTree ID=\"T\">" +
                              nodes + "</BehaviorTree></root>");
  }
  std::string model(const std::string& rows) {
    return directory.file("t.leaves.xml",
                          "<leaves lockstep=\"1\" rate=\"10\">" + rows + "</leaves>");
  }
  std::string verified(const std::string& nodes, const std::string& rows,
                       std::vector<std::string> more = {}) {
    const std::string file = tree(nodes);
    std::vector<std::string> words{"verify",   file,        "--plugin-path", directory.path(""),
                                   "--leaves", model(rows), "--out",         directory.path("o")};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = run_lockstep(words);
    return outcome.out + outcome.err;
  }
  // A recording of <Move name="a"/>, or of these nodes.
  std::string checked(const std::string& ticks, const std::string& rows,
                      const std::string& nodes = kMove) {
    const std::string recording = directory.file(
        "r.jsonl", R"({"lockstep_recording":1,"tree":"T","file":"t.xml","version":"1.0.0","law":3,)"
                   R"("rate_hz":10.0,"clock":"wall","seed":0,"arguments":{},"nodes":[)" +
                       nodes + "}\n" + ticks);
    const Outcome outcome =
        run_lockstep({"log", "check", recording, "--leaves", model(rows), "--tree-file",
                      directory.path("t.xml"), "--plugin-path", directory.path("")});
    return outcome.out + outcome.err;
  }
};

// As many ticks until the Success, with the progress before each of them.
std::string ticks_of(const std::vector<std::string>& progress) {
  std::string text;
  for (std::size_t tick = 0; tick < progress.size(); ++tick) {
    const bool is_last = tick + 1 == progress.size();
    text += "{\"tick\":" + std::to_string(tick) + ",\"time_s\":" + std::to_string(tick) +
            "e-1,\"nodes\":[[0,\"" + (is_last ? "success" : "running") + "\"," + progress[tick] +
            ",1,0]]}\n";
  }
  const std::string count = std::to_string(progress.size());
  return text + R"({"end":{"result":"success","reason":"completed","ticks":)" + count +
         R"(,"time_s":)" + count + R"(e-1,"overruns":0,"skipped":0}})" + "\n";
}

constexpr const char* kAllowed = "the leaves did what the leaf model allows";
constexpr const char* kSucceeds = "success (from 4 ticks)\n";
constexpr const char* kAssumed = "programs answer before the next tick";

}  // namespace

TEST_CASE("the ticks of a program's action are one more on the wall clock, for verify too") {
  Programs programs;
  const std::string four = R"(<leaf of="Move" result="success" ticks="4"/>)";
  const std::string two_moves =
      R"(<Sequence memory="true"><Move name="a"/><Move name="b"/></Sequence>)";
  const std::string said = programs.verified(two_moves, four);
  INFO(said);
  CHECK(contains(said, "success (from 7 ticks)"));
  CHECK(contains(said, kAssumed));
  CHECK(contains(said, "(2 actions)"));
  // The fourth tick is at 0.3 s, the fifth at 0.4 s.
  const auto within = [&](const std::string& seconds, const std::string& leaf,
                          const std::string& type) {
    return programs.verified("<Timeout seconds=\"" + seconds + "\">" + leaf + "</Timeout>",
                             "<leaf of=\"" + type + R"(" result="success" ticks="4"/>)");
  };
  CHECK(contains(within("0.45", "<Move/>", "Move"), kSucceeds));
  CHECK(contains(within("0.35", "<Move/>", "Move"), ", failure (from"));
  const std::string of_cpp = within("0.35", "<Advance step=\"0.1\"/>", "Advance");
  CHECK(contains(of_cpp, kSucceeds));
  CHECK_FALSE(contains(of_cpp, kAssumed));
  // Where the model has no limit, nothing more is assumed.
  CHECK_FALSE(
      contains(programs.verified(two_moves, R"(<leaf of="Move" result="success"/>)"), kAssumed));
}

TEST_CASE("steps of a program's action: its last one may be there before its Success") {
  Programs programs;
  const std::string steps =
      R"(<leaf of="Move" result="success" progress="grid:4" step="1..1" finish="full"/>)";
  const auto within = [&](const char* seconds) {
    return programs.verified("<Timeout seconds=\"" + std::string(seconds) + "\"><Move/></Timeout>",
                             steps);
  };
  INFO(within("0.45"));
  CHECK(contains(within("0.45"), kSucceeds));
  CHECK(contains(within("0.35"), ", failure (from"));
  std::ignore = programs.tree(R"(<Move name="a"/>)");
  CHECK(contains(programs.checked(ticks_of({"0", "0.25", "0.5", "0.75"}), steps), kAllowed));
  CHECK(contains(programs.checked(ticks_of({"0", "0.25", "0.5", "0.75", "1"}), steps), kAllowed));
  CHECK(
      contains(programs.checked(ticks_of({"0", "0.25", "0.5", "0.75", "0.75"}), steps), kAllowed));
  CHECK(contains(programs.checked(ticks_of({"0", "0.5", "0.75", "1"}), steps),
                 "moved from 0 to 0.5"));
}

TEST_CASE("log check allows a program's action one tick more, and no further one") {
  Programs programs;
  std::ignore = programs.tree(R"(<Move name="a"/>)");
  const std::string four = R"(<leaf of="Move" result="success" ticks="4"/>)";
  CHECK(contains(programs.checked(ticks_of({"0", "0", "0", "0"}), four), kAllowed));
  CHECK(contains(programs.checked(ticks_of({"0", "0", "0", "0", "0"}), four), kAllowed));
  CHECK(
      contains(programs.checked(ticks_of({"0", "0", "0", "0", "0", "0"}), four),
               "takes more than 5 ticks, the leaf model allows 4, and one more on the wall clock"));
  CHECK(contains(programs.checked(ticks_of({"0", "0", "0"}), four), "took 3 ticks"));
}

TEST_CASE("what a program's action writes at its start may come a tick later") {
  Programs programs;
  const std::string at_start =
      R"(<leaf of="Pub" result="success" ticks="3" out.width="7" writes="start"/>)";
  const auto checked = [&](int tick) {
    std::ignore = programs.tree(R"(<Sequence memory="true"><Pub name="a" width="{w}"/>
<Check name="c" code="w == 7"/></Sequence>)");
    std::string ticks;
    for (int i = 0; i < 4; ++i) {
      const std::string status = i == 3 ? "success" : "running";
      ticks += "{\"tick\":" + std::to_string(i) + ",\"time_s\":" + std::to_string(i) +
               "e-1,\"nodes\":[[0,\"" + status + "\",0,1,0],[1,\"" + status + "\",0,1,0]" +
               (i == 3 ? R"(,[2,"success",0,1,0])" : "") + "]" +
               (i == tick ? R"(,"entries":[[0,"7"]])" : "") + "}\n";
    }
    return programs.checked(ticks + kEnd, at_start, kPubAndCheck);
  };
  CHECK(contains(checked(1), kAllowed));
  CHECK(contains(checked(2), "wrote 'w' after its start"));
  const auto read_after = [&](const std::string& before) {
    return programs.verified(
        R"(<Sequence memory="true"><Script code="w := 0"/><Parallel><Pub name="a" width="{w}"/>
<Sequence memory="true">)" +
            before + R"(<Check name="c" code="w == 7"/></Sequence></Parallel></Sequence>)",
        at_start, {"--property", "early: never c.failure"});
  };
  CHECK(contains(read_after(""), "finding property/early"));
  const std::string later = read_after("<Wait seconds=\"0.1\"/>");
  INFO(later);
  CHECK(contains(later, "property 'early'"));
  CHECK_FALSE(contains(later, "finding property/early"));
}

}  // namespace lockstep::host::test
