// Plugins in processes of their own: whatever becomes of such a process, its leaves have a fault
// and nothing else happens; and as long as it lives, nobody can tell it from this one.
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cerrno>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <mutex>
#include <thread>

#include "abi/support/plugins.h"
#include "runtime/run.h"

namespace lockstep::test {
namespace {

namespace fs = std::filesystem;
using Strings = std::vector<std::string>;

constexpr Nanoseconds kShortLimit = std::chrono::milliseconds(200);  // where it is to be reached
constexpr Nanoseconds kLongLimit = std::chrono::seconds(20);

std::ptrdiff_t entries_in(const char* directory) {
  return std::distance(fs::directory_iterator(directory), fs::directory_iterator());
}

// What must be as before when everything is over.
struct Belongings {
  std::ptrdiff_t descriptors = entries_in("/proc/self/fd");
  std::ptrdiff_t threads = entries_in("/proc/self/task");
};

bool has_child() {
  siginfo_t info{};
  return waitid(P_ALL, 0, &info, WEXITED | WNOHANG | WNOWAIT) == 0 || errno != ECHILD;
}

// Checks at its end that nothing was left behind.
struct NothingRemains {
  // The first thread of a sanitizer's own comes with the first thread of ours.
  NothingRemains() {
    std::thread([] {}).join();
    before = Belongings();
  }
  ~NothingRemains() {
    CHECK_FALSE(has_child());
    // A thread that was joined is listed until the kernel has cleaned up behind it.
    const auto patience = std::chrono::steady_clock::now() + kLongLimit;
    while (Belongings().threads > before.threads && std::chrono::steady_clock::now() < patience) {
      std::this_thread::yield();
    }
    const Belongings after;
    CHECK(after.threads <= before.threads);
    CHECK(after.descriptors == before.descriptors);
  }
  NothingRemains(const NothingRemains&) = delete;
  NothingRemains& operator=(const NothingRemains&) = delete;
  Belongings before;
};

// As many leaves of a type as there are rows; a row gives constants to the first ports, the others
// are bound to the slot of their place. All leaves share the slots. For LeafSet only, unless there
// is one leaf.
Tree leaves_of(const NodeType& type, const std::vector<std::vector<Value>>& rows) {
  Tree tree;
  tree.id = "Test";
  for (const Parameter& port : type.parameters) {
    tree.slots.push_back({std::string(port.name), port.type, {}});
  }
  for (const auto& row : rows) {
    const auto node = static_cast<NodeIndex>(tree.nodes.size());
    tree.nodes.push_back(Node{&kPluginAction, node + 1, 0, node, 0});
    static constexpr std::string_view kNames[] = {"leaf0", "leaf1"};
    NodeLabel& label = tree.labels.emplace_back();
    label.name = kNames[node];
    label.type = &type;
    label.parent = node;
    tree.leaves.push_back(LeafNode{node, &type, static_cast<std::uint32_t>(tree.ports.size())});
    for (std::uint32_t port = 0; port < type.parameters.size(); ++port) {
      if (port >= row.size()) {
        tree.ports.push_back(PortBinding{.slot = port});
        continue;
      }
      tree.ports.push_back(
          PortBinding{.constant = static_cast<std::uint32_t>(tree.constants.size())});
      tree.constants.push_back(row[port]);
    }
  }
  return tree;
}

std::vector<Value> crash_in(const char* function, const char* how) {
  return {std::string(function), std::string(how)};
}
const std::vector<Value> kNoCrash = crash_in("", "");

// Leaves of one plugin, called as the engine would.
struct Leaves {
  Leaves(const std::string& plugin, const std::vector<std::vector<Value>>& rows,
         Isolation isolation = Isolation::Isolated, Nanoseconds hang_limit = kLongLimit) {
    set_isolation(plugins, isolation, hang_limit);
    Diagnostics diagnostics;
    REQUIRE(plugins.load_file(plugin_path(plugin), diagnostics));
    REQUIRE(plugins.initialize(diagnostics));
    tree = leaves_of(*plugins.types().at(0), rows);
    blackboard.emplace(tree);
    set.emplace(tree, *blackboard, time, 7,
                [this](std::string_view who, lockstep_log_level, std::string_view text) {
                  const std::lock_guard lock(mutex);
                  log.push_back(fmt::format("{}: {}", who, text));
                  logged.notify_all();
                });
  }

