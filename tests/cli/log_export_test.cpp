// Recordings in other formats: by the rules of each, and the same as the recording.
#include <catch2/catch.hpp>
#include <map>

#include "support/json.h"
#include "support/paths.h"
#include "support/program.h"

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

namespace {

// What FileLogger2 of BehaviorTree.CPP writes: a name, a version, the document, the begin, and 9
// bytes for each change: when, which node, its status.
struct GrootLog {
  std::string document;
  std::uint64_t begin = 0;  // µs since 1970
  std::string changes;      // a line for each time: "30000 5:S 4:F"
};

std::uint64_t number_in(const std::string& bytes, std::size_t at, std::size_t count) {
  std::uint64_t number = 0;
  for (std::size_t i = count; i > 0; --i) {
    number = number << 8 | static_cast<unsigned char>(bytes.at(at + i - 1));
  }
  return number;
}

GrootLog read_groot_log(const std::string& bytes) {
  constexpr std::size_t kName = 18, kBegin = kName + 1 + 4;
  REQUIRE(bytes.starts_with("BTCPP4-FileLogger2\x01"));
  const std::size_t size = number_in(bytes, kName + 1, 4);
  GrootLog log{bytes.substr(kBegin, size), number_in(bytes, kBegin + size, 8), ""};
  std::uint64_t last = UINT64_MAX;
  for (std::size_t at = kBegin + size + 8; at < bytes.size(); at += 9) {
    const std::uint64_t time = number_in(bytes, at, 6);
    if (time != last) log.changes += (at > kBegin + size + 8 ? "\n" : "") + std::to_string(time);
    last = time;
    log.changes += " " + std::to_string(number_in(bytes, at + 6, 2)) + ":" +
                   "IRSFK"[number_in(bytes, at + 8, 1)];
  }
  return log;
}

}  // namespace

// The changes are those that version 4.10 of the library logs of the same tree, in its order, but
// for the changes to IDLE: a recording keeps the result of a node until that begins again.
TEST_CASE("log export --format btlog: what Groot2 replays") {
  const TemporaryDirectory directory;
  const std::string tree =
      directory.file("tree.xml", R"(<root BTCPP_format="4" main_tree_to_execute="Main">
<BehaviorTree ID="Main"><Sequence name="all">
 <Fallback name="try"><AlwaysFailure/><Inverter><Sleep msec="30"/></Inverter><Sleep msec="20"/></Fallback>
 <Parallel success_count="2"><Sleep msec="20"/><Sleep msec="50"/></Parallel>
 <SubTree ID="Sub" name="sub"/>
 <ForceSuccess><AlwaysFailure name="no"/></ForceSuccess>
</Sequence></BehaviorTree>
<BehaviorTree ID="Sub"><Sequence name="inner"><AlwaysSuccess/><Sleep msec="30"/></Sequence></BehaviorTree>
</root>)");
  const std::string file = directory.path("run.jsonl.zst"), out = directory.path("run.btlog");
  REQUIRE(run_lockstep({"run", tree, "--clock", "virtual", "--record", file}).code == 0);
  const auto export_it = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"log", "export", file, "--format", "btlog", "--out", out});
    return run_lockstep(more);
  };
  const Outcome outcome = export_it({"--start-time", "1700000000.5"});
  CHECK(outcome.err == "");
  REQUIRE(outcome.code == 0);
  const GrootLog log = read_groot_log(read_file(out));
  CHECK(log.begin == 1'700'000'000'500'000);
  CHECK(contains(log.document, "<Sequence name=\"inner\" _uid=\"11\">"));
  CHECK(log.changes ==
        "0 1:R 2:R 3:F 4:R 5:R\n"
        "30000 5:S 4:F 6:R\n"
        "50000 6:S 2:S 7:R 8:R 9:R\n"
        "70000 8:S\n"
        "100000 9:S 7:S 10:R 11:R 12:S 13:R\n"
        "130000 13:S 11:S 10:S 14:R 15:F 14:S 1:S");
  // The tree file may be another one by now, a part of it, or gone.
  std::string part = read_file(tree);
  part.erase(part.find(" <ForceSuccess>"),
             std::string(" <ForceSuccess><AlwaysFailure name=\"no\"/></ForceSuccess>\n").size());
  for (const std::string& text : {tree_text("<Wait seconds=\"1\"/>"), part}) {
    const Outcome wrong = export_it({"--tree-file", directory.file("other.xml", text)});
    CHECK(wrong.code == 2);
    CHECK(contains(wrong.err, "other.xml' is not the tree of the recording"));
  }
  CHECK(export_it({"--tree-file", directory.path("none.xml")}).code == 3);
  CHECK(export_it({"--from", "3"}).code == 2);
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
