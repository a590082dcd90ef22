// `lockstep log merge`: one recording of a team, from those of its robots.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "base/core/random.h"
#include "support/json.h"
#include "support/paths.h"
#include "support/program.h"
#include "support/text.h"

using namespace lockstep::host::test;
using lockstep::host::RandomStream;

namespace {

using Arguments = std::vector<std::string>;

const std::string kTogether = LOCKSTEP_SOURCE_DIR "/trees/carry_together/carry.xml";

// Records a simulated team of these files into a folder.
void record_team(const std::string& folder, Arguments robots, const Arguments& more = {}) {
  robots.insert(robots.begin(), "team");
  robots.insert(robots.end(), more.begin(), more.end());
  robots.insert(robots.end(), {"--record", folder});
  run_lockstep(robots);
}

void record_carry(const std::string& folder, const Arguments& more = {}) {
  record_team(folder, {kTogether + ",me=left", kTogether + ",me=right"}, more);
}

struct Began {
  double seconds = 0, uncertainty = 0;
};

// "note: 'right' began 0.500 s ± 0.012 s after 'left'"
Began began_in(const std::string& text, const std::string& name) {
  const auto at = text.find("'" + name + "' began ");
  REQUIRE(at != std::string::npos);
  const std::string rest = text.substr(at + name.size() + 9);
  const auto sign = rest.find("± ");
  const auto line = rest.substr(0, rest.find('\n'));
  Began began{std::stod(rest), std::stod(rest.substr(sign + std::string("± ").size()))};
  if (contains(line, "before")) began.seconds = -began.seconds;
  return began;
}

// Of each node: how it was in each tick that reached it.
using Reached = std::map<std::string, std::vector<std::string>>;

Reached reached_in(const std::string& file, const std::string& robot) {
  Reached found;
  for (const std::string& row : lines(run_lockstep({"log", "csv", file}).out)) {
    std::vector<std::string> cells(1);
    for (const char it : row) it == ',' ? void(cells.emplace_back()) : void(cells.back() += it);
    // tick,time_s,node,path,status,progress,ticked,held,…
    if (cells.size() < 8 || cells[6] != "1" || !cells[3].starts_with(robot)) continue;
    found[cells[3].substr(robot.size())].push_back(cells[4] + " at " + cells[5] + ", " + cells[7]);
  }
  return found;
}

// A recording, as it is where the process was killed before a tick, and another one continued after
// a pause of so many ticks: its file, and that of another robot, which hears two processes.
struct Killed {
  static constexpr std::uint64_t kRun = 4242;  // of the second process
  static constexpr double kPeriod = 0.01;

  Killed(const std::string& path, std::uint64_t before, std::uint64_t ticks)
      : tick(before), pause(ticks) {
    const auto all = lines(read_file(path));
    auto header = nlohmann::ordered_json::parse(all.front());
    run = header["run"];
    header["first_tick"] = tick;
    header["resumed_after_s"] = static_cast<double>(pause) * kPeriod;
    header["run"] = kRun;
    std::ofstream killed(path), resumed(replaced(path, ".jsonl", ".resumed-1.jsonl"));
    resumed << header.dump() << '\n';
    for (const std::string& line : all) {
      auto it = nlohmann::ordered_json::parse(line);
      if (!it.contains("tick")) {
        killed << (&line == &all.front() ? line + '\n' : "");
        if (it.contains("end")) resumed << later(it, "end").dump() << '\n';
      } else if (it["tick"] < tick) {
        killed << line << '\n';
        keep(it);
      } else if (keep(it); it["tick"] >= tick + pause) {
        if (it["tick"] == tick + pause) it.update(whole());
        resumed << later(it, "").dump() << '\n';
      }
    }
  }

