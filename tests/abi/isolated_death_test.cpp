// Plugins in processes of their own: whatever becomes of such a process, its leaves have a fault
// and nothing else happens.
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "abi/support/isolated_leaves.h"

namespace lockstep::host::test {
namespace {

struct Death {
  const char* how;
  const char* error;
};
const Death kDeaths[] = {
    {"segv", "its process was killed by SIGSEGV (Segmentation fault)"},
    {"abort", "its process was killed by SIGABRT (Aborted)"},
    {"exit", "its process ended with exit code 3"},
    {"_exit", "its process ended with exit code 4"},
};

struct Step {
  const char* name;
  void (*call)(LeafSlot& slot);
};
const Step kSteps[] = {
    {"start", [](LeafSlot& slot) { slot.type->start(slot.self); }},
    {"tick", [](LeafSlot& slot) { slot.type->tick(slot.self); }},
    {"progress", [](LeafSlot& slot) { slot.type->progress(slot.self); }},
    {"halt", [](LeafSlot& slot) { slot.type->halt(slot.self); }},
};

TEST_CASE("isolated: a process that dies in a call is an error of the leaf, and is reported") {
  const NothingRemains nothing_remains;
  for (const Death& death : kDeaths) {
    for (const Step& step : kSteps) {
      INFO(death.how << " in " << step.name);
      Leaves leaves("crash", {crash_in(step.name, death.how)});
      REQUIRE_FALSE(leaves.set->fault());
      for (const Step& before : kSteps) {
        if (&before == &step) break;
        CHECK(leaves.error_of(0, before.call).empty());
      }
      CHECK(leaves.error_of(0, step.call) == death.error);
      CHECK(leaves.log == Strings{"Test/leaf0: create"});
    }
  }
}

// What this process and its children write to standard error in between.
class StandardError {
 public:
  StandardError() : file_(std::tmpfile()), before_(dup(STDERR_FILENO)) {
    dup2(fileno(file_), STDERR_FILENO);
  }
  ~StandardError() {
    dup2(before_, STDERR_FILENO);
    close(before_);
    std::fclose(file_);
  }
  StandardError(const StandardError&) = delete;
  StandardError& operator=(const StandardError&) = delete;
  std::string text() {
    std::string text(1 << 16, '\0');
    const auto size = pread(fileno(file_), text.data(), text.size(), 0);
    text.resize(size < 0 ? 0 : static_cast<std::size_t>(size));
    return text;
  }

