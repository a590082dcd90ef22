// Recordings in other formats: by the rules of each, and the same as the recording.
#include <catch2/catch.hpp>
#include <map>

#include "support/program.h"
#include "support/json.h"
#include "support/paths.h"

namespace lockstep::host::test {
namespace {

struct Span {
  double begin, end;
  std::string name;
};

std::string exported(const TemporaryDirectory& directory, const std::string& tree,
                     std::vector<std::string> run_options = {}) {
  const std::string file = directory.path("run.jsonl.zst"), out = directory.path("out");
  run_options.insert(run_options.begin(), {"run", tree, "--clock", "virtual", "--record", file});
  run_lockstep(run_options);
  const Outcome outcome = run_lockstep({"log", "export", file, "--format", "trace", "--out", out});
  CHECK(outcome.err == "");
  REQUIRE(outcome.code == 0);
  return read_file(out);
}

// By track, in the order of their begin, outer ones first.
std::map<std::uint64_t, std::vector<Span>> slices(const nlohmann::json& trace) {
  std::map<std::uint64_t, std::vector<Span>> tracks;
  for (const auto& event : trace["traceEvents"]) {
    if (event["ph"] != "X") continue;
    const double begin = event["ts"];
    tracks[event["tid"]].push_back({begin, begin + double(event["dur"]), event["name"]});
  }
  for (auto& [track, spans] : tracks) {
    std::ranges::stable_sort(spans, [](const Span& a, const Span& b) {
      return a.begin != b.begin ? a.begin < b.begin : a.end > b.end;
    });
  }
  return tracks;
}

void check_nested(const std::vector<Span>& spans) {
  constexpr double kSame = 1e-4;  // microseconds
  std::vector<double> open;       // the ends of the slices around
  for (const Span& it : spans) {
    while (!open.empty() && open.back() <= it.begin + kSame) open.pop_back();
    if (!open.empty()) CHECK(it.end <= open.back() + kSame);
    open.push_back(it.end);
  }
}

}  // namespace

TEST_CASE("log export --format trace: slices of nodes, progress, entries") {
  const TemporaryDirectory directory;
  const std::string tree = directory.file(
      "tree.xml",
      "<root lockstep=\"1\"><plugin name=\"motion\"/><BehaviorTree ID=\"Test\">"
      "<ParallelAbsolute name=\"pull\" barriers=\"0.5;1\" on_success=\"done := true\">"
      "<Advance name=\"arm\" step=\"0.25\"/><Advance name=\"base\" step=\"0.5\"/>"
      "</ParallelAbsolute></BehaviorTree></root>");
  const auto trace = parse_json(exported(directory, tree, {"--rate", "10"}));
  auto tracks = slices(trace);
  const auto text = [&](std::uint64_t track) {
    std::string all;
    for (const Span& it : tracks[track]) {
      all +=
          it.name + " " + std::to_string(int(it.begin)) + "-" + std::to_string(int(it.end)) + " ";
    }
    return all;
  };
  CHECK(text(1) == "running 0-300000 success 300000-400000 ");
  CHECK(text(2) == "running 0-300000 success 300000-400000 ");
  CHECK(text(3) == "running 0-200000 held 100000-200000 success 200000-300000 ");
  std::string progress, instants;
  for (const auto& event : trace["traceEvents"]) {
    if (event["ph"] == "C") progress += event["args"].dump();
    if (event["ph"] == "i") instants += event["name"];
  }
  CHECK(progress ==
        R"({"arm":0,"base":0}{"arm":0.25,"base":0.5}{"arm":0.5,"base":0.5}{"arm":0.75,"base":1})");
  CHECK(instants == "done = true");
}

TEST_CASE("log export --format trace: in the traces of the example trees slices nest") {
  for (const std::string tree :
       {"fetch_and_carry", "museum_guide", "door_pulling", "philosophers"}) {
    const TemporaryDirectory directory;
    const auto trace = parse_json(exported(directory, LOCKSTEP_SOURCE_DIR "/trees/" + tree + ".xml",
                                           {"--max-ticks", "20000"}));
    const auto tracks = slices(trace);
    CHECK(tracks.size() > 3);
    for (const auto& [track, spans] : tracks) check_nested(spans);
  }
}

TEST_CASE("log export: a file that is read is not overwritten, and a format must be known") {
  CHECK(run_lockstep({"log", "export", "x.jsonl", "--format", "trace", "--out", "x.jsonl"}).code ==
        2);
  const Outcome outcome =
      run_lockstep({"log", "export", "x.jsonl", "--format", "bag", "--out", "y"});
  CHECK(outcome.code == 2);
  CHECK(contains(outcome.err, "trace"));
}

}  // namespace lockstep::host::test