  void heard_in(const std::string& path, bool is_second_heard) const {
    std::string text;
    for (const std::string& line : lines(read_file(path))) {
      auto it = nlohmann::ordered_json::parse(line);
      if (it.contains("heard")) {
        auto words = nlohmann::ordered_json::array();
        for (auto word : it["heard"]) {
          const bool is_second = word[1] == run && word[2] > tick + pause;
          if (is_second && !is_second_heard) continue;
          if (word[1] == run && !is_second && word[2] > tick) continue;
          if (is_second) word = {word[0], kRun, word[2].get<std::uint64_t>() - tick - pause};
          words.push_back(word);
        }
        it["heard"] = words;
      }
      text += it.dump() + '\n';
    }
    std::ofstream(path) << text;
  }

  std::uint64_t tick, pause, run = 0;

 private:
  void keep(const nlohmann::ordered_json& line) {
    for (const auto& node : line["nodes"]) nodes_[node[0]] = node;
    if (line.contains("limits"))
      for (const auto& limit : line["limits"]) limits_[limit[0]] = limit;
  }
  nlohmann::ordered_json whole() const {
    nlohmann::ordered_json all{{"nodes", nlohmann::json::array()},
                               {"limits", nlohmann::json::array()},
                               {"whole", nlohmann::json::array()}};
    for (const auto& [index, node] : nodes_) all["nodes"].push_back(node);
    for (const auto& [index, limit] : limits_) all["limits"].push_back(limit);
    return all;
  }
  nlohmann::ordered_json later(nlohmann::ordered_json line, const std::string& in) const {
    auto& it = in.empty() ? line : line[in];
    auto& number = it[in.empty() ? "tick" : "ticks"];
    number = number.get<std::uint64_t>() - pause;
    it["time_s"] = it["time_s"].get<double>() - static_cast<double>(pause) * kPeriod;
    return line;
  }

  std::map<int, nlohmann::ordered_json> nodes_, limits_;
};

// Those of its nodes, without their ticks and times.
std::vector<std::string> events_in(const std::string& file, const std::string& robot) {
  std::vector<std::string> found;
  for (std::string line : lines(run_lockstep({"log", "events", file, "--format", "csv"}).out)) {
    line.erase(0, line.find(',', line.find(',') + 1));  // ",success,Carry/InStep,"
    const auto path = line.find(',', 1) + 1;
    const bool is_of_node = line.compare(path, robot.size(), robot) == 0 && contains(line, "/");
    if (is_of_node && !contains(line, ",log,")) found.push_back(line.erase(path, robot.size()));
  }
  return found;
}

// Of a robot: how often, in how many ticks and for how long its synchronized nodes held children.
struct Waits {
  std::vector<std::string> counts = {};
  double seconds = 0;
  int times = 0;
};

Waits waits_in(const std::string& file, const std::string& robot) {
  Waits found;
  bool is_of_robot = false;
  for (const std::string& line : lines(run_lockstep({"log", "info", file}).out)) {
    if (line.ends_with(" ticks)")) is_of_robot = line.starts_with("  " + robot);
    const auto waited = line.find(" waited "), seconds = line.find(", "),
               unit = line.find(" s in ");
    if (!is_of_robot || waited == line.npos) continue;
    found.counts.push_back(line.substr(0, seconds) + line.substr(unit));
    found.seconds += std::stod(line.substr(seconds + 2));
    found.times += std::stoi(line.substr(waited + 8));
  }
  return found;
}

std::string three_robots(const std::string& me) {
  return "<root lockstep=\"1\"><plugin name=\"motion\"/><team name=\"row\" "
         "members=\"a;b;c\"/><BehaviorTree ID=\"Drive\"><InStep team=\"row\" as=\"" +
         me +
         "\" delta=\"0.1\"><Sequence><Check name=\"ready\" code=\"1 == 1\"/>"
         "<Advance name=\"drive\" step=\"0.02\"/></Sequence></InStep></BehaviorTree></root>\n";
}

}  // namespace

