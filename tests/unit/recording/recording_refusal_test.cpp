// Every way in which a line of a recording can be wrong, and what is told of it.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <span>
#include <sstream>

#include "record/read/recording_reader.h"
#include "support/text.h"

namespace lockstep::host {
namespace {

using test::replaced;

const std::string kNodes =
    R"({"index":0,"path":"T/p","kind":"ParallelAbsolute","name":"p","parent":null,"barriers":[0.5,1]},)"
    R"({"index":1,"path":"T/p/q","kind":"ParallelRelative","name":"q","parent":0,"delta":0.25},)"
    R"({"index":2,"path":"T/p/q/a","kind":"Wait","name":"a","parent":1})";

const std::string kHeader =
    R"({"lockstep_recording":1,"tree":"T","file":"t.xml","version":"1","rate_hz":10,)"
    R"("clock":"virtual","seed":1,"arguments":{"x":"1"},"nodes":[)" +
    kNodes + "]}\n";

const std::string kTick =
    R"({"tick":0,"time_s":0,"nodes":[[2,"running",0.5,1,0]],"faults":[[2,"lost"]],"succeeded":[1]})"
    "\n";

const std::string kEnd =
    R"({"end":{"result":"success","reason":"completed","ticks":1,"time_s":0,"overruns":0,)"
    R"("skipped":0,"signal":2,"lost":0,"fault":"x","notes":["y"]}})"
    "\n";

std::string error_of(const std::string& text) {
  std::istringstream in(text);
  RecordingReader reader(in, "r");
  while (reader.next()) {
  }
  return reader.error();
}

const std::string kNoWholeNumber = " is not a whole number from 0 to 18446744073709551615";

struct Row {
  std::string from, to, error;
};

void check_all(const std::vector<Row>& rows, int line) {
  const std::string text = kHeader + kTick + kEnd;
  for (const auto& [from, to, error] : rows) {
    INFO(from << " -> " << to);
    CHECK(error_of(replaced(text, from, to)) == "r:" + std::to_string(line) + ": " + error);
  }
}

}  // namespace

TEST_CASE("the recording that the rows below change is right") {
  CHECK(error_of(kHeader + kTick + kEnd) == "");
  CHECK(error_of(replaced(kHeader, "[0.5,1]", "[]")) == "");
  CHECK(error_of(replaced(kHeader, "[0.5,1]", "[0,1]")) == "");
  CHECK(error_of(replaced(kHeader, "0.25", "0")) == "");
  CHECK(error_of(replaced(kHeader, "0.25", "1")) == "");
  CHECK(error_of(kHeader + replaced(kTick, "\"time_s\":0", "\"time_s\":9e9")) == "");
  CHECK(error_of(kHeader + replaced(kTick, "0.5", "1")) == "");
  CHECK(error_of(kHeader + replaced(kTick, "0.5", "0")) == "");
  for (const std::string rate : {"0", "1e-6", "1e9"}) {
    CHECK(error_of(replaced(kHeader, "\"rate_hz\":10", "\"rate_hz\":" + rate)) == "");
  }
  CHECK(error_of(kHeader + kTick + replaced(kEnd, "\"time_s\":0", "\"time_s\":9e9")) == "");
  CHECK(error_of(kHeader + "{\"lost\":{\"ticks\":9223372036854775808,\"from\":0}}\n") == "");
}

TEST_CASE("a gap ends where ticks can be counted") {
  CHECK(error_of(kHeader + "{\"lost\":{\"ticks\":9223372036854775809,\"from\":0}}\n") ==
        "r:2: 9223372036854775809 ticks cannot be lost from tick 0 on");
  CHECK(error_of(kHeader + "{\"lost\":{\"ticks\":9223372036854775807,\"from\":2}}\n") ==
        "r:2: 9223372036854775807 ticks cannot be lost from tick 2 on");
  CHECK(error_of(kHeader + "{\"lost\":{\"ticks\":0,\"from\":7}}\n") ==
        "r:2: 0 ticks cannot be lost from tick 7 on");
}

TEST_CASE("a header is refused for each value that is not what it must be") {
  const std::string rate = "'rate_hz' is not a number of ticks per second";
  check_all({{"\"T\"", "5", "'tree' is not a string"},
             {"\"t.xml\"", "null", "'file' is not a string"},
             {"\"1\",\"rate", "1,\"rate", "'version' is not a string"},
             {"\"virtual\"", "[]", "'clock' is not a string"},
             {"\"rate_hz\":10", "\"rate_hz\":-10", rate},
             {"\"rate_hz\":10", "\"rate_hz\":9.99e-7", rate},
             {"\"rate_hz\":10", "\"rate_hz\":1.001e9", rate},
             {"\"rate_hz\":10", "\"rate_hz\":1e-300", rate},
             {"\"rate_hz\":10", "\"rate_hz\":1e300", rate},
             {"\"rate_hz\":10", "\"rate_hz\":[]", "'rate_hz' is not a number"},
             {"\"seed\":1", "\"seed\":-1", "'seed'" + kNoWholeNumber},
             {"\"seed\":1", "\"seed\":1.5", "'seed'" + kNoWholeNumber},
             {"\"seed\":1", "\"seed\":18446744073709551616", "'seed'" + kNoWholeNumber},
             {"{\"x\":\"1\"}", "{\"x\":1}", "argument 'x' is not a string"},
             {"{\"x\":\"1\"}", "{\"x\":\"1\",\"x\":\"2\"}", "argument 'x' is given twice"},
             {"{\"x\":\"1\"}", "1", "'arguments' is not a JSON object"},
             {"{\"x\":\"1\"}", "[\"1\"]", "'arguments' is not a JSON object"},
             {"[" + kNodes + "]", "[]", "'nodes' is empty"},
             {"[" + kNodes + "]", "{}", "'nodes' is not a list"},
             {"[" + kNodes + "]", "[7]", "an item of 'nodes' is not a JSON object"},
             {"\"path\":\"T/p\"", "\"path\":1", "'path' is not a string"},
             {"\"kind\":\"Wait\"", "\"kind\":{}", "'kind' is not a string"},
             {"\"name\":\"q\"", "\"nam\":\"q\"", "'name' is missing"},
             {"\"parent\":null", "\"parent\":0", "parent of node 0 comes after it"},
             {"\"parent\":1", "\"parent\":2", "parent of node 2 comes after it"},
             {"\"parent\":1", "\"parent\":-1", "'parent'" + kNoWholeNumber},
             {"\"parent\":1", "\"parent\":null", "node 2 is not in pre-order"},
             {"\"path\":\"T/p\"", "\"path\":\"T/p/q\"", "two nodes have the path 'T/p/q'"},
             {"[0.5,1]", "0.5", "'barriers' is not a list"},
             {"[0.5,1]", "[\"0.5\"]", "an item of 'barriers' is not a number"},
             {"[0.5,1]", "[0.5,1],\"delta\":1", "node 0 has both barriers and delta"},
             {"[0.5,1]", "[0.5,1.5]", "a barrier of node 0 is not in [0, 1]"},
             {"[0.5,1]", "[-0.5,1]", "a barrier of node 0 is not in [0, 1]"},
             {"0.25", "1.25", "the delta of node 1 is not in [0, 1]"},
             {"0.25", "-0.25", "the delta of node 1 is not in [0, 1]"},
             {"0.25", "\"\"", "'delta' is not a number"}},
            1);
}

TEST_CASE("a tick is refused for each value that is not what it must be") {
  const std::string time = "'time_s' is not a time in seconds";
  const std::string change = "a node's change is not [index, status, progress, ticked, held]";
  std::string status = ", expected idle";
  for (const StatusRow& row : std::span(kStatuses).subspan(1)) {
    status += fmt::format("{}{}", row.status == kLastStatus ? " or " : ", ", row.name);
  }
  const std::string limit = "a node's limit is not [index, number in [0, 1] or null]";
  for (const std::string wrong :
       {"7", "[]", "[0]", "[0,0.5,1]", "[0,1.5]", "[0,-0.1]", "[0,\"1\"]"}) {
    check_all({{"\"tick\":0", "\"limits\":[" + wrong + "],\"tick\":0", limit}}, 2);
  }
  const std::string round = "a node's round is not [index, number, of]";
  for (const std::string wrong :
       {"7", "[0,1]", "[0,1,2,3]", "[0,-1,2]", "[0,1.5,2]", "[0,9223372036854775808,0]"}) {
    check_all({{"\"tick\":0", "\"rounds\":[" + wrong + "],\"tick\":0", round}}, 2);
  }
  const std::string log = "a log line is not [who, level, text]";
  check_all({{"\"tick\":0", "\"entries\":[7],\"tick\":0", "an entry is given twice"},
             {"\"tick\":0", "\"logs\":[7],\"tick\":0", log},
             {"\"tick\":0", "\"logs\":[[\"a\",\"info\"]],\"tick\":0", log},
             {"\"tick\":0", "\"logs\":[[\"a\",\"info\",\"b\",\"c\"]],\"tick\":0", log},
             {"\"tick\":0", "\"logs\":[[\"a\",\"info\",1]],\"tick\":0", log}},
            2);
  check_all({{"\"tick\":0", "\"tick\":-1", "'tick'" + kNoWholeNumber},
             {"\"tick\":0", "\"tick\":\"0\"", "'tick'" + kNoWholeNumber},
             {"\"tick\":0", "\"tick\":18446744073709551616", "'tick'" + kNoWholeNumber},
             {"\"tick\":0", "\"tick\":1", "the first tick is 1, expected 0"},
             {"\"tick\":0", "\"tick\":0,\"tick\":0", "'tick' is given twice"},
             {"\"tick\":0,", "", "'tick' is missing"},
             {"\"tick\":0", "\"tick\":0,\"lost\":{\"ticks\":1,\"from\":0}", "a line of two kinds"},
             {"\"tick\":0", "\"tick\":0,\"x\":[nul]", "not JSON"},
             {"\"time_s\":0", "\"time_s\":-1e-9", time},
             {"\"time_s\":0", "\"time_s\":9.000001e9", time},
             {"\"time_s\":0", "\"time_s\":\"0\"", "'time_s' is not a number"},
             {"[[2,\"running\",0.5,1,0]]", "5", "'nodes' is not a list"},
             {"[2,\"running\",0.5,1,0]", "[]", change},
             {"[2,\"running\",0.5,1,0]", "2", change},
             {"[2,\"running\"", "[-2,\"running\"", change},
             {"[2,\"running\"", "[3,\"running\"", "no node 3, expected 0 to 2"},
             {"\"running\"", "3", "a node's change has a status that is not a string"},
             {"\"running\"", "\"paused\"", "no status 'paused'" + status},
             {"0.5,1,0", "-0.5,1,0", "a node's change has a progress that is not in [0, 1]"},
             {"0.5,1,0", "1.1,1,0", "a node's change has a progress that is not in [0, 1]"},
             {"0.5,1,0", "null,1,0", "a node's change has a progress that is not in [0, 1]"},
             {"0.5,1,0", "0.5,2,0", "a node's change has a flag that is neither 0 nor 1"},
             {"0.5,1,0", "0.5,1,true", "a node's change has a flag that is neither 0 nor 1"},
             {"[[2,\"lost\"]]", "{}", "'faults' is not a list"},
             {"[2,\"lost\"]", "[3,\"lost\"]", "no node 3, expected 0 to 2"},
             {"[2,\"lost\"]", "[2,3]", "a fault is not [index, message]"},
             {"[2,\"lost\"]", "[-2,\"lost\"]", "a fault is not [index, message]"},
             {"\"succeeded\":[1]", "\"succeeded\":1", "'succeeded' is not a list"},
             {"\"succeeded\":[1]", "\"succeeded\":[3]", "no node 3, expected 0 to 2"},
             {"\"succeeded\":[1]", "\"succeeded\":[-1]", "'succeeded' is not a list of indices"}},
            2);
}

TEST_CASE("a closing line is refused for each value that is not what it must be") {
  check_all({{"{\"result\"", "{\"resul\"", "'result' is missing"},
             {"\"success\",\"reason\"", "1,\"reason\"", "'result' is not a string"},
             {"\"completed\"", "null", "'reason' is not a string"},
             {"\"ticks\":1", "\"ticks\":-1", "'ticks'" + kNoWholeNumber},
             {"\"ticks\":1", "\"ticks\":2", "'ticks' is 2, but the run had 1"},
             {"\"time_s\":0,\"over", "\"time_s\":1e10,\"over", "'time_s' is not a time in seconds"},
             {"\"overruns\":0", "\"overruns\":0.5", "'overruns'" + kNoWholeNumber},
             {"\"skipped\":0", "\"skipped\":[]", "'skipped'" + kNoWholeNumber},
             {"[\"y\"]", "\"y\"", "'notes' is not a list"},
             {"[\"y\"]", "[1]", "an item of 'notes' is not a string"},
             {"\"signal\":2", "\"signal\":\"2\"", "'signal'" + kNoWholeNumber},
             {"\"lost\":0", "\"lost\":-1", "'lost'" + kNoWholeNumber},
             {"\"lost\":0", "\"lost\":1", "'lost' is 1, but 0 ticks have no line"},
             {"\"fault\":\"x\"", "\"fault\":0", "'fault' is not a string"}},
            3);
  CHECK(error_of(kHeader + "{\"end\":3}\n") == "r:2: 'end' is not a JSON object");
  CHECK(error_of(kHeader + "{\"lost\":3}\n") == "r:2: 'lost' is not a JSON object");
  CHECK(error_of(kHeader + "3\n") == "r:2: expected a JSON object");
  CHECK(error_of(kHeader + "[]\n") == "r:2: expected a JSON object");
  CHECK(error_of(kHeader + "x\n") == "r:2: not JSON");
  CHECK(error_of(kHeader + "\xff\n") == "r:2: not JSON");
}

TEST_CASE("a line that is too long is refused before it is kept") {
  const RecordingReader::Limits limits{.line = kHeader.size()};
  const auto error_of_line = [&](const std::string& line) {
    std::istringstream in(kHeader + line);
    RecordingReader reader(in, "r", limits);
    while (reader.next()) {
    }
    return reader.error();
  };
  const std::string tick = R"({"tick":0,"time_s":0,"nodes":[]})";
  const std::string longest = tick + std::string(kHeader.size() - 1 - tick.size(), ' ');
  CHECK(error_of_line(longest + "\n" + R"({"tick":1,"time_s":0,"nodes":[]})" + "\n") == "");
  CHECK(error_of_line(longest + "  \n").starts_with("r:2: the line is longer than"));
  CHECK(
      error_of_line(std::string(10 * kHeader.size(), 'x')).starts_with("r:2: the line is longer"));
}

}  // namespace lockstep::host
