// The recorder, the reader and the table made from a recording, against each other and as text.
#include <catch2/catch.hpp>
#include <limits>
#include <sstream>

#include "base/core/csv_field.h"
#include "base/core/version.h"
#include "record/json_lines.h"
#include "record/read/recording_reader.h"
#include "record/use/recording_csv.h"
#include "record/use/recording_info.h"
#include "record/write/recorder.h"
#include "run/shape_of.h"
#include "support/text.h"
#include "unit/recording/watched_run.h"

namespace lockstep::host {
namespace {

using test::replaced;
using test::TemporaryPath;
using test::WatchedRun;

constexpr const char* kTree = "ParallelAbsolute[barriers=.5;1](a b)";
constexpr const char* kLeaves = "a+.25 b+.5";

std::string record(std::string_view tree, std::string_view leaves, std::uint64_t max_ticks = 1000) {
  const TemporaryPath file;
  WatchedRun run(tree, leaves);
  Recorder recorder(shape_of(run.run.tree()), {.path = file.path(),
                                               .run = {.tree_file = "trees/a.xml",
                                                       .rate_hz = 10,
                                                       .seed = 18446744073709551615u,
                                                       .arguments = {{"barriers", "0.5;1"}}}});
  run.watch({&recorder}, max_ticks);
  CHECK(recorder.error() == "");
  return file.text();
}

constexpr const char* kWholeRecording =
    R"({"lockstep_recording":1,"tree":"Test","file":"trees/a.xml","version":"0.1.0",)"
    R"("law":3,"rate_hz":10.0,"clock":"virtual","seed":18446744073709551615,)"
    R"("arguments":{"barriers":"0.5;1"},"nodes":[)"
    R"({"index":0,"path":"Test/ParallelAbsolute","kind":"ParallelAbsolute",)"
    R"("name":"ParallelAbsolute","parent":null,"barriers":[0.5,1.0],)"
    R"("ports":{"barriers":"0.5;1","success_count":"2"}},)"
    R"({"index":1,"path":"Test/ParallelAbsolute/a","kind":"Scripted","name":"a","parent":0},)"
    R"({"index":2,"path":"Test/ParallelAbsolute/b","kind":"Scripted","name":"b","parent":0}]})"
    "\n"
    R"({"tick":0,"time_s":0.0,"nodes":[[0,"running",0,1,0],[1,"running",0,1,0],[2,"running",0,1,0]],"limits":[[0,0.5]]})"
    "\n"
    R"({"tick":1,"time_s":0.1,"nodes":[[0,"running",0.25,1,0],[1,"running",0.25,1,0],[2,"running",0.5,0,1]]})"
    "\n"
    R"({"tick":2,"time_s":0.2,"nodes":[[0,"running",0.5,1,0],[1,"running",0.5,1,0],[2,"success",0.5,1,0]],"limits":[[0,1]]})"
    "\n"
    R"({"tick":3,"time_s":0.3,"nodes":[[0,"success",0.75,1,0],[1,"success",0.75,1,0],[2,"success",1,0,0]]})"
    "\n"
    R"({"end":{"result":"success","reason":"completed","ticks":4,"time_s":0.3,"overruns":0,"skipped":0}})"
    "\n";

TEST_CASE("a recording, byte by byte") {
  CHECK(replaced(record(kTree, kLeaves), kVersion, "0.1.0") == kWholeRecording);
}

TEST_CASE("a tick in which nothing changes is a line without nodes") {
  const std::string text = record("Sequence(a)", "a=R", 3);
  CHECK(text.find("{\"tick\":2,\"time_s\":0.2,\"nodes\":[]}\n") != std::string::npos);
}

TEST_CASE("a node that has completed is in the line of the tick after it, then in none") {
  const std::string text = record("Parallel(a b)", "a=S b=R", 4);
  CHECK(text.find("\"time_s\":0.1,\"nodes\":[[1,\"success\",1,0,0]]}\n") != std::string::npos);
  CHECK(text.find("\"time_s\":0.2,\"nodes\":[]}\n") != std::string::npos);
  CHECK(text.find("\"time_s\":0.3,\"nodes\":[]}\n") != std::string::npos);
}

TEST_CASE("numbers are written with as many digits as are needed, and no more") {
  const auto text_of = [](double progress) {
    char room[128];  // for two
    const NodeChange node{.progress = progress,
                          .node = 4294967295,
                          .state = static_cast<std::uint8_t>(Activity::Success)};
    const NodeChange nodes[] = {node, node, node};
    const auto put = json_lines::put_nodes(room, nodes, true);
    CHECK(put.count == 2);
    const std::string text(room, put.end);
    CHECK(text.size() < sizeof room);
    const std::string one = text.substr(0, text.size() / 2);
    CHECK(text == one + "," + one);
    return one;
  };
  const auto expected = [](const std::string& progress) {
    return "[4294967295,\"success\"," + progress + ",0,0]";
  };
  CHECK(text_of(0) == expected("0"));
  CHECK(text_of(-0.0) == expected("-0"));
  CHECK(text_of(1) == expected("1"));
  CHECK(text_of(0.3) == expected("0.3"));
  CHECK(text_of(0.1 + 0.2) == expected("0.30000000000000004"));
  CHECK(text_of(0.00012345678901234567) == expected("0.00012345678901234567"));
  CHECK(text_of(1e-5) == expected("1e-05"));
  CHECK(text_of(2.2250738585072014e-308) == expected("2.2250738585072014e-308"));
}

std::string tick_end(std::span<const LimitChange> limits, std::span<const Fault> faults) {
  std::string text = "of the tick before";
  json_lines::set_tick_end(text, {.limits = limits, .faults = faults});
  return text;
}

TEST_CASE("of the message of a fault 4096 bytes are kept") {
  const std::string longest(4096, 'm');
  const std::vector<Fault> faults = {{3, longest}, {4, longest + 'x'}};
  CHECK(tick_end({}, faults) ==
        "],\"faults\":[[3,\"" + longest + "\"],[4,\"" + longest + "\"]]}\n");
  CHECK(tick_end({}, {}) == "]}\n");
}

TEST_CASE("the limit of a synchronized node is a number, or null when no barrier is left") {
  const LimitChange limits[] = {{1, 0.25}, {7, std::numeric_limits<double>::infinity()}};
  CHECK(tick_end(limits, {}) == "],\"limits\":[[1,0.25],[7,null]]}\n");
}

TEST_CASE("the closing line of a run with a fault names the leaf") {
  const std::string text = record("Sequence(a)", "a=RX");
  const std::string last = text.substr(text.rfind("{\"end\""));
  CHECK(last.find(R"("result":"fault","reason":"fault","fault":"Test/Sequence/a: )") !=
        std::string::npos);
}

std::string csv_of(const std::string& recording, std::string* error = nullptr,
                   std::string* cut = nullptr) {
  std::istringstream in(recording);
  RecordingReader reader(in, "run.jsonl");
  std::string rows;
  CHECK(write_csv(reader, [&rows](std::string_view more) {
    rows += more;
    return true;
  }));
  if (error != nullptr) *error = reader.error();
  if (cut != nullptr) *cut = reader.cut();
  return rows;
}

TEST_CASE("a recording as a table") {
  std::string error = "unset", cut = "unset";
  CHECK(csv_of(kWholeRecording, &error, &cut) ==
        "tick,time_s,node,path,status,progress,ticked,held,results\n"
        "0,0,0,Test/ParallelAbsolute,running,0,1,0,\n"
        "0,0,1,Test/ParallelAbsolute/a,running,0,1,0,\n"
        "0,0,2,Test/ParallelAbsolute/b,running,0,1,0,\n"
        "1,0.1,0,Test/ParallelAbsolute,running,0.25,1,0,\n"
        "1,0.1,1,Test/ParallelAbsolute/a,running,0.25,1,0,\n"
        "1,0.1,2,Test/ParallelAbsolute/b,running,0.5,0,1,\n"
        "2,0.2,0,Test/ParallelAbsolute,running,0.5,1,0,\n"
        "2,0.2,1,Test/ParallelAbsolute/a,running,0.5,1,0,\n"
        "2,0.2,2,Test/ParallelAbsolute/b,success,0.5,1,0,\n"
        "3,0.3,0,Test/ParallelAbsolute,success,0.75,1,0,\n"
        "3,0.3,1,Test/ParallelAbsolute/a,success,0.75,1,0,\n"
        "3,0.3,2,Test/ParallelAbsolute/b,success,1,0,0,\n");
  CHECK(error == "");
  CHECK(cut == "");
}

TEST_CASE("an idle node has a row only when it was ticked") {
  // a is ticked in tick 0; b fails in it, and a is halted.
  const std::string table = csv_of(record("Sequence[memory=true](Parallel(a b) c)", "a=R b=F c=S"));
  CHECK(table.find("0,0,2,Test/Sequence/Parallel/a,idle,0,1,0,\n") != std::string::npos);
  CHECK(table.find("/c,") == std::string::npos);
}

TEST_CASE("progress of a child is what its synchronized node used, not what was left before") {
  // Before tick 2 both are still successful; the node's new activation begins at 0.
  const std::string table =
      csv_of(record("Repeat[times=2](ParallelRelative[delta=1](a b))", "a+.5 b+.5"));
  CHECK(table.find("1,0.1,2,Test/Repeat/ParallelRelative/a,success,0.5,1,0,\n") !=
        std::string::npos);
  CHECK(table.find("2,0.2,2,Test/Repeat/ParallelRelative/a,running,0,1,0,\n") != std::string::npos);
}

TEST_CASE("what a synchronized node used is of its tick only") {
  // In tick 1 its second activation begins at 0 and ends; before tick 2 its children have
  // succeeded.
  const std::string table =
      csv_of(record("Sequence[memory=true](Repeat[times=2](ParallelRelative[delta=1](a b)) c)",
                    "a=SS b=SS c=R", 3));
  const std::string a = "Test/Sequence/Repeat/ParallelRelative/a,success,";
  CHECK(table.find("1,0.1,3," + a + "0,1,0,\n") != std::string::npos);
  CHECK(table.find("2,0.2,3," + a + "1,0,0,\n") != std::string::npos);
}

TEST_CASE("faults that the run went on after are in their tick, and counted") {
  const TemporaryPath file;
  {
    WatchedRun run("Sequence(a b)", "a=RRS b=S");
    run.faults[1] = {{1, "said \"no\"\n"}, {2, "broke \xff"}};
    Recorder recorder(shape_of(run.run.tree()),
                      {.path = file.path(), .run = {.tree_file = "a.xml"}});
    run.watch({&recorder});
  }
  const std::string text = file.text();
  CHECK(text.find(R"("time_s":0.1,"nodes":[],"faults":[[1,"said \"no\"\n"],[2,"broke )"
                  "\xef\xbf\xbd\"]]}\n") != std::string::npos);
  CHECK(text.find("faults", text.find("\"tick\":2")) == std::string::npos);
  std::istringstream in(text);
  RecordingReader reader(in, "run.jsonl");
  const std::string info = info_text(reader);
  CHECK(info.find("\n  2 faults of leaves after which the run continued\n") != std::string::npos);
  CHECK(csv_of(text).find("broke") == std::string::npos);
}

TEST_CASE("of the notes of a recording a thousand are kept") {
  const auto notes_of = [](std::size_t count) {
    std::string list = "\"n\"";
    for (std::size_t i = 1; i < count; ++i) list += ",\"n\"";
    std::string text = kWholeRecording;
    text.replace(text.rfind("}}"), 2, ",\"notes\":[" + list + "]}}");
    std::istringstream in(text);
    RecordingReader reader(in, "run.jsonl");
    while (reader.next()) {
    }
    REQUIRE(reader.error().empty());
    return reader.end()->notes;
  };
  CHECK(notes_of(1000) == std::vector<std::string>(1000, "n"));
  const auto notes = notes_of(1002);
  CHECK(notes.size() == 1001);
  CHECK(notes.back() == "and 2 notes more");
}

TEST_CASE("lost ticks have no rows, and info tells of them") {
  std::string text = kWholeRecording;
  const std::size_t begin = text.find("{\"tick\":1"), end = text.find("{\"tick\":3");
  text.replace(begin, end - begin, "{\"lost\":{\"ticks\":2,\"from\":1}}\n");
  text.replace(text.rfind("}}"), 2, ",\"lost\":2}}");
  const std::string table = csv_of(text);
  CHECK(table.find("\n1,") == std::string::npos);
  CHECK(table.find("\n2,") == std::string::npos);
  CHECK(table.find("\n3,0.3,2,Test/ParallelAbsolute/b,success,1,0,0,\n") != std::string::npos);
  std::istringstream in(text);
  RecordingReader reader(in, "run.jsonl");
  const std::string info = info_text(reader);
  CHECK(info.find("\n  2 ticks are missing, the first is 1: the disk was too slow\n") !=
        std::string::npos);
}

TEST_CASE("names with commas and quotes are quoted") {
  CHECK(csv_field("a/b") == "a/b");
  CHECK(csv_field("a,b") == "\"a,b\"");
  CHECK(csv_field("say \"x\"") == "\"say \"\"x\"\"\"");
  CHECK(csv_field("a\nb") == "\"a\nb\"");
}

TEST_CASE("a recording cut anywhere behind its header is read up to the last whole line") {
  const std::string whole = kWholeRecording;
  const std::size_t header = whole.find('\n') + 1;
  const std::string table = csv_of(whole);
  for (std::size_t size = header; size < whole.size() - 1; ++size) {
    std::string error, cut;
    const std::string part = csv_of(whole.substr(0, size), &error, &cut);
    REQUIRE(error == "");
    REQUIRE(cut != "");
    REQUIRE(table.starts_with(part));
  }
}

TEST_CASE("a cut recording says how it ends") {
  const std::string whole = kWholeRecording;
  std::string error, cut;
  csv_of(whole.substr(0, whole.find("{\"tick\":2") + 20), &error, &cut);
  CHECK(cut == "line 4 is cut, the run did not end there");
  csv_of(whole.substr(0, whole.find("{\"tick\":2")), &error, &cut);
  CHECK(cut == "it ends after line 3 without a closing line");
}

TEST_CASE("what is wrong with a recording is reported with its line") {
  const struct {
    std::string text, error;
  } cases[] = {
      {"", "run.jsonl:1: the file is empty, expected a recording"},
      {"{\"lockstep_recording\":1", "run.jsonl:1: the header is cut"},
      {"{\"a\":1}\n", "run.jsonl:1: not a recording: the first line has no 'lockstep_recording'"},
      {"[]\n", "run.jsonl:1: expected a JSON object"},
      {replaced(kWholeRecording, "recording\":1", "recording\":2"),
       "run.jsonl:1: recording of version 2, expected 1"},
      {replaced(kWholeRecording, "\"seed\"", "\"sed\""), "run.jsonl:1: 'seed' is missing"},
      {replaced(kWholeRecording, "10.0", "\"10\""), "run.jsonl:1: 'rate_hz' is not a number"},
      {replaced(kWholeRecording, "\"parent\":0", "\"parent\":5"),
       "run.jsonl:1: parent of node 1 comes after it"},
      {replaced(kWholeRecording, "\"index\":1", "\"index\":7"), "run.jsonl:1: node 1 is missing"},
      {replaced(kWholeRecording, "{\"tick\":1", "x\"tick\":1"), "run.jsonl:3: not JSON"},
      {replaced(kWholeRecording, "\"tick\":1", "\"tick\":0"),
       "run.jsonl:3: tick 0 comes after tick 0"},
      {replaced(kWholeRecording, "[2,\"running\"", "[9,\"running\""),
       "run.jsonl:2: no node 9, expected 0 to 2"},
      {replaced(kWholeRecording, "0.5,0,1]", "0.5,0,2]"),
       "run.jsonl:3: a node's change has a flag that is neither 0 nor 1"},
      {replaced(kWholeRecording, "0.5,0,1]", "1.5,0,1]"),
       "run.jsonl:3: a node's change has a progress that is not in [0, 1]"},
      {replaced(kWholeRecording, "0.5,0,1]", "0.5,0]"),
       "run.jsonl:3: a node's change is not [index, status, progress, ticked, held]"},
      {replaced(kWholeRecording, "{\"tick\":1", "{\"lost\":{\"ticks\":2,\"from\":1}}\n{\"tick\":1"),
       "run.jsonl:4: tick 1 comes after tick 2"},
      {replaced(kWholeRecording, "{\"tick\":1", "{\"lost\":{\"ticks\":2,\"from\":0}}\n{\"tick\":1"),
       "run.jsonl:3: tick 0 comes after tick 0"},
      {replaced(kWholeRecording, "{\"tick\":1", "{\"lost\":{\"ticks\":0,\"from\":1}}\n{\"tick\":1"),
       "run.jsonl:3: 0 ticks cannot be lost from tick 1 on"},
      {replaced(kWholeRecording, "{\"tick\":1",
                "{\"lost\":{\"ticks\":2,\"from\":18446744073709551615}}\n{\"tick\":1"),
       "run.jsonl:3: 2 ticks cannot be lost from tick 18446744073709551615 on"},
      {replaced(kWholeRecording, "0.5,0,1]]", "0.5,0,1]],\"faults\":[[3,\"x\"]]"),
       "run.jsonl:3: no node 3, expected 0 to 2"},
      {replaced(kWholeRecording, "0.5,0,1]]", "0.5,0,1]],\"faults\":[[1]]"),
       "run.jsonl:3: a fault is not [index, message]"},
      {std::string(kWholeRecording) + "{}\n", "run.jsonl:7: a line after the closing line"},
  };
  for (const auto& [text, expected] : cases) {
    std::istringstream in(text);
    RecordingReader reader(in, "run.jsonl");
    while (reader.next()) {
    }
    CHECK(reader.error() == expected);
    CHECK(reader.cut() == "");
  }
}

TEST_CASE("info measures a recording as the run was measured") {
  std::istringstream in(kWholeRecording);
  RecordingReader reader(in, "run.jsonl");
  const std::string info = info_text(reader);
  CHECK(info ==
        "Test from trees/a.xml, recorded by lockstep 0.1.0\n"
        "  3 nodes, 10 Hz, virtual clock, seed 18446744073709551615, semantics 3\n"
        "  argument barriers = 0.5;1\n"
        "  the tree after tick 3:\n"
        "    ParallelAbsolute (ParallelAbsolute barriers=0.5;1): success\n"
        "      a (Scripted): success\n"
        "      b (Scripted): success\n"
        "  success (completed) after 4 ticks, 0.300 s; 0 overruns, 0 deadlines skipped\n"
        "  Test/ParallelAbsolute (ParallelAbsolute, 4 ticks)\n"
        "    progress distance 0.5, mean 0.125 a tick\n"
        "    largest spread 0.25 (bound 1), longest step 0.5\n"
        "    a  did not wait\n"
        "    b  waited 1 time, 0.100 s in 1 tick\n");
}

TEST_CASE("info says that a recording is cut") {
  std::istringstream in(
      std::string(kWholeRecording).substr(0, std::string(kWholeRecording).find("{\"end")));
  RecordingReader reader(in, "run.jsonl");
  const std::string info = info_text(reader);
  CHECK(info.find("  4 ticks, 0.400 s; the recording is cut: it ends after line 5 without a "
                  "closing line\n") != std::string::npos);
}

TEST_CASE("info counts the ticks of the run in a part of it") {
  std::istringstream in(
      R"({"lockstep_recording":1,"tree":"T","file":"a.xml","version":"1","law":3,"rate_hz":10.0,)"
      R"("clock":"virtual","seed":0,"arguments":{},"nodes":[{"index":0,"path":"T/w","kind":"Wait",)"
      R"("name":"w","parent":null}],"first_tick":200})"
      "\n"
      R"({"tick":200,"time_s":20.0,"nodes":[[0,"running",0.5,1,0]],"whole":[]})"
      "\n"
      R"({"tick":201,"time_s":20.1,"nodes":[[0,"running",0.6,1,0]]})"
      "\n");
  RecordingReader reader(in, "run.jsonl");
  const std::string info = info_text(reader);
  INFO(info << reader.error());
  CHECK(info.find("  202 ticks, 20.200 s; the recording is cut") != std::string::npos);
}

TEST_CASE("a recording that cannot be written is reported once and the run goes on") {
  for (const char* path : {"/nowhere/run.jsonl", "/dev/full"}) {
    WatchedRun run(kTree, kLeaves);
    int told = 0;
    Recorder recorder(shape_of(run.run.tree()), {.path = path,
                                                 .run = {.tree_file = "a.xml"},
                                                 .on_error = [&](const std::string&) { ++told; }});
    const RunEnd end = run.watch({&recorder});
    CHECK(end.status == Status::Success);
    CHECK(told == 1);
    CHECK(recorder.error().find(std::string("'") + path + "': ") != std::string::npos);
  }
}

TEST_CASE("a recording has its last ticks when it is looked at after the run") {
  // More than one buffer of text.
  const std::string text = record("Repeat[times=1000](a)", "a=RS...", 5000);
  CHECK(text.size() > AppendFile::kFull);
  std::istringstream in(text);
  RecordingReader reader(in, "run.jsonl");
  std::uint64_t ticks = 0;
  while (reader.next()) ++ticks;
  CHECK(reader.error() == "");
  CHECK(ticks == 2000);
  REQUIRE(reader.end());
  CHECK(reader.end()->ticks == 2000);
}

}  // namespace
}  // namespace lockstep::host