TEST_CASE("log merge: the start of each robot is within the uncertainty that is reported") {
  const TemporaryDirectory directory;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    RandomStream random(seed, 0);
    const double starts[] = {random.next_double(), random.next_double()};
    const double latency = seed % 4 == 0 ? 0 : 0.1 * random.next_double();
    const auto text = [](double value) { return fmt::format("{:.6f}", value); };
    record_carry(
        directory.path("runs"),
        {"--start", text(starts[0]), text(starts[1]), "--latency", text(latency), "--jitter",
         text(0.05 * random.next_double()), "--loss", text(0.3 * random.next_double()), "--seed",
         std::to_string(seed), "--rate", seed % 3 == 0 ? "30" : "100"});
    const Outcome merged =
        run_lockstep({"log", "merge", directory.path("runs/left.jsonl"),
                      directory.path("runs/right.jsonl"), "--out", directory.path("team.jsonl")});
    INFO(seed << ' ' << merged.err);
    REQUIRE(merged.code == 0);
    const Began began = began_in(merged.err, "right");
    CHECK(std::abs(began.seconds - (starts[1] - starts[0])) <= began.uncertainty + 1e-9);
    CHECK(began.uncertainty <= latency + 0.05 + 0.04);
  }
}

TEST_CASE("log merge: all robots of a team have a place, whatever their number and order") {
  const TemporaryDirectory directory;
  Arguments trees;
  for (const char* const me : {"a", "b", "c"})
    trees.push_back(directory.file(std::string(me) + ".xml", three_robots(me)));
  record_team(directory.path("runs"), trees, {"--start", "0.4", "0", "0.7", "--latency", "0.03"});
  const Outcome merged =
      run_lockstep({"log", "merge", directory.path("runs/a.jsonl"), directory.path("runs/b.jsonl"),
                    directory.path("runs/c.jsonl"), "-o", directory.path("team.jsonl")});
  INFO(merged.err);
  REQUIRE(merged.code == 0);
  CHECK(contains(merged.err, "before 'a'"));
  CHECK(std::abs(began_in(merged.err, "b").seconds + 0.4) <= began_in(merged.err, "b").uncertainty);
  CHECK(std::abs(began_in(merged.err, "c").seconds - 0.3) <= began_in(merged.err, "c").uncertainty);
  const Outcome info = run_lockstep({"log", "info", directory.path("team.jsonl")});
  CHECK(info.code == 0);
  CHECK(info.err.empty());
  CHECK(contains(info.out, "row from "));
  CHECK(contains(info.out, "success (completed) after"));
}

