// A small recording, damaged at each of its bytes in each way that matters: it is refused with the
// place, or read as a slow and obvious reader reads it. No number ever changes in silence.
#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "record/read/recording_timeline.h"

namespace lockstep::host {
namespace {

using Json = nlohmann::json;
using Strings = std::vector<std::string>;
using namespace std::string_view_literals;

const std::string kRecording =
    R"({"lockstep_recording":1,"tree":"T\u00e9","file":"a \"b\".xml","version":"0.1.0",)"
    R"("rate_hz":1e1,"clock":"virtual","seed":18446744073709551615,"arguments":{"x":"0.5;1"},)"
    R"("nodes":[{"index":0,"path":"T/p","kind":"ParallelAbsolute","name":"p","parent":null,)"
    R"("barriers":[0.5,1.0]},)"
    R"({"index":1,"path":"T/p/q","kind":"ParallelRelative","name":"q","parent":0,"delta":0.25},)"
    R"({"index":2,"path":"T/p/q/a","kind":"Wait","name":"a","parent":1}]})"
    "\n"
    R"({"tick":0,"time_s":0.0,"nodes":[[0,"running",0,1,0],[1,"running",1e-05,1,0]]})"
    "\n"
    R"({"tick":1,"time_s":0.1,"nodes":[[2,"failure",0.30000000000000004,0,1]],)"
    R"("faults":[[2,"lost \u0007 it"],[1,""]]})"
    "\n"
    R"({"lost":{"ticks":9,"from":2}})"
    "\n"
    R"({"tick":11,"time_s":1.1,"nodes":[],"later":{"a":[true,null,-1.5e3,"\n"]}})"
    "\n"
    R"({"end":{"result":"stopped","reason":"signal","signal":2,"ticks":12,"time_s":1.1,)"
    R"("overruns":3,"skipped":4,"lost":9}})"
    "\n";

// What the reader says of a text.
struct Outcome {
  RecordingHeader header;
  std::vector<TimelineTick> ticks;
  RecordingOutcome outcome;
};

Outcome read_text(const std::string& text) {
  std::istringstream in(text);
  RecordingReader reader(in, "r");
  Outcome reading;
  std::uint64_t expected = 0;
  while (const auto tick = reader.next()) {
    take(*tick, tick->tick - expected, reading.ticks.emplace_back());
    expected = tick->tick + 1;
  }
  reading.header = reader.header();
  reading.outcome = reader.outcome();
  return reading;
}

// Each of the following is true when `json` says the same.

bool same(const ShapeNode& node, const Json& json) {
  const bool same_parent =
      node.parent ? json.at("parent") == *node.parent : json.at("parent").is_null();
  const bool same_barriers =
      node.synchronization != Synchronization::Absolute || json.at("barriers") == *node.barriers;
  const bool same_delta =
      node.synchronization != Synchronization::Relative || json.at("delta") == *node.delta;
  return json.at("path") == node.path && json.at("kind") == node.kind &&
         json.at("name") == node.name && same_parent && same_barriers && same_delta;
}

bool same(const RecordingHeader& header, const Json& json) {
  bool is_same = json.at("lockstep_recording") == 1 && json.at("tree") == header.id &&
                 json.at("file") == header.file && json.at("version") == header.version &&
                 json.at("rate_hz") == header.rate_hz && json.at("clock") == header.clock &&
                 json.at("seed") == header.seed && json.at("arguments") == header.arguments &&
                 json.at("nodes").size() == header.nodes.size();
  for (std::size_t node = 0; is_same && node < header.nodes.size(); ++node) {
    is_same = json.at("nodes")[node].at("index") == node &&
              same(header.nodes[node], json.at("nodes")[node]);
  }
  return is_same;
}

bool same(const RecordedEnd& end, const Json& json) {
  return json.at("result") == end.result && json.at("reason") == end.reason &&
         json.value("fault", "") == end.fault && json.at("ticks") == end.ticks &&
         json.value("signal", 0u) == end.signal.value_or(0) && json.at("time_s") == end.time &&
         json.at("overruns") == end.overruns && json.at("skipped") == end.skipped &&
         json.value("lost", 0u) == end.lost && json.value("notes", Strings()) == end.notes;
}

void apply(const Json& changes, std::vector<RecordedState>& states) {
  for (const Json& change : changes) {
    REQUIRE(change.size() == 5);
    RecordedState& state = states.at(change[0].get<std::size_t>());
    for (const StatusRow& row : kStatuses) {
      if (change[1] == row.name) state.status = row.status;
    }
    REQUIRE(change[1] == to_string(state.status));
    state.progress = change[2].get<double>();
    state.ticked = change[3] != 0;
    state.held = change[4] != 0;
  }
}

void apply_limits(const Json& changes, std::vector<RecordedState>& states) {
  for (const Json& change : changes) {
    REQUIRE(change.size() == 2);
    states.at(change[0].get<std::size_t>()).limit =
        change[1].is_null() ? std::numeric_limits<double>::infinity() : change[1].get<double>();
  }
}

bool same(const TimelineTick& moment, const Json& json, const std::vector<RecordedState>& states) {
  const Json faults = json.value("faults", Json::array());
  bool is_same = json.at("tick") == moment.tick && json.at("time_s") == moment.time &&
                 moment.nodes == states && faults.size() == moment.faults.size();
  for (std::size_t i = 0; is_same && i < faults.size(); ++i) {
    is_same = faults[i] == Json{moment.faults[i].node, moment.faults[i].message};
  }
  return is_same;
}

// Discarded when it is no JSON. The library ends its reading at a NUL.
Json parse(const std::string& line) {
  if (line.find('\0') != std::string::npos) return Json::value_t::discarded;
  return Json::parse(line, nullptr, false);
}

// Line by line, with a tree of each.
bool same(const Outcome& reading, const std::string& text) {
  std::istringstream in(text);
  std::string line;
  std::getline(in, line);
  if (!same(reading.header, parse(line))) return false;
  std::vector<RecordedState> states(reading.header.nodes.size());
  std::size_t number = 0;
  bool has_end = false;
  while (std::getline(in, line)) {
    const Json json = parse(line);
    if (json.is_discarded()) {
      if (reading.outcome.cut.empty() || in.peek() != EOF) return false;
    } else if (json.contains("end")) {
      has_end = true;
      if (!reading.outcome.end || !same(*reading.outcome.end, json["end"])) return false;
    } else if (!json.contains("lost")) {
      apply(json.at("nodes"), states);
      apply_limits(json.value("limits", Json::array()), states);
      if (number == reading.ticks.size() || !same(reading.ticks[number], json, states))
        return false;
      ++number;
    }
  }
  return number == reading.ticks.size() && has_end == reading.outcome.end.has_value();
}

std::size_t line_of(const std::string& text, std::size_t at) {
  return static_cast<std::size_t>(
      1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

// "r:7: …", and not before the damage.
bool is_placed(const std::string& error, std::size_t least_line) {
  if (!error.starts_with("r:")) return false;
  std::size_t end = 0;
  const std::size_t line = std::stoul(error.substr(2), &end);
  return line >= least_line && error.substr(2 + end, 2) == ": " && error.size() > 4 + end;
}

struct Counts {
  int refused = 0, cut = 0, read = 0;
};

void check(const std::string& damaged, std::size_t at, Counts& counts) {
  const Outcome reading = read_text(damaged);
  if (!reading.outcome.error.empty()) {
    ++counts.refused;
    if (is_placed(reading.outcome.error, line_of(damaged, at))) return;
    FAIL(reading.outcome.error << "\nof " << damaged);
  }
  ++(reading.outcome.cut.empty() ? counts.read : counts.cut);
  if (!same(reading, damaged)) FAIL("read as something else: " << damaged);
}

}  // namespace

TEST_CASE("the recording that is damaged below is right") {
  const Outcome reading = read_text(kRecording);
  CHECK(reading.outcome.error == "");
  CHECK(reading.outcome.cut == "");
  CHECK(reading.ticks.size() == 3);
  CHECK(same(reading, kRecording));
}

TEST_CASE("a recording that is damaged in one byte is refused with its place, or read exactly") {
  // Of each class that JSON, UTF-8 and numbers know.
  constexpr auto kOthers = "019-+.eE\"\\/{}[],:; \t\r\nabtnuT\0\x1f\x7f\x80\xc3\xed\xf4\xff"sv;
  constexpr auto kInserted = "0-.\"\\{],: \n\x80"sv;
  Counts counts;
  for (std::size_t at = 0; at < kRecording.size(); ++at) {
    for (const char other : kOthers) {
      std::string damaged = kRecording;
      damaged[at] = other;
      check(damaged, at, counts);
    }
    for (const char other : kInserted) {
      check(std::string(kRecording).insert(at, 1, other), at, counts);
    }
    for (unsigned bit = 0; bit < 8; ++bit) {
      std::string damaged = kRecording;
      damaged[at] = static_cast<char>(damaged[at] ^ (1u << bit));
      check(damaged, at, counts);
    }
    check(std::string(kRecording).erase(at, 1), at, counts);
  }
  CHECK(counts.refused > counts.read);
  CHECK(counts.read > 0);
}

TEST_CASE("a recording that lacks a line, or has one twice, is refused") {
  std::vector<std::string> lines;
  std::istringstream in(kRecording);
  for (std::string line; std::getline(in, line);) lines.push_back(line + "\n");
  for (std::size_t line = 0; line < lines.size(); ++line) {
    std::string without, twice;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      if (i != line) without += lines[i];
      twice += i == line ? lines[i] + lines[i] : lines[i];
    }
    INFO(lines[line]);
    CHECK(is_placed(read_text(twice).outcome.error, line + 2));
    const RecordingOutcome outcome = read_text(without).outcome;
    if (line + 1 < lines.size())
      CHECK(is_placed(outcome.error, line + 1));
    else
      CHECK(outcome.cut == "it ends after line 5 without a closing line");
  }
}

TEST_CASE("what remains of a recording that is cut anywhere is read exactly") {
  for (std::size_t size = kRecording.find('\n'); size < kRecording.size() - 1; ++size) {
    const std::string cut = kRecording.substr(0, size);
    const Outcome reading = read_text(cut);
    REQUIRE(reading.outcome.error == "");
    REQUIRE(reading.outcome.cut != "");
    REQUIRE(same(reading, cut));
  }
}

}  // namespace lockstep::host
