// Leaves that do not come back: named, and ended after --hang-limit; a halt is named after
// --halt-limit. These wait for real time, as little of it as there can be.
#include <signal.h>

#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "reliability/hostile_tree.h"
#include "support/json.h"

namespace lockstep::host::test {
namespace {

using nlohmann::json;
using Strings = std::vector<std::string>;

const Strings kShort = {"--clock", "virtual", "--hang-limit", "0.2", "--halt-limit", "2"};

Strings with(const Strings& more) {
  Strings options = kShort;
  options.insert(options.end(), more.begin(), more.end());
  return options;
}

}  // namespace

TEST_CASE("a leaf that never returns ends the program, by name, or only its own process") {
  for (const std::string where : {"create", "start", "tick", "progress", "halt", "destroy"}) {
    INFO(where);
    const Outcome in_process = run_hostile({"hang", where}, Where::InProcess, kShort);
    INFO(in_process.err);
    CHECK(in_process.code == 6);
    CHECK(contains(in_process.err, "arm' (Misbehave of plugin 'hostile')"));
    CHECK(contains(in_process.err, "has not returned from "));
    CHECK(contains(in_process.err, where));
    CHECK(contains(in_process.err, "backtrace"));

    const Outcome isolated = run_hostile({"hang", where}, Where::Isolated, kShort);
    INFO(isolated.err);
    if (where == "destroy") {
      CHECK(isolated.code == 0);  // the tree is through
    } else {
      CHECK(isolated.code == 5);
      CHECK(contains(isolated.err, "did not return from " + where));
    }
  }
}

TEST_CASE("an isolated leaf that hangs can be a Failure") {
  for (const std::string where : {"start", "tick", "progress", "halt"}) {
    INFO(where);
    const Outcome outcome =
        run_hostile({"hang", where}, Where::Isolated, with({"--on-fault", "fail", "--json"}));
    INFO(outcome.err);
    CHECK(outcome.code == 0);
    CHECK(parse_json(outcome.out)["faults"] == 1);
  }
}

TEST_CASE("a leaf that hangs with all signals blocked is found as well") {
  const Outcome outcome = run_hostile({"hang deaf"}, Where::InProcess, kShort);
  CHECK(outcome.code == 6);
  CHECK(contains(outcome.err, "has not returned from tick 0"));
}

TEST_CASE("a halt that does not return in time is named, if it returns late, the run goes on") {
  for (const Where where : {Where::InProcess, Where::Isolated}) {
    const Outcome outcome =
        run_hostile({"late", "halt"}, where,
                    {"--clock", "virtual", "--hang-limit", "5", "--halt-limit", "0.05"});
    INFO(outcome.err);
    CHECK(outcome.code == 0);
    CHECK(contains(outcome.err, "arm' (Misbehave of plugin 'hostile') has not returned from halt"));
  }
}

TEST_CASE("time in which the program is stopped counts as nobody's hang") {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  constexpr const char *kLimit = "4", *kTwice = "8";  // a program takes half a second to begin
#else
  constexpr const char *kLimit = "0.4", *kTwice = "1";
#endif
  for (const Where where : {Where::InProcess, Where::Isolated}) {
    const OwnPlugin plugin;
    const TemporaryDirectory directory;
    const std::string how = where == Where::InProcess ? "stop" : "stop with the host";
    Strings arguments = {"run",          directory.file("tree.xml", hostile_tree({how})),
                         "--plugin",     plugin.directory() + "hostile.so",
                         "--clock",      "virtual",
                         "--hang-limit", kLimit};
    if (where == Where::Isolated) arguments.emplace_back("--isolate");
    Process process({.arguments = arguments});
    process.wait_for_stop();
    const std::string wait =
        directory.file("wait.xml", tree_text(fmt::format("<Wait seconds=\"{}\"/>", kTwice)));
    CHECK(run_lockstep({"run", wait}).code == 0);
    process.signal(SIGCONT);
    run_lockstep({"--version"});  // the other process goes on a moment later
    for (const pid_t leafhost : plugin.processes()) kill(leafhost, SIGCONT);
    const Outcome outcome = process.finish();
    INFO(outcome.err);
    CHECK(outcome.code == 0);
  }
}

TEST_CASE("a plugin that refuses to finish does not keep the program from ending") {
  const std::map<std::string, std::string> environment = {{"HOSTILE_DEINIT", "hang"}};
  const Outcome in_process = run_hostile({""}, Where::InProcess, with({"--json"}), environment);
  CHECK(in_process.code == 6);
  CHECK(contains(in_process.err, "deinit"));
  CHECK(parse_json(in_process.out)["result"] == "success");  // what was to be told has been told

  const Outcome isolated = run_hostile({""}, Where::Isolated, with({"--json"}), environment);
  CHECK(isolated.code == 0);
  CHECK(parse_json(isolated.out)["result"] == "success");
}

TEST_CASE("a plugin that crashes or hangs in init is named") {
  for (const std::string how : {"segv", "hang"}) {
    const std::map<std::string, std::string> environment = {{"HOSTILE_INIT", how}};
    const Outcome in_process = run_hostile({""}, Where::InProcess, kShort, environment);
    INFO(in_process.err);
    CHECK(in_process.code == 6);
    CHECK(contains(in_process.err, "plugin 'hostile'"));
    CHECK(contains(in_process.err, "init"));
    const Outcome isolated = run_hostile({""}, Where::Isolated, kShort, environment);
    INFO(isolated.err);
    CHECK(isolated.code == 4);
    CHECK(contains(isolated.err, how == "segv" ? "killed by SIGSEGV" : "did not return from init"));
  }
}

}  // namespace lockstep::host::test