TEST_CASE("log merge: the result is what each robot has recorded, for all commands that read it") {
  const TemporaryDirectory directory;
  const std::string left = directory.path("runs/left.jsonl"),
                    right = directory.path("runs/right.jsonl"), team = directory.path("team.jsonl");
  record_carry(directory.path("runs"), {"--start", "0", "0.3", "--latency", "0.03"});
  REQUIRE(run_lockstep({"log", "merge", left, right, "--out", team}).code == 0);
  CHECK(run_lockstep({"log", "merge", left, right}).out == read_file(team));
  // The measures of each robot.
  const auto measured = [](const std::string& file) {
    return parse_json(run_lockstep({"log", "measure", file, "--json", "--measure",
                                    "progress-distance", "--measure", "held:lift"})
                          .out);
  };
  const Outcome all = run_lockstep({"log", "measure", team, "--json"});
  CHECK(all.code == 0);
  for (const auto& [file, name] : {std::pair{left, "left"}, std::pair{right, "right"}}) {
    INFO(name);
    const auto own = measured(file);
    const auto merged =
        parse_json(run_lockstep({"log", "measure", team, "--json", "--measure", "progress-distance",
                                 "--measure", std::string("held:") + name + "/Carry/InStep/lift"})
                       .out);
    for (const auto& it : own) {
      bool is_found = false;
      for (const auto& other : merged) {
        const bool is_same_node =
            other["node"].get<std::string>() ==
            "table/" + std::string(name) + "/" + it["node"].get<std::string>();
        if (!is_same_node || other["measure"] != it["measure"]) continue;
        is_found = true;
        CHECK(other["value"] == it["value"]);
      }
      CHECK((is_found || it["measure"] != "progress-distance"));
    }
  }
  // The events of each robot, in their order.
  const auto events = [](const std::string& file, const std::string& robot) {
    std::string found;
    const Outcome outcome =
        run_lockstep({"log", "events", file, "--format", "csv", "--path", robot + "Carry/*"});
    for (std::string line : lines(outcome.out)) {  // without its tick and time
      line.erase(0, line.find(',', line.find(',') + 1));
      found += contains(line, robot) ? replaced(line, robot, "") + '\n' : line + '\n';
    }
    return found;
  };
  CHECK(events(team, "table/left/") == events(left, ""));
  CHECK(events(team, "table/right/") == events(right, ""));
  for (const Arguments& command :
       {Arguments{"log", "csv", team}, Arguments{"log", "why", team, "left/Carry/InStep/lift"},
        Arguments{"log", "check", team, "--property",
                  "left/Carry/InStep/lift.held at most 200 ticks"},
        Arguments{"log", "export", team, "--format", "mcap", "--out", directory.path("t.mcap")},
        Arguments{"log", "export", team, "--format", "trace", "--out", directory.path("t.json")},
        Arguments{"log", "page", team, "--out", directory.path("t.html")},
        Arguments{"replay", team, "--print", "--at", "20"}}) {
    const Outcome outcome = run_lockstep(command);
    INFO(command[0] << ' ' << command[1] << ' ' << outcome.err);
    CHECK(outcome.code == 0);
  }
}

TEST_CASE("log merge: each tick of a robot is in the result, whatever the phase of the others") {
  const TemporaryDirectory directory;
  Arguments row;
  for (const char* const me : {"a", "b", "c"})
    row.push_back(directory.file(std::string(me) + ".xml", three_robots(me)));
  std::size_t ticks = 0;
  double seconds = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    RandomStream random(seed, 0);
    const bool is_row = seed % 2 == 0;
    const std::string runs = directory.path("runs-" + std::to_string(seed));
    const Arguments timing{"--rate", "10", "--latency", "0.15"};
    is_row ? record_team(runs, row, timing) : record_carry(runs, timing);
    const Arguments names = is_row ? Arguments{"a", "b", "c"} : Arguments{"left", "right"};
    Arguments merge{"log", "merge", "-o", directory.path("team.jsonl")};
    for (const std::string& it : names) {
      merge.push_back(runs + '/' + it + ".jsonl");
      if (it == names.front()) continue;
      merge.insert(merge.end(), {"--offset", fmt::format("{}={:.3f}", it, random.next_double())});
    }
    REQUIRE(run_lockstep(merge).code == 0);
    for (const std::string& it : names) {
      INFO(seed << ' ' << it);
      const Reached own = reached_in(runs + '/' + it + ".jsonl", "");
      CHECK(reached_in(directory.path("team.jsonl"), (is_row ? "row/" : "table/") + it + '/') ==
            own);
      for (const auto& [node, states] : own) ticks += states.size();
      CHECK(events_in(directory.path("team.jsonl"), (is_row ? "row/" : "table/") + it + '/') ==
            events_in(runs + '/' + it + ".jsonl", ""));
      const Waits own_waits = waits_in(runs + '/' + it + ".jsonl", "");
      const Waits waits =
          waits_in(directory.path("team.jsonl"), (is_row ? "row/" : "table/") + it + '/');
      CHECK(waits.counts == own_waits.counts);
      // A tick that is in a line with one of another robot has the time of the earlier one.
      CHECK(std::abs(waits.seconds - own_waits.seconds) <= 0.05 * own_waits.times + 1e-9);
      seconds += waits.seconds;
    }
  }
  CHECK(ticks > 1000);
  CHECK(seconds > 1);
}