  // "" or the error that the call has set.
  std::string error_of(std::size_t leaf, void (*function)(LeafSlot&)) {
    LeafSlot& slot = set->slots()[leaf];
    function(slot);
    const char* const error = std::exchange(slot.error, nullptr);
    return error == nullptr ? "" : error;
  }
  std::string tick(std::size_t leaf = 0) {
    return error_of(leaf, [](LeafSlot& slot) { slot.type->tick(slot.self); });
  }
  Value& value(std::size_t slot) { return blackboard->values[slot]; }
  template <class T>
  T get(std::size_t slot) {
    return std::get<T>(value(slot));
  }

  PluginSet plugins;
  Tree tree;
  std::optional<Blackboard> blackboard;
  LeafTime time{std::chrono::seconds(2), std::chrono::milliseconds(10)};
  std::mutex mutex;
  std::condition_variable logged;
  Strings log;
  std::optional<LeafSet> set;
};

// The ports of 'echo', which are its slots too.
enum EchoPort : std::size_t {
  kBoolIn,
  kIntIn,
  kDoubleIn,
  kStringIn,
  kListIn,
  kBoolOut,
  kIntOut,
  kDoubleOut,
  kStringOut,
  kListOut,
  kRandom,
  kProcess,
  kSeen,
  kSpeak,
  kGrow
};

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

TEST_CASE("isolated: a process that dies in a call is an error of the leaf, and is told") {
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

TEST_CASE("isolated: what a plugin has started ends with its process") {
  const NothingRemains nothing_remains;
  pid_t offspring = 0;
  {
    Leaves leaves("crash", {crash_in("tick", "fork")});
    CHECK(leaves.tick().empty());
    REQUIRE(leaves.log.size() == 2);
    offspring = std::stoi(leaves.log[1].substr(leaves.log[1].find(' ')));
    REQUIRE(kill(offspring, 0) == 0);
  }
  CHECK(is_ending(offspring));
}

constexpr const char* kDoomed = "isolated: a host that is about to be killed";

// Not a test: the program that the next one runs.
TEST_CASE("isolated: a host that is about to be killed", "[.]") {
  if (std::getenv("LOCKSTEP_TEST_DOOMED") == nullptr) return;
  Leaves leaves("crash", {crash_in("tick", "fork"), crash_in("tick", "hang")}, Isolation::Isolated,
                std::chrono::seconds(100));
  leaves.tick(0);
  std::ofstream(std::getenv("LOCKSTEP_TEST_DOOMED")) << leaves.log.back().substr(13) << std::flush;
  std::thread([] { kill(getpid(), SIGKILL); }).detach();
  leaves.tick(1);
}

TEST_CASE("isolated: nothing outlives a host that is killed") {
  const std::string path = fmt::format("{}/doomed_{}", LOCKSTEP_ABI_PLUGINS, getpid());
  const std::string variable = "LOCKSTEP_TEST_DOOMED=" + path;
  std::string name = "/proc/self/exe", test = kDoomed, variable_text = variable;
  std::vector<char*> variables{variable_text.data()};
  for (char** it = environ; *it != nullptr; ++it) variables.push_back(*it);
  variables.push_back(nullptr);
  char* arguments[] = {name.data(), test.data(), nullptr};
  pid_t host = 0;
  REQUIRE(posix_spawn(&host, name.c_str(), nullptr, nullptr, arguments, variables.data()) == 0);
  int status = 0;
  REQUIRE(waitpid(host, &status, 0) == host);
  CHECK((WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL));
  pid_t offspring = 0;
  std::ifstream(path) >> offspring;
  fs::remove(path);
  REQUIRE(offspring > 0);
  CHECK(is_ending(offspring));  // it is of the group of its process
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

TEST_CASE("isolated: the node types are those of the plugin in this process") {
  PluginSet here, there;
  Diagnostics diagnostics;
  set_isolation(there, Isolation::Isolated);
  REQUIRE(there.load_file(plugin_path("echo"), diagnostics));
  REQUIRE(here.load_file(plugin_path("echo"), diagnostics));
  REQUIRE(here.types().size() == there.types().size());
  const NodeType& one = *here.types()[0];
  const NodeType& other = *there.types()[0];
  CHECK((one.id == other.id && one.category == other.category && one.doc == other.doc));
  CHECK((one.plugin == other.plugin && one.has_progress == other.has_progress));
  REQUIRE(one.parameters.size() == other.parameters.size());
  for (std::size_t port = 0; port < one.parameters.size(); ++port) {
    const Parameter& a = one.parameters[port];
    const Parameter& b = other.parameters[port];
    CHECK((a.name == b.name && a.type == b.type && a.doc == b.doc && a.unit == b.unit));
    CHECK((a.default_text == b.default_text && a.required == b.required));
    CHECK(a.direction == b.direction);
  }
}

TEST_CASE("isolated: values of every type go in and out, also large ones") {
  const NothingRemains nothing_remains;
  Leaves leaves("echo", {{}});
  CHECK(leaves.tick().empty());
  CHECK(leaves.value(kStringOut).index() == 0);  // nothing came in

  leaves.value(kBoolIn) = true;
  leaves.value(kIntIn) = INT64_MIN;
  leaves.value(kDoubleIn) = -0.125;
  for (const std::size_t size : {std::size_t{0}, std::size_t{3}, std::size_t{1} << 20}) {
    std::string text(size, 'a');
    if (size == 3) text[1] = '\0';
    const std::vector<double> list(size, 1.5);
    leaves.value(kStringIn) = text;
    leaves.value(kListIn) = list;
    CHECK(leaves.tick().empty());
    CHECK((leaves.get<std::string>(kStringOut) == text));
    CHECK((leaves.get<std::vector<double>>(kListOut) == list));
  }
  CHECK(leaves.get<bool>(kBoolOut));
  CHECK(leaves.get<std::int64_t>(kIntOut) == INT64_MIN);
  CHECK(leaves.get<double>(kDoubleOut) == -0.125);
}

TEST_CASE("isolated: values that are too large are an error, and the process lives on") {
  Leaves leaves("echo", {{}});
  const std::string error =
      "the values of its ports are larger than the 64 MiB that an isolated plugin can exchange in "
      "a call";
  leaves.value(kStringIn) = std::string(std::size_t{65} << 20, 'x');
  CHECK(leaves.tick() == error);
  leaves.value(kStringIn) = std::string("small");
  leaves.value(kGrow) = std::int64_t{65} << 20;
  CHECK(leaves.tick() == error);
  leaves.value(kGrow) = std::int64_t{0};
  CHECK(leaves.tick().empty());
  CHECK(leaves.get<std::string>(kStringOut) == "small");
}

TEST_CASE("isolated: ports of one entry are one, for a leaf and between leaves") {
  for (const Isolation isolation : {Isolation::InProcess, Isolation::Isolated}) {
    INFO((isolation == Isolation::Isolated));
    PluginSet plugins;
    set_isolation(plugins, isolation);
    Diagnostics diagnostics;
    REQUIRE(plugins.load_file(plugin_path("echo"), diagnostics));
    REQUIRE(plugins.initialize(diagnostics));
    Tree tree = leaves_of(*plugins.types().at(0), {{}, {}});
    // The first leaf's output is its own input, and what the second one copies.
    tree.ports[kStringOut].slot = kStringIn;
    tree.ports[kGrow].slot = kSeen;
    Blackboard blackboard(tree);
    const LeafTime time;
    LeafSet set(tree, blackboard, time, 1);
    const auto tick = [&](std::size_t leaf) {
      const LeafSlot& slot = set.slots()[leaf];
      slot.type->tick(slot.self);
      CHECK(slot.error == nullptr);
    };
    blackboard.values[kStringIn] = std::string("ab");
    tick(0);  // sees a size of 2, and then sets a string of that size
    CHECK(std::get<std::string>(blackboard.values[kStringIn]) == "xx");
    CHECK(std::get<std::int64_t>(blackboard.values[kSeen]) == 2);
    tick(1);
    CHECK(std::get<std::string>(blackboard.values[kStringOut]) == "xx");
  }
}

TEST_CASE("isolated: the same random numbers, at the same time") {
  const auto numbers = [](Isolation isolation) {
    Leaves leaves("echo", {{}, {}}, isolation);
    std::vector<double> result;
    for (const std::size_t leaf : {0, 1, 1, 0}) {
      leaves.time.now += std::chrono::seconds(1);
      leaves.tick(leaf);
      result.push_back(leaves.get<double>(kRandom));
    }
    return result;
  };
  CHECK(numbers(Isolation::Isolated) == numbers(Isolation::InProcess));
}

TEST_CASE("isolated: a line from another thread of the plugin arrives by itself") {
  const NothingRemains nothing_remains;
  Leaves leaves("echo", {{}});
  leaves.value(kSpeak) = true;
  CHECK(leaves.tick().empty());
  std::unique_lock lock(leaves.mutex);
  const bool arrived =
      leaves.logged.wait_for(lock, std::chrono::seconds(20), [&] { return !leaves.log.empty(); });
  REQUIRE(arrived);
  CHECK(leaves.log == Strings{"Test/leaf0: from another thread"});
}

TEST_CASE("isolated: runs at the same time have processes of their own") {
  const NothingRemains nothing_remains;
  PluginSet plugins;
  set_isolation(plugins, Isolation::Isolated);
  Diagnostics diagnostics;
  REQUIRE(plugins.load_file(plugin_path("echo"), diagnostics));
  REQUIRE(plugins.initialize(diagnostics));
  const Tree tree = leaves_of(*plugins.types().at(0), {{}});
  std::int64_t processes[2] = {};
  std::mutex mutex;
  std::condition_variable changed;
  int running = 0;
  std::vector<std::thread> threads;
  for (std::int64_t& process : processes) {
    threads.emplace_back([&] {
      Blackboard blackboard(tree);
      const LeafTime time;
      LeafSet set(tree, blackboard, time, 1);
      {
        std::unique_lock lock(mutex);
        ++running;
        changed.notify_all();
        changed.wait(lock, [&] { return running == 2; });
      }
      const LeafSlot& slot = set.slots()[0];
      for (int tick = 0; tick < 100; ++tick) slot.type->tick(slot.self);
      process = std::get<std::int64_t>(blackboard.values[kProcess]);
    });
  }
  for (std::thread& thread : threads) thread.join();
  CHECK(processes[0] > 0);
  CHECK(processes[1] > 0);
  CHECK(processes[0] != processes[1]);
}

TEST_CASE("isolated: a run ends in order when the process of its leaf dies") {
  const NothingRemains nothing_remains;
  PluginSet plugins;
  set_isolation(plugins, Isolation::Isolated);
  Diagnostics diagnostics;
  REQUIRE(plugins.load_file(plugin_path("crash"), diagnostics));
  REQUIRE(plugins.initialize(diagnostics));
  const Tree tree = leaves_of(*plugins.types().at(0), {crash_in("tick", "abort")});
  Run run(tree, {});
  run.tick(Nanoseconds(0));
  REQUIRE(run.fault() != nullptr);
  CHECK(run.fault()->message == "its process was killed by SIGABRT (Aborted)");
  run.restart(1);
  CHECK(run.fault() == nullptr);
}

}  // namespace
}  // namespace lockstep::test