 private:
  std::FILE* file_;
  int before_;
};

TEST_CASE("isolated: a process that crashes says where, and dies as it would have") {
  const NothingRemains nothing_remains;
  for (const char* how : {"raise", "overflow"}) {
    INFO(how);
    std::string report;
    {
      StandardError error;
      Leaves leaves("crash", {crash_in("tick", how)});
      CHECK(leaves.tick() == "its process was killed by SIGSEGV (Segmentation fault)");
      report = error.text();
    }
    INFO(report);
    CHECK(report.find("the leaf 'Test/leaf0' (Crash of plugin 'crash') crashed in its tick") !=
          std::string::npos);
    CHECK(report.find("--isolate") == std::string::npos);  // it is
    CHECK(report.find("crash.so") != std::string::npos);
  }
}

TEST_CASE("isolated: a process that does not return is killed after the limit") {
  const NothingRemains nothing_remains;
  for (const Step& step : kSteps) {
    Leaves leaves("crash", {crash_in(step.name, "hang")}, Isolation::Isolated, kShortLimit);
    CHECK(leaves.error_of(0, step.call) ==
          fmt::format("did not return from {} for 0.2 s; its process was killed", step.name));
  }
}

TEST_CASE("isolated: a leaf whose creation kills its process could not be created") {
  const NothingRemains nothing_remains;
  const Leaves crashed("crash", {crash_in("create", "segv")});
  REQUIRE(crashed.set->fault());
  CHECK(crashed.set->fault()->message ==
        "could not be created: its process was killed by SIGSEGV (Segmentation fault)");
  const Leaves hung("crash", {kNoCrash, crash_in("create", "hang")}, Isolation::Isolated,
                    kShortLimit);
  REQUIRE(hung.set->fault());
  CHECK(hung.set->fault()->node == 1);
  CHECK(hung.set->fault()->message ==
        "could not be created: did not return from create for 0.2 s; its process was killed");
}

TEST_CASE("isolated: the end of a leaf that kills its process is a line in the log") {
  const NothingRemains nothing_remains;
  Leaves leaves("crash", {crash_in("destroy", "segv")});
  leaves.set->destroy_all();
  CHECK(
      leaves.log ==
      Strings{
          "Test/leaf0: create",
          "Test/leaf0: its destroy did not return: its process was killed by SIGSEGV (Segmentation "
          "fault)"});
}

TEST_CASE("isolated: the other leaves of a process that is gone know why and are not halted") {
  const NothingRemains nothing_remains;
  Leaves leaves("crash", {crash_in("tick", "segv"), kNoCrash});
  CHECK(leaves.tick(1).empty());
  CHECK(leaves.tick(0) == "its process was killed by SIGSEGV (Segmentation fault)");
  const std::string gone =
      "its process is gone: it was killed by SIGSEGV (Segmentation fault) in tick of 'Test/leaf0'";
  CHECK(leaves.tick(1) == gone);
  CHECK(leaves.tick(0) == gone);
  CHECK(leaves.error_of(1, kSteps[0].call) == gone);
  CHECK(leaves.error_of(1, kSteps[3].call).empty());
  leaves.set->destroy_all();
  CHECK(leaves.log == Strings{"Test/leaf0: create", "Test/leaf1: create"});
}

TEST_CASE("isolated: a process that somebody kills between two calls is gone") {
  const NothingRemains nothing_remains;
  Leaves leaves("echo", {{}});
  CHECK(leaves.tick().empty());
  kill(static_cast<pid_t>(leaves.get<std::int64_t>(kProcess)), SIGKILL);
  const std::string error = leaves.tick();
  // The one when it is known before the call, the other when the call finds out.
  CHECK((error == "its process is gone: it was killed by SIGKILL (Killed)" ||
         error == "its process was killed by SIGKILL (Killed)"));
}

// Whether the process, of whomever it is the child, is gone soon.
bool is_ending(pid_t process) {
  const int descriptor = static_cast<int>(syscall(SYS_pidfd_open, process, 0));
  if (descriptor < 0) return errno == ESRCH;
  pollfd end{descriptor, POLLIN, 0};
  const bool ended = poll(&end, 1, 20'000) == 1;
  close(descriptor);
  return ended;
}

// What 'crash' logs of the process that it has started: "Test/leaf0: 4711 4710", the other is its
// own.
struct Family {
  pid_t offspring = 0, leafhost = 0;
  explicit Family(const std::string& line) {
    std::istringstream(line.substr(line.find(": ") + 2)) >> offspring >> leafhost;
    REQUIRE(leafhost > 0);
  }
};

TEST_CASE("isolated: what a plugin has started ends with its process") {
  const NothingRemains nothing_remains;
  pid_t offspring = 0;
  {
    Leaves leaves("crash", {crash_in("tick", "fork")});
    CHECK(leaves.tick().empty());
    REQUIRE(leaves.log.size() == 2);
    offspring = Family(leaves.log[1]).offspring;
    REQUIRE(kill(offspring, 0) == 0);
  }
  CHECK(is_ending(offspring));
}

TEST_CASE("isolated: a process that has left its group is killed as well, and nobody else is") {
  const NothingRemains nothing_remains;
  // We are the host, and of the group that it joins.
  Leaves leaves("crash", {crash_in("tick", "join the host")}, Isolation::Isolated, kShortLimit);
  CHECK(leaves.tick() == "did not return from tick for 0.2 s; its process was killed");
}

// Whether the process does already what 'crash' calls so.
bool has_begun(const std::string& how, pid_t process) {
  const std::string directory = fmt::format("/proc/{}/", process);
  if (how == "close") return fs::is_empty(directory + "fd");
  if (how == "join the host") return getpgid(process) == getpgrp();
  if (how != "stop") return true;
  std::ifstream file(directory + "stat");
  std::string number, name, state;
  file >> number >> name >> state;
  return state == "T";
}

constexpr const char* kDoomed = "isolated: a host that is about to be killed";

// Not a test: the program that the next ones run. Its last leaf does what LOCKSTEP_TEST_LAST says;
// beside it a process lives on that has all its descriptors.
TEST_CASE("isolated: a host that is about to be killed", "[.]") {
  if (std::getenv("LOCKSTEP_TEST_DOOMED") == nullptr) return;
  const char* const last = std::getenv("LOCKSTEP_TEST_LAST");
  Leaves leaves("crash", {crash_in("tick", "fork"), crash_in("tick", last)}, Isolation::Isolated,
                std::chrono::seconds(100));
  leaves.tick(0);
  const pid_t holder = fork();
  while (holder == 0) pause();
  const Family family(leaves.log.back());
  std::ofstream(std::getenv("LOCKSTEP_TEST_DOOMED"))
      << family.offspring << ' ' << family.leafhost << ' ' << holder << std::flush;
  std::thread([last, leafhost = family.leafhost] {
    while (!has_begun(last, leafhost)) std::this_thread::yield();
    kill(getpid(), SIGKILL);
  }).detach();
  leaves.tick(1);
  pause();
}

// Runs that program in this process group until its end.
void run_doomed(const std::string& path, const char* last) {
  std::string name = "/proc/self/exe", test = kDoomed;
  std::string where = "LOCKSTEP_TEST_DOOMED=" + path;
  std::string how = fmt::format("LOCKSTEP_TEST_LAST={}", last);
  std::vector<char*> variables{where.data(), how.data()};
  for (char** it = environ; *it != nullptr; ++it) variables.push_back(*it);
  variables.push_back(nullptr);
  char* arguments[] = {name.data(), test.data(), nullptr};
  pid_t host = 0;
  REQUIRE(posix_spawn(&host, name.c_str(), nullptr, nullptr, arguments, variables.data()) == 0);
  int status = 0;
  REQUIRE(waitpid(host, &status, 0) == host);
  CHECK((WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL));
}

TEST_CASE("isolated: nothing outlives a host that is killed") {
  // Without us the kernel would wake a process that is stopped when nobody is left who could.
  REQUIRE(prctl(PR_SET_CHILD_SUBREAPER, 1) == 0);
  for (const char* last : {"hang", "stop", "close", "join the host"}) {
    INFO(last);
    const std::string path = fmt::format("{}/doomed_{}", LOCKSTEP_ABI_PLUGINS, getpid());
    run_doomed(path, last);
    pid_t offspring = 0, leafhost = 0, holder = 0;
    std::ifstream(path) >> offspring >> leafhost >> holder;
    fs::remove(path);
    REQUIRE(holder > 0);
    CHECK(is_ending(offspring));  // it is of the group of its process
    CHECK(is_ending(leafhost));
    CHECK(kill(holder, SIGKILL) == 0);
    for (const pid_t process : {offspring, leafhost, holder}) waitpid(process, nullptr, 0);
  }
  REQUIRE(prctl(PR_SET_CHILD_SUBREAPER, 0) == 0);
}

TEST_CASE("isolated: a run that begins anew after a crash has a new process") {
  const NothingRemains nothing_remains;
  Leaves leaves("echo", {{}});
  CHECK(leaves.tick().empty());
  const auto first = leaves.get<std::int64_t>(kProcess);
  leaves.set->destroy_all();
  leaves.set->create_all(7);
  CHECK(leaves.tick().empty());
  CHECK(leaves.get<std::int64_t>(kProcess) == first);

  kill(static_cast<pid_t>(first), SIGKILL);
  CHECK_FALSE(leaves.tick().empty());
  leaves.set->destroy_all();
  leaves.set->create_all(7);
  CHECK(leaves.tick().empty());
  CHECK(leaves.get<std::int64_t>(kProcess) != first);
}

TEST_CASE("isolated: what a plugin does while it is loaded or initialized is a refusal") {
  const NothingRemains nothing_remains;
  const auto said = [](const std::string& plugin, Nanoseconds hang_limit = kLongLimit) {
    PluginSet plugins;
    set_isolation(plugins, Isolation::Isolated, hang_limit);
    Diagnostics diagnostics;
    if (plugins.load_file(plugin_path(plugin), diagnostics)) plugins.initialize(diagnostics);
    return diagnostics.all().size() == 1 ? diagnostics.all()[0].message : "";
  };
  const auto message = [](const std::string& plugin, const char* text) {
    return fmt::format("plugin '{}' {}", plugin_path(plugin), text);
  };
  CHECK(said("crash_load") ==
        message("crash_load",
                "cannot be loaded: its process was killed by SIGSEGV (Segmentation fault)"));
  CHECK(said("hang_load", kShortLimit) ==
        message("hang_load",
                "cannot be loaded: it did not return from load for 0.2 s; its process "
                "was killed"));
  CHECK(said("crash_init") ==
        message("crash_init", "does not survive its init: its process ended with exit code 3"));
}

TEST_CASE("isolated: without lockstep-leafhost the plugin is refused") {
  PluginSet plugins;
  plugins.set_isolation({.leafhost = "/nowhere/lockstep-leafhost", .all = true});
  Diagnostics diagnostics;
  CHECK_FALSE(plugins.load_file(plugin_path("good"), diagnostics));
  REQUIRE(diagnostics.all().size() == 1);
  CHECK(diagnostics.all()[0].message ==
        "plugin '" + plugin_path("good") +
            "' cannot be isolated: '/nowhere/lockstep-leafhost' does not start: No such file or "
            "directory");
}

TEST_CASE("isolated: a plugin is loaded once, as the first one asked for it") {
  for (const Isolation first : {Isolation::InProcess, Isolation::Isolated}) {
    const bool isolated = first == Isolation::Isolated;
    PluginSet plugins;
    set_isolation(plugins, Isolation::InProcess);
    Diagnostics diagnostics;
    CHECK(plugins.load_file(plugin_path("good"), diagnostics, {}, first));
    CHECK(plugins.load_file(plugin_path("../plugins/good"), diagnostics, {},
                            isolated ? Isolation::InProcess : Isolation::Isolated));
    REQUIRE(plugins.list().size() == 1);
    CHECK(plugins.list()[0].isolated == isolated);
    CHECK(plugins.list()[0].name == "good");
    CHECK(plugins.list()[0].version == "1.0.0");
    CHECK(plugins.list()[0].doc == "for tests");
  }
}

}  // namespace
}  // namespace lockstep::host::test