TEST_CASE("log merge: each process of a run that was cut and continued has its place") {
  const TemporaryDirectory directory;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    RandomStream random(seed, 0);
    const auto below = [&](double most) { return most * random.next_double(); };
    const double start = below(0.5), latency = below(0.04);
    const std::string runs = directory.path("runs"), left = runs + "/left.jsonl",
                      right = runs + "/right.jsonl", team = directory.path("team.jsonl");
    std::filesystem::remove_all(runs);
    record_carry(runs, {"--start", "0", fmt::format("{:.6f}", start), "--latency",
                        fmt::format("{:.6f}", latency), "--seed", std::to_string(seed)});
    const Killed killed(right, 10 + static_cast<std::uint64_t>(below(40)),
                        3 + static_cast<std::uint64_t>(below(30)));
    const bool is_heard = seed % 3 != 0;
    killed.heard_in(left, is_heard);
    const bool is_first = seed % 4 == 1;  // the robot with two processes
    const Outcome merged = run_lockstep(
        {"log", "merge", is_first ? right : left, is_first ? left : right, "--out", team});
    INFO("seed " << seed << ", start " << start << ", latency " << latency << ", killed in tick "
                 << killed.tick << " for " << killed.pause << " ticks: " << merged.err);
    REQUIRE(merged.code == 0);
    const double most = latency + 3 * Killed::kPeriod;  // off
    const std::string name = is_first ? "left" : "right";
    CHECK(std::abs(began_in(merged.err, name).seconds - (is_first ? -start : start)) <= most);
    // When each tick of the right one was, of which its own recording lacks the pause.
    std::vector<double> times;
    for (const std::string& row : lines(run_lockstep({"log", "csv", team}).out)) {
      if (!contains(row, "table/right/Carry/InStep,") || !contains(row, ",1,0,")) continue;
      times.push_back(std::stod(row.substr(row.find(',') + 1)));
    }
    REQUIRE(times.size() > killed.tick);
    double longest = 0;
    for (std::size_t i = 1; i < times.size(); ++i)
      longest = std::max(longest, times[i] - times[i - 1]);
    CHECK(std::abs(longest - static_cast<double>(killed.pause + 1) * Killed::kPeriod) <= most);
    const Outcome twice =
        run_lockstep({"log", "merge", left, right, replaced(right, ".jsonl", ".resumed-1.jsonl")});
    CHECK(contains(twice.err, "are recordings of the same run of 'right'"));
    const Outcome given = run_lockstep(
        {"log", "merge", left, right, "--offset", fmt::format("right={}", start), "-o", team});
    CHECK(given.code == 0);
    CHECK(given.err.find("by what they have heard") == std::string::npos);
  }
}

TEST_CASE("log merge: a recording that is cut, and the run of a robot that was started again") {
  const TemporaryDirectory directory;
  record_carry(directory.path("runs"), {"--latency", "0.01"});
  const std::string left = directory.path("runs/left.jsonl");
  const std::string right = read_file(directory.path("runs/right.jsonl"));
  const std::string cut = directory.file("cut.jsonl", right.substr(0, right.size() / 2));
  const Outcome merged =
      run_lockstep({"log", "merge", left, cut, "--out", directory.path("team.jsonl")});
  INFO(merged.err);
  CHECK(merged.code == 0);
  CHECK(contains(merged.err, "'right': the recording is cut: line "));
  const Outcome info = run_lockstep({"log", "info", directory.path("team.jsonl")});
  CHECK(contains(info.out, "stopped (cut) after"));
  CHECK(contains(info.out, "right: the recording is cut"));
  CHECK(contains(run_lockstep({"log", "why", directory.path("team.jsonl")}).out,
                 "the recording is cut"));
  // Whatever the other run of 'right' is.
  record_carry(directory.path("later"), {"--latency", "0.01", "--seed", "1"});
  const Outcome both =
      run_lockstep({"log", "merge", left, cut, directory.path("later/right.jsonl"), "--offset",
                    "right#2=1.5", "-o", directory.path("both.jsonl")});
  INFO(both.err);
  CHECK(both.code == 0);
  CHECK(contains(run_lockstep({"log", "info", directory.path("both.jsonl")}).out,
                 "success (completed) after"));
  const Outcome second = run_lockstep({"log", "events", directory.path("both.jsonl"), "--path",
                                       "right#2/Carry/InStep/lift", "--event", "success"});
  CHECK(contains(second.out, "2.5"));
}

