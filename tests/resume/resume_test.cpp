// Runs that a kill ends in the middle of a tick, and that go on: docs/resume.md.
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <map>

#include "support/paths.h"
#include "support/program.h"

namespace lockstep::host::test {
namespace {

// Its ticks come each 0.1 s.
class CutRun {
 public:
  explicit CutRun(const std::string& text) : tree_(directory_.file("tree.xml", text)) {}

  Outcome go(std::vector<std::string> more = {}, const std::string& cut_at = "") {
    std::vector<std::string> arguments{"run", tree_,           "--clock", "virtual",      "--rate",
                                       "10",  "--plugin-path", kPlugins,  "--checkpoint", file()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    Invocation call{.arguments = arguments, .environment = {{"LOG", log()}}};
    if (!cut_at.empty()) call.environment["CUT_AT"] = cut_at;
    return run(call);
  }
  Outcome cut(int tick, std::vector<std::string> more = {}) {
    return go(std::move(more), std::to_string(tick / 10) + "." + std::to_string(tick % 10));
  }
  Outcome resume(std::vector<std::string> more = {}) {
    more.emplace_back("--resume");
    return go(std::move(more));
  }
  std::vector<std::string> said() const { return lines(read_file(log())); }
  // Only the results, in their order.
  std::vector<std::string> results() const {
    std::vector<std::string> list;
    for (const std::string& line : said()) {
      if (line.ends_with("succeeds") || line.ends_with("fails")) list.push_back(line);
    }
    return list;
  }
  void forget() const {
    std::filesystem::remove(log());
    std::filesystem::remove(file());
  }
  std::string file() const { return directory_.path("run.checkpoint"); }
  std::string log() const { return directory_.path("log"); }
  const TemporaryDirectory& directory() const { return directory_; }
  const std::string& tree() const { return tree_; }

 private:
  static constexpr const char* kPlugins = LOCKSTEP_BINARY_DIR "/tests/cli";
  TemporaryDirectory directory_;
  const std::string tree_;
};

std::string ours(const std::string& nodes, const std::string& beside = "") {
  return "<root lockstep=\"1\">" + beside + "<plugin name=\"cut\"/><BehaviorTree ID=\"Main\">" +
         nodes + "</BehaviorTree></root>";
}

std::string theirs(const std::string& nodes) {
  return "<root BTCPP_format=\"4\"><plugin name=\"cut\"/><BehaviorTree ID=\"Main\">" + nodes +
         "</BehaviorTree></root>";
}

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// In each of them, who begins again changes no order.
const std::vector<std::string> kTrees{
    ours("<Sequence memory='true'><Step who='a' ticks='3'/><ParallelAbsolute barriers='0.5'>"
         "<Step who='b' ticks='4'/><Sequence memory='true'><Step who='c' ticks='6'/></Sequence>"
         "</ParallelAbsolute><Step who='d' ticks='2'/></Sequence>"),
    ours("<Sequence memory='true'><Script code='sum := 0; text := \"x\"'/><Repeat "
         "times='3'><Sequence memory='true'>"
         "<Step who='a' ticks='2' count='{n}'/><Script code='sum += n; text := text + \"y\"'/>"
         "</Sequence></Repeat><Step number='{sum}'/><Step who='{text}'/></Sequence>"),
    ours("<Sequence memory='true'><Script code='n := 0'/><Retry attempts='4'><Sequence "
         "memory='true'><Script code='n += 1'/>"
         "<Step number='{n}' ticks='2'/><Check code='n == 3'/></Sequence></Retry>"
         "<Wait seconds='0.5'/><Step who='end'/></Sequence>"),
    ours("<Sequence memory='true'><Parallel><UseResources pool='arm' resources='one'>"
         "<Step who='a' ticks='4'/></UseResources><UseResources pool='arm' resources='one'>"
         "<Step who='b' ticks='3'/></UseResources></Parallel><Step who='c'/></Sequence>",
         "<resources name='arm' resources='one'/>"),
    ours("<Sequence memory='true'><Fallback memory='true'><Timeout seconds='1.2'><Sequence "
         "memory='true'><Step who='a' ticks='3'/>"
         "<Step who='b' ticks='50'/></Sequence></Timeout><Step who='c' ticks='2'/></Fallback>"
         "<Step who='d'/></Sequence>"),
    theirs("<Sequence><Script code=\"n := 0; word := 'one'\"/><RetryUntilSuccessful "
           "num_attempts='5'><Sequence><Script code='n += 1'/><Step who='{n}' ticks='2'/>"
           "<ScriptCondition code='n == 3'/></Sequence></RetryUntilSuccessful>"
           "<Repeat num_cycles='2'><Delay delay_msec='200'><Step who='{word}' ticks='2' "
           "_onSuccess=\"word := 'two'\"/></Delay></Repeat><Step who='{word}'/></Sequence>")};

}  // namespace

TEST_CASE("a run that a kill ends goes on to the results that it would have had") {
  for (const std::string& text : kTrees) {
    INFO(text);
    CutRun run(text);
    const Outcome uncut = run.go();
    INFO(uncut.out << uncut.err);
    REQUIRE(uncut.code == 0);
    const auto expected = run.results();
    REQUIRE(expected.size() > 2);
    int cuts = 0;
    for (int tick = 0; tick < 25; ++tick) {
      INFO("cut at tick " << tick);
      run.forget();
      const Outcome cut = run.cut(tick);
      if (cut.code == 0) break;  // it ends before that
      REQUIRE(cut.code == 128 + SIGKILL);
      const Outcome outcome = run.resume();
      INFO(outcome.err << read_file(run.log()));
      CHECK(outcome.code == 0);
      CHECK(run.results() == expected);
      CHECK_FALSE(holds(read_file(run.log()), "before it begins"));
      CHECK_FALSE(holds(read_file(run.log()), "is halted") !=
                  (text.find("Timeout") != std::string::npos));
      ++cuts;
    }
    CHECK(cuts >= 6);
  }
}

// The trees with leaves that go on.
std::vector<std::string> moving_trees() {
  std::vector<std::string> trees = kTrees;
  for (std::string& text : trees) {
    for (auto at = text.find("<Step "); at != text.npos; at = text.find("<Step ", at + 1)) {
      text.replace(at, 6, "<Move ");
    }
  }
  return trees;
}

// What each leaf says, without the lines that only a cut makes: in the tick that is lost it may
// have said the same.
std::map<std::string, std::vector<std::string>> moves(const CutRun& run) {
  std::map<std::string, std::vector<std::string>> of;
  for (const std::string& line : run.said()) {
    auto& list = of[line.substr(0, line.find(' '))];
    const bool is_of_cut =
        line.ends_with("goes on after the cut") || line.ends_with("is still held");
    if (!is_of_cut && (list.empty() || list.back() != line)) list.push_back(line);
  }
  return of;
}

TEST_CASE("leaves that keep their state go on where they were, held or not, and begin once") {
  for (const std::string& text : moving_trees()) {
    INFO(text);
    CutRun run(text);
    REQUIRE(run.go().code == 0);
    const auto expected = moves(run);
    int cuts = 0;
    for (int tick = 0; tick < 25; ++tick) {
      INFO("cut at tick " << tick);
      run.forget();
      if (run.cut(tick).code == 0) break;
      const Outcome outcome = run.resume();
      INFO(outcome.err << read_file(run.log()));
      CHECK(outcome.code == 0);
      CHECK(moves(run) == expected);
      ++cuts;
    }
    CHECK(cuts >= 6);
  }
}

TEST_CASE("a barrier holds who is ahead until the leaf that begins again has reached it") {
  CutRun run(
      ours("<ParallelAbsolute barriers='0.5'><Step who='left' ticks='10'/>"
           "<Step who='right' ticks='20'/></ParallelAbsolute>"));
  for (int tick = 0; tick < 14; ++tick) {
    run.forget();
    REQUIRE(run.cut(tick).code == 128 + SIGKILL);
    const std::size_t before = run.said().size();
    CHECK(run.resume().code == 0);
    const auto said = run.said();
    const auto part = said.begin() + static_cast<std::ptrdiff_t>(before);
    const auto has_come = std::find(part, said.end(), "right at 0.500");
    const auto goes_on = std::find(part, said.end(), "left at 0.600");
    INFO("cut at tick " << tick << "\n" << read_file(run.log()));
    CHECK(has_come < goes_on);
    CHECK(goes_on != said.end());
  }
}

TEST_CASE("leaves that ran at the cut may have a result instead") {
  CutRun run(ours(
      "<Fallback memory='true'><Step who='a' ticks='9'/><Step who='b' ticks='2'/></Fallback>"));
  REQUIRE(run.cut(4).code == 128 + SIGKILL);
  const Outcome failed = run.resume({"--on-resume", "failure"});
  CHECK(failed.code == 0);
  CHECK(holds(failed.err, "'Main/Fallback/Step' counts as failed"));
  CHECK(run.results() == std::vector<std::string>{"b succeeds"});
  run.forget();
  REQUIRE(run.cut(4).code == 128 + SIGKILL);
  CHECK(run.resume({"--on-resume", "success"}).code == 0);
  CHECK(run.results().empty());
}

TEST_CASE("what has ended in order does not go on, and a resumed run says so") {
  CutRun run(ours(
      "<Sequence memory='true'><Step who='a' ticks='3'/><Step who='b' ticks='3'/></Sequence>"));
  CHECK(run.resume().code == 0);  // there is nothing: it begins
  const Outcome again = run.resume();
  CHECK(again.code == 0);
  CHECK_FALSE(holds(again.err, "resumed"));
  CHECK(run.results().size() == 4);
  run.forget();
  CHECK(run.go({"--max-ticks", "4"}).code == 124);
  CHECK_FALSE(holds(run.resume().err, "resumed"));
  run.forget();
  REQUIRE(run.cut(4).code == 128 + SIGKILL);
  const Outcome cut = run_lockstep({"checkpoint", run.file()});
  CHECK(holds(cut.out, "unfinished after 4 ticks, 0.300 s of the run"));
  CHECK(holds(cut.out, "Main/Sequence/Step#2 is running"));
  CHECK(holds(run_lockstep({"checkpoint", run.file(), "--json"}).out, "\"state\": \"unfinished\""));
  const std::string recording = run.directory().path("run.jsonl");
  const Outcome resumed = run.resume({"--record", recording});
  CHECK(holds(resumed.err, "resumed after "));
  CHECK(holds(resumed.err, "; 'Main/Sequence/Step#2' starts again"));
  CHECK(holds(resumed.out, "resumed after "));
  CHECK(holds(resumed.err, "; recorded in '" + recording + "'"));
  CHECK(holds(read_file(recording), "resumed after "));
  const Outcome shown = run_lockstep({"checkpoint", run.file()});
  CHECK(shown.code == 0);
  CHECK(holds(shown.out, "ended after "));
  CHECK(run_lockstep({"log", "info", recording}).code == 0);
}

// The rows of each tick, by its number.
std::map<std::string, std::vector<std::string>> recorded(const std::string& recording) {
  const Outcome csv = run_lockstep({"log", "csv", recording});
  INFO(csv.err);
  REQUIRE(csv.code == 0);
  std::map<std::string, std::vector<std::string>> ticks;
  for (const std::string& row : lines(csv.out)) ticks[row.substr(0, row.find(','))].push_back(row);
  return ticks;
}

// Those that are there are the same, each once; the last one is there.
void check_ticks(const std::map<std::string, std::vector<std::string>>& joined,
                 const std::map<std::string, std::vector<std::string>>& expected) {
  CHECK(joined.rbegin()->first == expected.rbegin()->first);
  for (const auto& [tick, rows] : joined) {
    const auto same = expected.find(tick);
    INFO("tick " << tick);
    REQUIRE(same != expected.end());
    CHECK(rows == same->second);
  }
}

TEST_CASE("the plain view of a resumed run begins with the tick that comes next") {
  CutRun run(ours("<Step who='a' ticks='9'/>"));
  REQUIRE(run.cut(4).code == 128 + SIGKILL);
  const Outcome resumed = run.resume({"--view", "plain"});
  CHECK(holds(resumed.err, "s  tick 4       resumed after "));
  CHECK(holds(resumed.err, "s  tick 4       run of Main continues, "));
  CHECK_FALSE(holds(resumed.err, "tick 0 "));
}

TEST_CASE("a recording of a run that was cut is one, with the ticks of the run without a cut") {
  const std::vector<std::vector<std::string>> forms{
      {"run.jsonl"}, {"run.jsonl.zst"}, {"run.jsonl", "--record-rotate", "0.4s"}};
  for (const std::string& text : moving_trees()) {
    for (const auto& form : forms) {
      INFO(text << form.back());
      CutRun run(text);
      const auto with = [&](const std::string& name) {
        std::vector<std::string> options{"--record", run.directory().path(name + form.front())};
        options.insert(options.end(), form.begin() + 1, form.end());
        return options;
      };
      REQUIRE(run.go(with("uncut-")).code == 0);
      const auto expected = recorded(run.directory().path("uncut-" + form.front()));
      const std::string recording = run.directory().path(form.front());
      run.forget();
      int last_code = 0, cuts = 0;
      for (const int tick : {2, 5, 6}) {
        auto options = with("");
        if (tick > 2) options.emplace_back("--resume");
        last_code = run.cut(tick, options).code;
        if (last_code == 0) break;  // it has ended before that
        REQUIRE(last_code == 128 + SIGKILL);
        ++cuts;
      }
      if (last_code != 0) REQUIRE(run.resume(with("")).code == 0);
      check_ticks(recorded(recording), expected);
      const Outcome info = run_lockstep({"log", "info", recording});
      CHECK(info.code == 0);
      CHECK(cuts >= 2);
      CHECK(holds(info.out, "resumed after "));
      const std::string last = std::to_string(expected.size() - 2);  // but the row of names
      CHECK(run_lockstep({"replay", recording, "--at", last}).code == 0);
      // As after a power failure: the file has ticks that the run did again, and whole parts of
      // them.
      const std::filesystem::path folder = std::filesystem::path(recording).parent_path();
      for (const auto& file : std::vector(std::filesystem::directory_iterator(folder), {})) {
        const std::string name = file.path().filename();
        if (!name.starts_with("uncut-")) continue;
        std::filesystem::copy_file(file.path(), folder / name.substr(6),
                                   std::filesystem::copy_options::overwrite_existing);
      }
      check_ticks(recorded(recording), expected);
      CHECK(run_lockstep({"replay", recording, "--at", last}).code == 0);
    }
  }
}

TEST_CASE("a property has the verdict of the whole run, whatever is cut") {
  CutRun run(
      ours("<Sequence memory='true'><Step name='a' who='a' ticks='3'/>"
           "<Step name='b' who='b' ticks='6'/></Sequence>",
           "<property name='in_tree'>after a.success never b.ticked</property>"));
  const auto watch = [](std::vector<std::string> more) {
    more.insert(more.end(), {"--property", "order: b.running only after a.success", "--property",
                             "pays: a.running leads to b.success"});
    return more;
  };
  const std::vector<std::string> verdicts{"in_tree: violated in tick ", "order: holds in tick",
                                          "pays: holds"};
  for (const int tick : {1, 5}) {
    run.forget();
    const Outcome killed = run.cut(tick, watch({}));
    INFO(killed.err);
    REQUIRE(killed.code == 128 + SIGKILL);
    const Outcome outcome = run.resume(watch({"--property", "fresh: never b.failure"}));
    INFO(outcome.out << outcome.err);
    for (const std::string& it : verdicts) CHECK(holds(outcome.out, "property   " + it));
    CHECK(holds(outcome.err + outcome.out,
                "the property 'fresh' was not checked before the cut: it begins here"));
    CHECK_FALSE(holds(outcome.err + outcome.out, "the property 'order' was not"));
  }
}

TEST_CASE("a resumed run leaves the recording of the run before it, and a new run begins another") {
  CutRun run(ours("<Step who='a' ticks='9'/>"));
  const std::string recording = run.directory().path("run.jsonl");
  REQUIRE(run.cut(4, {"--record", recording}).code == 128 + SIGKILL);
  const std::string before = read_file(recording);
  REQUIRE(run.cut(6, {"--record", recording, "--resume"}).code == 128 + SIGKILL);
  CHECK(run.resume({"--record", recording}).code == 0);
  CHECK(read_file(recording) == before);
  for (const std::string name : {"run.resumed-1.jsonl", "run.resumed-2.jsonl"}) {
    const Outcome part = run_lockstep({"log", "info", run.directory().path(name)});
    CHECK(part.code == 0);
    CHECK(holds(part.out, "a part that begins with tick "));
    CHECK_FALSE(holds(part.out, "rose in a period"));
    const Outcome events = run_lockstep({"log", "events", run.directory().path(name)});
    CHECK_FALSE(holds(events.out, "tick 0 "));
    CHECK_FALSE(holds(events.out, " start "));
    if (name == "run.resumed-2.jsonl")  // of the other one, no tick got to the disk
      CHECK(holds(events.out, "  log      lockstep: info: resumed after "));
  }
  // What is damaged before a cut is reported with its place, and no lost tick.
  std::ofstream(recording) << before.substr(0, before.find('\n') + 1) << "{\"tick\":0,]\n";
  const Outcome damaged = run_lockstep({"log", "info", recording});
  CHECK(damaged.code == 3);
  CHECK(holds(damaged.err, "run.jsonl:2: "));
  CHECK(run.go({"--record", recording}).code == 0);
  CHECK_FALSE(std::filesystem::exists(run.directory().path("run.resumed-1.jsonl")));
  CHECK_FALSE(std::filesystem::exists(run.directory().path("run.resumed-2.jsonl")));
  CHECK(holds(run_lockstep({"log", "info", recording}).out, "after 9 ticks"));
}

TEST_CASE("record-keep counts the files of all processes, and those deleted are no lost ticks") {
  CutRun run(ours("<Step who='a' ticks='40'/>"));
  const std::string recording = run.directory().path("run.jsonl");
  const std::vector<std::string> options{"--record", recording,       "--record-rotate",
                                         "0.4s",     "--record-keep", "3"};
  REQUIRE(run.cut(12, options).code == 128 + SIGKILL);
  auto resumed = options;
  resumed.emplace_back("--resume");
  REQUIRE(run.cut(17, resumed).code == 128 + SIGKILL);
  const auto files = [&] {
    std::size_t count = 0;
    for (const auto& it : std::filesystem::directory_iterator(run.directory().path("")))
      count += it.path().extension() == ".jsonl" ? 1 : 0;
    return count;
  };
  CHECK(files() <= 3);  // what a kill was faster than is in none
  REQUIRE(run.resume(options).code == 0);
  CHECK(files() == 3);
  const Outcome info = run_lockstep({"log", "info", recording});
  INFO(info.out << info.err);
  CHECK(info.code == 0);
  CHECK(info.err.empty());
  CHECK(holds(info.out, "a part that begins with tick 45"));
  CHECK_FALSE(holds(info.out, "missing"));
  CHECK_FALSE(holds(info.out, "resumed after "));
}

TEST_CASE("log cat --follow goes on with the run after each cut, and ends with it") {
  const std::vector<std::vector<std::string>> forms{
      {"run.jsonl"}, {"run.jsonl.zst"}, {"run.jsonl", "--record-rotate", "0.4s"}};
  for (const auto& form : forms) {
    INFO(form.front() << form.back());
    CutRun run(ours("<Step who='a' ticks='40'/>"));
    const auto path = [&](const std::string& name) { return run.directory().path(name); };
    const std::string recording = path(form.front());
    std::string options;
    for (auto it = form.begin() + 1; it != form.end(); ++it) options += " " + *it;
    // What was recorded last is awaited before the run goes on, in two other processes.
    const std::string script =
        "run() { \"$0\" run \"$1\" --clock virtual --rate 10 --plugin-path " LOCKSTEP_BINARY_DIR
        "/tests/cli --view none --checkpoint \"$2\" --record \"$3\"" +
        options +
        " --resume >/dev/null 2>&1; }\n"
        "last() { grep '^{\"tick\"' | tail -n 1; }\n"
        "await() { until [ \"$(last <\"$4\")\" = \"$(\"$0\" log cat \"$3\" 2>&1 | last)\" ]; do :; "
        "done; }\n"
        "CUT_AT=1.2 run \"$@\"\n"
        "\"$0\" log cat --follow \"$3\" >\"$4\" 2>\"$5\" & follower=$!\n"
        "await \"$@\"\n"
        "CUT_AT=1.7 run \"$@\"\n"
        "await \"$@\"\n"
        "run \"$@\"\n"
        "wait $follower\n";
    const std::string out = path("out"), err = path("err");
    const Outcome followed =
        lockstep::host::test::run({.arguments = {"-c", script, LOCKSTEP_BINARY_DIR "/lockstep",
                                                 run.tree(), run.file(), recording, out, err},
                                   .environment = {{"LOG", run.log()}},
                                   .program = "/bin/sh"});
    INFO(followed.err << read_file(err));
    CHECK(followed.code == 0);
    const Outcome all = run_lockstep({"log", "cat", recording});
    CHECK(all.code == 0);
    CHECK(read_file(out) == all.out);
    CHECK(holds(read_file(err), "note: the run was cut, and continues from tick 12 on, "));
    CHECK(holds(read_file(err), "note: the run was cut, and continues from tick 17 on, "));
  }
}

TEST_CASE("a run that is cut does not go on with other entries in its recording") {
  CutRun run(
      ours("<Sequence memory='true'><Script code='n := 0; m := 1'/>"
           "<Step number='{n}' ticks='9'/></Sequence>"));
  const std::string recording = run.directory().path("run.jsonl");
  REQUIRE(run.cut(4, {"--record", recording, "--record-entries", "n"}).code == 128 + SIGKILL);
  const std::string before = read_file(recording);
  for (const std::string entries : {"all", "none", "m", "n,m"}) {
    const Outcome other = run.resume({"--record", recording, "--record-entries", entries});
    INFO(other.err);
    CHECK(other.code == 2);
    CHECK(holds(other.err,
                "run.jsonl', the recording of the run before the cut, has other "
                "blackboard entries: 'n'"));
    CHECK(read_file(recording) == before);
  }
  // It was not lost.
  REQUIRE(run.cut(6, {"--record", recording, "--record-entries", "n", "--resume"}).code ==
          128 + SIGKILL);
  const std::string other = run.directory().path("other.jsonl");
  CHECK(run.resume({"--record", other, "--record-entries", "none"}).code == 0);
  CHECK(run_lockstep({"log", "info", recording}).code == 0);
  CHECK(run_lockstep({"log", "info", other}).code == 0);
}

TEST_CASE("a recording of a process in between that is missing is an error") {
  CutRun run(ours("<Step who='a' ticks='40'/>"));
  const std::string recording = run.directory().path("run.jsonl");
  for (const int tick : {4, 8, 12}) {
    REQUIRE(run.cut(tick, {"--record", recording, "--resume"}).code == 128 + SIGKILL);
  }
  const std::string first = run.directory().path("run.resumed-1.jsonl");
  std::filesystem::remove(first);
  const Outcome missing = run_lockstep({"log", "info", recording});
  CHECK(missing.code == 3);
  CHECK(holds(missing.err, "cannot read its part '" + first));
  // The next process does not take the name that is free.
  CHECK(run.resume({"--record", recording}).code == 0);
  CHECK(std::filesystem::exists(run.directory().path("run.resumed-3.jsonl")));
  // Without those before it is a recording that begins later.
  std::filesystem::remove(recording);
  const Outcome rest = run_lockstep({"log", "info", recording});
  CHECK(rest.code == 0);
  CHECK(holds(rest.out, "a part that begins with tick "));
}

TEST_CASE("a recording of another day is no process of a run that was cut") {
  CutRun run(ours("<Step who='a' ticks='40'/>"));
  const std::string recording = run.directory().path("run.jsonl"),
                    day = run.directory().path("run.20261128.jsonl");
  REQUIRE(run.cut(4, {"--record", day}).code == 128 + SIGKILL);
  run.forget();
  for (const int tick : {4, 8}) {
    REQUIRE(run.cut(tick, {"--record", recording, "--resume"}).code == 128 + SIGKILL);
  }
  CHECK(run.resume({"--record", recording}).code == 0);
  for (const char* const name : {"run.jsonl", "run.resumed-1.jsonl"})
    std::filesystem::remove(run.directory().path(name));
  const Outcome rest = run_lockstep({"log", "info", recording});
  INFO(rest.err);
  CHECK(rest.code == 0);
  CHECK(holds(rest.out, "a part that begins with tick "));
}

TEST_CASE("log check --leaves blames no leaf for what a cut does") {
  CutRun run(
      ours("<Parallel><Step who='a' ticks='20'/><Move who='b' ticks='20'/>"
           "<ParallelAbsolute barriers='0.3'><Step who='c' ticks='9'/><Step who='d' ticks='30'/>"
           "</ParallelAbsolute></Parallel>"));
  const std::string recording = run.directory().path("run.jsonl");
  const std::string model =
      run.directory().file("m.leaves.xml",
                           "<leaves lockstep='1' rate='10'><leaf of='Step' result='success'/>"
                           "<leaf of='Move' result='success'/></leaves>");
  REQUIRE(run.cut(6, {"--record", recording}).code == 128 + SIGKILL);
  REQUIRE(run.resume({"--record", recording}).code == 0);
  const Outcome check = run_lockstep({"log", "check", recording, "--leaves", model, "--plugin-path",
                                      LOCKSTEP_BINARY_DIR "/tests/cli"});
  INFO(check.out << check.err);
  CHECK(check.code == 0);
  CHECK_FALSE(holds(check.err, "checked as"));
  // Without the plugins of the run, mocks stand for their leaves.
  const Outcome mocked = run_lockstep({"log", "check", recording, "--leaves", model});
  CHECK(holds(mocked.err, "plugin 'cut' is not found, so 'Move', 'Step' are checked as mocks"));
}

TEST_CASE("a question that is held at a cut has an event when it is asked again, and none before") {
  CutRun run(
      ours("<ParallelAbsolute barriers='0.5'><Sequence memory='true'><AlwaysSuccess/>"
           "<Ask name='q' text='Well?' timeout='30' default='yes'/></Sequence>"
           "<Step who='a' ticks='20'/></ParallelAbsolute>"));
  const std::string recording = run.directory().path("run.jsonl");
  REQUIRE(run.go({"--record", recording}).code == 0);
  const std::string uncut = read_file(recording);
  REQUIRE(run.cut(5, {"--record", recording}).code == 128 + SIGKILL);
  CHECK(run.resume({"--record", recording}).code == 0);
  std::ofstream(recording) << uncut.substr(0, uncut.find("{\"tick\":5,"));
  const Outcome events = run_lockstep(
      {"log", "events", recording, "--path", "q", "--event", "ask", "--format", "csv"});
  const std::vector<std::string> asked = lines(events.out);
  REQUIRE(asked.size() == 3);  // with the names of the columns
  for (std::size_t i = 1; i < asked.size(); ++i) CHECK(asked[i].ends_with(",Well?"));
}

TEST_CASE("log info counts no step over ticks that were lost with a cut") {
  CutRun run(
      ours("<ParallelRelative delta='0.9'><Move who='a' ticks='20'/><Move who='b' ticks='20'/>"
           "</ParallelRelative>"));
  const std::string recording = run.directory().path("run.jsonl");
  REQUIRE(run.go({"--record", recording}).code == 0);
  const std::string uncut = read_file(recording);
  REQUIRE(run.cut(8, {"--record", recording}).code == 128 + SIGKILL);
  REQUIRE(run.resume({"--record", recording}).code == 0);
  for (const int kept : {8, 4}) {  // ticks before the cut
    INFO(kept);
    const auto end = uncut.find("{\"tick\":" + std::to_string(kept) + ",");
    REQUIRE(end != std::string::npos);
    std::ofstream(recording) << uncut.substr(0, end);
    const Outcome info = run_lockstep({"log", "info", recording});
    CHECK(holds(info.out, "4 ticks are missing") == (kept == 4));
    CHECK(holds(info.out, "longest step 0.05\n"));
  }
}

TEST_CASE("verify --cuts finds an action with commit that may be done twice") {
  const TemporaryDirectory directory;
  const auto verify = [&](const std::string& leaf, const std::string& row, bool cuts = true) {
    std::vector<std::string> arguments{
        "verify",
        directory.file("tree.xml", ours(leaf)),
        "--leaves",
        directory.file("tree.leaves.xml", "<leaves lockstep='1' rate='10'>" + row + "</leaves>"),
        "--plugin-path",
        LOCKSTEP_BINARY_DIR "/tests/cli",
        "--out",
        directory.path("findings")};
    if (cuts) arguments.emplace_back("--cuts");
    return run_lockstep(arguments);
  };
  const std::string succeeds = "<leaf path='*' result='success' ticks='3'/>";
  const Outcome found = verify("<Step commit='true'/>", succeeds);
  INFO(found.out << found.err);
  CHECK(found.code == 1);
  CHECK(holds(found.out, "finding done-twice/Main/Step: "));
  // Its third tick may be the last one, so the cut is before that at the earliest.
  CHECK(holds(read_file(directory.path("findings/tree.done-twice.Main.Step.leaves")), "@cut 2"));
  const Outcome both =
      verify("<Parallel><Step commit='true' name='a'/><Step commit='true' name='b'/></Parallel>",
             succeeds);
  CHECK(holds(both.out, "done-twice/Main/Parallel/a"));
  CHECK(holds(both.out, "done-twice/Main/Parallel/b"));
  CHECK(verify("<Step commit='true'/>", succeeds, false).code == 0);
  CHECK(verify("<Step/>", succeeds).code == 0);
  CHECK(verify("<Step commit='true' on_resume='failure'/>", succeeds).code == 0);
  CHECK(verify("<Step commit='true'/>", "<leaf path='*' result='failure' ticks='3'/>").code == 0);
  // One that keeps its state knows whether it has succeeded.
  CHECK(verify("<Move commit='true'/>", succeeds).code == 0);
  // A held one does nothing in the tick that is lost.
  CHECK_FALSE(holds(verify("<ParallelAbsolute barriers='0.5'><Step commit='true'/><Step name='b'/>"
                           "</ParallelAbsolute>",
                           "<leaf of='Step' result='success' ticks='1'/>")
                        .out,
                    "done-twice"));
}

TEST_CASE("a run does not go on with another tree, nor from what is no checkpoint") {
  CutRun run(ours("<Sequence memory='true'><Step who='a' ticks='${n}'/></Sequence>",
                  "<arg name='n' default='6'/>"));
  REQUIRE(run.cut(3).code == 128 + SIGKILL);
  const Outcome other = run.resume({"--arg", "n=7"});
  CHECK(other.code == 3);
  CHECK(holds(other.err, "the argument 'n' was '6' and is '7'"));
  const std::string text = read_file(run.tree());
  std::ofstream(run.tree()) << text << "<!-- -->";
  const Outcome changed = run.resume();
  CHECK(changed.code == 3);
  CHECK(holds(changed.err, "the text of 'the main file' was "));
  std::ofstream(run.tree()) << text;
  CHECK(run.resume().code == 0);

  std::ofstream(run.file()) << "a diary";
  const Outcome diary = run.go();
  CHECK(diary.code == 2);
  CHECK(read_file(run.file()) == "a diary");
  CHECK(run.resume().code == 2);
  std::filesystem::remove(run.file());
  std::filesystem::create_symlink(run.directory().path("other"), run.file());
  CHECK(run.go().code == 2);
  std::filesystem::remove(run.file());
  std::filesystem::create_directory(run.file());
  CHECK(run.go().code == 2);
}

TEST_CASE("a leaf that ends the process at its start does not do so for ever") {
  CutRun run(ours(
      "<Sequence memory='true'><Step who='a' ticks='3'/><Step who='b' ticks='9'/></Sequence>"));
  REQUIRE(run.cut(2).code == 128 + SIGKILL);
  for (int again = 0; again < 2; ++again) {
    REQUIRE(run.cut(0, {"--resume", "--resume-limit", "2"}).code == 128 + SIGKILL);
  }
  const Outcome given_up = run.resume({"--resume-limit", "2"});
  CHECK(given_up.code == 5);
  CHECK(holds(given_up.err, "was resumed 2 times in a row"));
  CHECK(run.resume({"--resume-limit", "2"}).code == 5);
  // A leaf that completes: the count begins anew.
  REQUIRE(run.cut(8, {"--resume"}).code == 128 + SIGKILL);
  CHECK(run.resume({"--resume-limit", "1"}).code == 0);
}

}  // namespace lockstep::host::test