TEST_CASE("log merge: what cannot be merged is refused, with what to do") {
  const TemporaryDirectory directory;
  const auto merge = [](Arguments more) {
    more.insert(more.begin(), {"log", "merge"});
    return run_lockstep(more);
  };
  record_carry(directory.path("runs"), {"--start", "0", "0.5"});
  record_carry(directory.path("apart"), {"--cut", "0..9", "--timeout", "1"});
  const std::string left = directory.path("runs/left.jsonl"),
                    right = directory.path("runs/right.jsonl");
  const Outcome same = merge({left, left});
  CHECK(same.code == 2);
  CHECK(contains(same.err, "are recordings of the same run of 'left'"));
  const Outcome apart =
      merge({directory.path("apart/left.jsonl"), directory.path("apart/right.jsonl")});
  CHECK(apart.code == 2);
  CHECK(contains(apart.err, "do not show when 'right' began: none has heard another"));
  CHECK(contains(apart.err, "--offset right=SECONDS"));
  const Outcome given =
      merge({directory.path("apart/left.jsonl"), directory.path("apart/right.jsonl"), "--offset",
             "right=-0.5", "-o", directory.path("given.jsonl")});
  CHECK(given.code == 0);
  CHECK(given.err.empty());
  CHECK(contains(read_file(directory.path("given.jsonl")), "\"time_s\":0.5,"));
  const Outcome wrong =
      merge({left, right, "--offset", "right=9", "-o", directory.path("wrong.jsonl")});
  CHECK(wrong.code == 0);
  CHECK(contains(wrong.err, "--offset right=9: by what they have heard, 'right' began 0.5"));
  for (const char* const offset : {"right", "right=x", "right=nan", "rigth=1", "left=1"}) {
    INFO(offset);
    const Outcome refused = merge({left, right, "--offset", offset});
    CHECK(refused.code == 2);
    CHECK(refused.out.empty());
  }
  const std::string alone = directory.file("alone.xml", tree_text("<Wait seconds=\"0.1\"/>"));
  run_lockstep({"run", alone, "--clock", "virtual", "--record", directory.path("alone.jsonl")});
  CHECK(contains(merge({left, directory.path("alone.jsonl")}).err, "the robot is in no team"));
  CHECK(contains(merge({left, alone}).err, "alone.xml:1: "));
  CHECK(contains(merge({left, directory.path("none.jsonl")}).err, "No such file"));
  CHECK(contains(merge({left, "-"}).err, "a recording is read twice, from a file"));
  CHECK(contains(merge({left, right, "-o", left}).err, "--out"));
  CHECK(merge({left}).code == 2);
  const std::string team = directory.path("team.jsonl");
  REQUIRE(merge({left, right, "-o", team}).code == 0);
  CHECK(contains(merge({left, team}).err, "team.jsonl: it is the recording of a team already"));
  const Outcome scenario =
      run_lockstep({"log", "scenario", team, "--save", directory.path("t.test.xml")});
  CHECK(scenario.code == 2);
  CHECK(contains(scenario.err, "hint: take the recording of one robot"));
  const std::string a = directory.file("a.xml", three_robots("a"));
  record_team(directory.path("row"), {a}, {"--timeout", "0.5"});
  CHECK(contains(merge({left, directory.path("row/a.jsonl")}).err,
                 "no other recording is of its team"));
}
