// lockstep in a program, through lockstep/runtime.hpp and the shared library alone.
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <lockstep/runtime.hpp>
#include <thread>

#include "error_of.h"
#include "support/paths.h"

namespace {

namespace runtime = lockstep::runtime;
using lockstep::Status;
using Strings = std::vector<std::string>;

Strings calls;  // of all Step leaves

struct StepPorts : lockstep::Ports {
  Input<double> step{this, "step", "0.25", "progress per tick"};
  InOut<std::int64_t> ticks{this, "ticks", "0", "counts them"};
};

class Step : public lockstep::Action<StepPorts> {
 public:
  void start() override { done_ = 0; }
  Status tick() override {
    if (step.get() < 0) throw std::runtime_error("cannot go back");
    done_ += step.get();
    ticks.set(ticks.get() + 1);
    return done_ >= 1 ? Status::Success : Status::Running;
  }
  void halt() override { calls.push_back("halt"); }
  void pause() override { calls.push_back("pause"); }
  double progress() const override { return done_; }

 private:
  double done_ = 0;
};

class Percent : public lockstep::Action<> {
 public:
  Status tick() override { return Status::Running; }
  double progress() const override { return 37; }
};

class GoesOn : public lockstep::Action<> {
 public:
  Status tick() override { return Status::Running; }
  double progress() const override { return now(); }
};

// Does not return before somebody is told so.
class Slow : public lockstep::Action<> {
 public:
  Status tick() override {
    while (!is_told) std::this_thread::yield();
    return Status::Success;
  }
  static inline std::atomic<bool> is_told = false;
  static inline std::string told;
};

// Does what the test says in its tick, and runs.
class DoesAsTold : public lockstep::Action<> {
 public:
  Status tick() override {
    in_tick();
    return Status::Running;
  }
  static inline std::function<void()> in_tick;
};

// Notes its calls, and succeeds in the second tick.
class Told : public lockstep::Action<> {
 public:
  void start() override {
    calls.push_back("start");
    ticks_ = 0;
  }
  Status tick() override {
    calls.push_back("tick");
    return ++ticks_ < 2 ? Status::Running : Status::Success;
  }
  void halt() override {
    calls.push_back("halt");
    if (breaks) throw std::runtime_error("cannot halt");
  }
  static inline bool breaks = false;

 private:
  int ticks_ = 0;
};

// Is done when a thread of its own has said so.
class Asks : public lockstep::Action<> {
 public:
  static constexpr bool kWakes = true;
  ~Asks() {
    if (thread_.joinable()) thread_.join();
  }
  void start() override {
    thread_ = std::thread([this] {
      is_there_ = true;
      wake();
    });
  }
  Status tick() override { return is_there_ ? Status::Success : Status::Running; }

 private:
  std::atomic<bool> is_there_ = false;
  std::thread thread_;
};

struct Shared {
  int users = 0;
};
class Counts : public lockstep::Condition<> {
 public:
  bool check() override {
    log("user " + std::to_string(++context<Shared>().users));
    return true;
  }
};

// The second one cannot be made.
class Once : public lockstep::Action<> {
 public:
  Once() {
    if (made++ > 0) throw std::runtime_error("is there already");
  }
  Status tick() override { return Status::Running; }
  static inline int made = 0;
};

struct Pose {
  double x = 0, y = 0;
};
std::string to_text(const Pose& pose) {
  return std::to_string(static_cast<int>(pose.x)) + ";" + std::to_string(static_cast<int>(pose.y));
}
bool from_text(std::string_view text, Pose& pose) {
  return std::sscanf(std::string(text).c_str(), "%lf;%lf", &pose.x, &pose.y) == 2;
}

}  // namespace

LOCKSTEP_OBJECT_TYPE(Pose, "test.Pose");

namespace {

struct CarryPorts : lockstep::Ports {
  InOut<std::vector<bool>> flags{this, "flags", "", "flags"};
  InOut<std::vector<std::int64_t>> counts{this, "counts", "", "counts"};
  InOut<std::vector<double>> points{this, "points", "", "points"};
  InOut<std::vector<std::string>> words{this, "words", "", "words"};
  Input<lockstep::Number> number{this, "number", "0", "an int or a double"};
  Input<std::shared_ptr<const Pose>> from{this, "from", required, "a pose"};
  Output<std::shared_ptr<const Pose>> to{this, "to", "twice as far"};
};

// Adds something to each of its ports.
class Carry : public lockstep::Action<CarryPorts> {
 public:
  Status tick() override {
    append(flags, true);
    append(counts, std::int64_t{7});
    append(points, double{number.get()});
    append(words, std::string("a;b"));
    to.set(std::make_shared<Pose>(Pose{2 * from.get()->x, 2 * from.get()->y}));
    return Status::Success;
  }

 private:
  template <class Port, class Item>
  static void append(Port& port, Item item) {
    auto list = port.get();
    list.push_back(item);
    port.set(list);
  }
};

std::string tree(const std::string& nodes) {
  return "<root lockstep=\"1\"><BehaviorTree ID=\"Main\">" + nodes + "</BehaviorTree></root>";
}

runtime::Project project_of(const std::string& nodes) {
  runtime::Project project;
  project.add_leaf<Step>("Step", "Makes a step in each tick");
  project.load_text(tree(nodes));
  calls.clear();
  return project;
}

}  // namespace

TEST_CASE("a program ticks a tree with leaves that it defines, when it likes") {
  const runtime::Project project = project_of("<Step name=\"a\" ticks=\"{n}\"/>");
  runtime::Run run(project);
  CHECK(run.tick(0) == Status::Running);
  CHECK(run.node(0).progress == 0.25);
  CHECK(run.tick(0.5) == Status::Running);
  CHECK(run.tick(0.5) == Status::Running);
  CHECK(run.tick(7) == Status::Success);
  CHECK(run.get<std::int64_t>("n") == 4);
  CHECK(run.node(0).status == Status::Success);
  CHECK(run.tick(8) == Status::Running);  // begins again
  run.halt();
  CHECK(calls == Strings{"halt"});
  CHECK_FALSE(run.node(0).status);
}

TEST_CASE("time that goes back, is negative or no number is refused at each call") {
  const runtime::Project project = project_of("<Step step=\"0.125\"/>");
  runtime::Run run(project);
  int observed = 0;
  run.on_tick([&](std::uint64_t, double, Status) { ++observed; });
  const auto why = [] { return std::string(lockstep_last_error()); };
  run.tick(2);
  for (int call = 0; call < 3; ++call) {
    CHECK(error_of([&] { run.tick(1); }) == "the time is before that of the last tick");
    CHECK(lockstep_run_tick(run.get(), 1) == LOCKSTEP_RUNNING);
    CHECK(why() == "the time is before that of the last tick");
  }
  CHECK(error_of([&] { run.tick(-1); }) == "the time is not a number of seconds");
  CHECK(error_of([&] { run.tick(std::nan("")); }) == "the time is not a number of seconds");
  CHECK(lockstep_run_tick(run.get(), -1) == LOCKSTEP_RUNNING);
  CHECK(why() == "the time is not a number of seconds");
  CHECK(observed == 1);
  CHECK(run.node(0).progress == 0.125);
  // The run goes on, and an error is of the last call.
  CHECK(lockstep_run_tick(run.get(), 2) == LOCKSTEP_RUNNING);
  CHECK(why().empty());
  CHECK(run.tick(3) == Status::Running);
  CHECK(observed == 3);
}

TEST_CASE("an error that an observer meets is not that of the tick") {
  const runtime::Project project = project_of("<Step/>");
  runtime::Run run(project);
  run.on_tick([&](std::uint64_t, double, Status) {
    CHECK_FALSE(lockstep_run_set_double(run.get(), "none", 1));
  });
  CHECK(run.tick(0) == Status::Running);
  CHECK(std::string(lockstep_last_error()).empty());
}

TEST_CASE("what a run calls back cannot tick, halt, restart or free it") {
  const runtime::Project project = project_of("<Step/>");
  runtime::Run run(project);
  const std::string busy = "the run is in use: what it calls back cannot tick, halt or restart it";
  int observed = 0;
  run.on_tick([&](std::uint64_t, double seconds, Status) {
    ++observed;
    CHECK(error_of([&] { run.tick(seconds); }) == busy);
    CHECK(error_of([&] { run.halt(); }) == busy);
    CHECK(error_of([&] { run.restart(1); }) == busy);
    CHECK(error_of([&] { run.loop({true}); }) == busy);
    lockstep_run_free(run.get());
    CHECK(std::string(lockstep_last_error()) == "the run is in use: it is not freed");
  });
  CHECK(run.tick(0) == Status::Running);
  CHECK(observed == 1);
  CHECK(calls.empty());
  run.restart(0);
  CHECK(run.loop({true}).ticks == 4);
  CHECK(observed == 5);
}

TEST_CASE("what a run calls back while it is freed may read it, and cannot tick, halt or free it") {
  const runtime::Project project = project_of("<Step ticks=\"{n}\"/>");
  lockstep_run* const run = lockstep_run_new(project.get(), nullptr);
  REQUIRE(run != nullptr);
  struct Seen {
    Strings refused, texts;
  } seen;
  const auto watch = [](void* user, lockstep_run* it, std::uint32_t node, std::int32_t what,
                        lockstep_status) -> lockstep_status {
    if (what != LOCKSTEP_BEFORE_HALT && what != LOCKSTEP_AFTER_HALT) return LOCKSTEP_IDLE;
    auto& to = *static_cast<Seen*>(user);
    const auto note = [&] { to.refused.emplace_back(lockstep_last_error()); };
    lockstep_run_tick(it, 1), note();
    lockstep_run_halt(it), note();
    lockstep_run_restart(it, 1), note();
    lockstep_run_keep(it, "/no/such/folder/file", nullptr, nullptr), note();
    lockstep_run_free(it), note();
    auto state = runtime::detail::sized<lockstep_node_state>();
    CHECK(lockstep_run_node(it, node, &state));
    CHECK(lockstep_run_fault(it, nullptr) == nullptr);
    CHECK(lockstep_run_observe(it, nullptr, user));
    to.texts.emplace_back(lockstep_run_get_text(it, "n"));
    return LOCKSTEP_IDLE;
  };
  const std::uint32_t step = 0;
  REQUIRE(lockstep_run_watch_nodes(run, &step, 1, watch, &seen));
  CHECK(lockstep_run_tick(run, 0) == LOCKSTEP_RUNNING);
  lockstep_run_free(run);
  CHECK(calls == Strings{"halt"});
  CHECK(seen.texts == Strings{"1", "1"});
  const std::string busy = "the run is in use: what it calls back cannot tick, halt or restart it";
  const std::string freed = "the run is in use: it is not freed";
  CHECK(seen.refused == Strings{busy, busy, busy, busy, freed, busy, busy, busy, busy, freed});
}

TEST_CASE("a progress that is no share, and a failure that the run goes on after, are reported") {
  runtime::Project project;
  project.add_leaf<Step>("Step", "Makes a step in each tick").add_leaf<Percent>("Percent", "In %");
  project.load_text(
      tree("<Parallel><Percent/><Fallback><Step step=\"-1\"/><Step/></Fallback></Parallel>"));
  Strings lines;
  runtime::RunSettings settings;
  settings.fail_on_fault = true;
  settings.log = [&](const std::string& who, lockstep::LogLevel level, const std::string& text) {
    CHECK(level == lockstep::LogLevel::Warning);
    lines.push_back(who + ": " + text);
  };
  runtime::Run run(project, settings);
  run.tick(0);
  CHECK(lines == Strings{"Main/Parallel/Fallback/Step: failed in tick 0: cannot go back; counted "
                         "as Failure"});
  lines.clear();
  for (int i = 0; i < 3; ++i) CHECK(run.node(1).progress == 1);
  const Strings percent = {
      "Main/Parallel/Percent: reported the progress 37: progress is a share from 0 to 1, so it "
      "counts as 1"};
  CHECK(lines == percent);
  run.restart(0);
  run.tick(0);
  lines.clear();
  run.node(1);
  CHECK(lines == percent);
}

TEST_CASE("a leaf that goes on while it is held is reported, once in a run") {
  runtime::Project project;
  project.add_leaf<Step>("Step", "Makes a step in each tick").add_leaf<GoesOn>("GoesOn", "Does");
  project.load_text(tree(
      "<ParallelAbsolute barriers=\"0.25\"><Step step=\"0.001\"/><GoesOn/></ParallelAbsolute>"));
  Strings lines;
  runtime::RunSettings settings;
  settings.log = [&](const std::string& who, lockstep::LogLevel, const std::string& text) {
    lines.push_back(who + ": " + text);
  };
  runtime::Run run(project, settings);
  for (int round = 0; round < 2; ++round) {
    for (int i = 0; i < 7; ++i) run.tick(i * 0.125);
    CHECK(lines == Strings{"Main/ParallelAbsolute/GoesOn: continued while it was held: its "
                           "progress rose from 0.25 to 0.5"});
    lines.clear();
    run.restart(0);
  }
}

TEST_CASE("a text that is not UTF-8 is refused by one rule, and an error has an end") {
  const std::string latin = "caf\xe9";
  const std::string good = "caf\xc3\xa9";
  runtime::Project project;
  CHECK(error_of([&] { project.set_argument(latin, "1"); }) == "the name is not UTF-8");
  CHECK(error_of([&] { project.set_argument("a", latin); }) == "the value is not UTF-8");
  CHECK(error_of([&] { project.set_value(latin, "1"); }) == "the key is not UTF-8");
  CHECK(error_of([&] { project.set_value("a", latin); }) == "the value is not UTF-8");
  CHECK(error_of([&] { project.set_main_tree(latin); }) == "the ID is not UTF-8");
  project.add_leaf<Step>("Step", "Makes a step in each tick");
  project.load_text(tree("<Sequence><Script code=\"text := 'x'\"/><Step/></Sequence>"));
  CHECK(error_of([&] { project.find_node(latin); }) == "the path is not UTF-8");
  runtime::Run run(project);
  CHECK(error_of([&] { run.set(latin, 1.0); }) == "the key is not UTF-8");
  CHECK(error_of([&] { run.get<std::string>(latin); }) == "the key is not UTF-8");
  CHECK(error_of([&] { run.set("text", latin); }) == "the text is not UTF-8");
  run.set("text", good);
  CHECK(run.get<std::string>("text") == good);
  run.set("text", "");

  const std::string endless(60'000'000, 'x');
  CHECK(error_of([&] { run.set(endless, 1.0); }).size() < 2100);
  CHECK(error_of([&] { project.find_node(endless); }).size() < 2100);
}

TEST_CASE("what is wrong with a tree is data") {
  runtime::Project project;
  const std::string error = error_of([&] {
    project.load_text(
        "<root lockstep=\"1\">\n<BehaviorTree ID=\"Main\">\n<Sequnce/>\n"
        "</BehaviorTree></root>",
        "robot.xml");
  });
  CHECK(error ==
        "the tree has errors: see the diagnostics of its project\n"
        "robot.xml:3:1: unknown node 'Sequnce' (did you mean 'Sequence'?)");
  REQUIRE(project.diagnostics().size() == 1);
  const runtime::Diagnostic it = project.diagnostics()[0];
  CHECK(it.severity == runtime::Diagnostic::Severity::Error);
  CHECK((it.file == "robot.xml" && it.line == 3 && it.column == 1));
  CHECK(it.message == "unknown node 'Sequnce'");
  CHECK(it.hint == "did you mean 'Sequence'?");
  CHECK(error_of([&] { project.load_text(tree("<AlwaysSuccess/>")); }) ==
        "the project has been loaded already");
  CHECK(error_of([&] { const runtime::Run run(project); }) == "the project has not been loaded");
}

TEST_CASE("a warning does not keep a tree from being loaded") {
  const runtime::Project project = project_of("<Step step=\"{unknown}\"/>");
  REQUIRE(project.diagnostics().size() == 1);
  CHECK(project.diagnostics()[0].severity == runtime::Diagnostic::Severity::Warning);
}

TEST_CASE("a file that is not there is an error of the project") {
  runtime::Project project;
  CHECK_THROWS_AS(project.load_file("/nowhere/tree.xml"), runtime::Error);
  REQUIRE(project.diagnostics().size() == 1);
  CHECK(project.diagnostics()[0].file == "/nowhere/tree.xml");
}

TEST_CASE("nodes are known by index and path") {
  const runtime::Project project =
      project_of("<Sequence name=\"all\"><Step name=\"a\"/><Step/></Sequence>");
  const auto nodes = project.nodes();
  REQUIRE(nodes.size() == 3);
  CHECK((nodes[0].path == "Main/all" && nodes[0].id == "Sequence" && nodes[0].end == 3));
  CHECK((nodes[1].path == "Main/all/a" && nodes[1].parent == 0 && nodes[1].name == "a"));
  CHECK(nodes[2].name == "Step");
  CHECK(project.find_node("Main/all/Step") == 2);
  CHECK(error_of([&] { project.find_node("Main/b"); }) == "there is no node 'Main/b'");
}

TEST_CASE("entries are read and written by key") {
  const runtime::Project project = project_of("<Step step=\"{step}\" ticks=\"{n}\"/>");
  runtime::Run run(project);
  CHECK(error_of([&] { run.get<double>("step"); }) == "nothing has written the entry 'step'");
  run.set("step", 0.5);
  CHECK(run.tick(0) == Status::Running);
  CHECK(run.get<double>("step") == 0.5);
  CHECK(run.get<std::string>("n") == "1");
  run.set("step", "0.375");
  run.set("n", 10);
  CHECK(run.tick(0) == Status::Running);
  CHECK(run.get<std::int64_t>("n") == 11);
  CHECK(error_of([&] { run.set("steep", 1.0); }) ==
        "no node uses an entry 'steep'; did you mean 'step'?");
  CHECK(error_of([&] { run.set("n", 1.0); }) == "the entry 'n' is of type int");
  CHECK(error_of([&] { run.set("n", "many"); }) ==
        "the entry 'n' is of type int: expected a whole number");
  CHECK(error_of([&] { run.get<bool>("n"); }) == "the entry 'n' has another type");
  CHECK(error_of([&] { run.set("step", 1.0 / 0.0); }) == "a number must be finite");
  // A whole number is also a real one, and of any size.
  run.set("step", 2);
  CHECK(run.get<double>("step") == 2.0);
  CHECK(run.get<double>("n") == 11.0);
  run.set("n", 3U);
  run.set("step", std::size_t{4});
  CHECK(run.get<std::int64_t>("n") == 3);
  CHECK(run.get<double>("step") == 4.0);
  CHECK(error_of([&] { run.set("n", UINT64_MAX); }) == "a number is too large for an entry");
  run.set("step", INT64_MAX);  // the nearest
  CHECK(run.get<double>("step") == 0x1p63);
  run.set("step", -(std::int64_t{1} << 53) - 1);
  CHECK(run.get<double>("step") == -0x1p53);
}

TEST_CASE("a text with a NUL is whole, by key and by handle") {
  runtime::Project project;
  project.add_leaf<Carry>("Carry", "Adds");
  project.load_text(
      tree("<Sequence><Script code=\"t := 'x'\"/><Carry words=\"{w}\" from=\"{p}\" "
           "to=\"{q}\"/></Sequence>"));
  runtime::Run run(project);
  const std::string text("a\0b", 3);
  run.set("t", text);
  CHECK(run.get<std::string>("t") == text);
  const runtime::EntryHandle handle = project.find_entry("t");
  run.set(handle, text + text);
  CHECK(run.get<std::string>(handle) == text + text);
  CHECK(std::string(lockstep_run_get_text(run.get(), "t")) == "a");
  run.set("w", text + ";c");
  CHECK(run.get<Strings>("w") == Strings{text, "c"});
  CHECK_FALSE(lockstep_run_set_sized_text(run.get(), "t", nullptr, 0));
  CHECK_FALSE(lockstep_run_get_sized_text(run.get(), "t", nullptr));
}

TEST_CASE("an entry that was found once is read and written by its handle, in all runs") {
  std::optional<runtime::Run> first, second;
  runtime::EntryHandle step, n;
  {
    const runtime::Project project = project_of("<Step step=\"{step}\" ticks=\"{n}\"/>");
    step = project.find_entry("step");
    n = project.find_entry("n");
    CHECK(error_of([&] { project.find_entry("steep"); }) ==
          "no node uses an entry 'steep'; did you mean 'step'?");
    first.emplace(project);
    second.emplace(project);
  }
  CHECK(error_of([&] { first->get<double>(step); }) == "nothing has written the entry 'step'");
  first->set(step, 0.5);
  second->set(step, "0.25");
  CHECK(first->tick(0) == Status::Running);
  CHECK(second->tick(0) == Status::Running);
  CHECK(first->get<double>("step") == 0.5);
  CHECK(second->get<double>(step) == 0.25);
  CHECK(second->get<std::string>(n) == "1");
  second->set(n, 10);
  CHECK(second->tick(0) == Status::Running);
  CHECK(second->get<std::int64_t>(n) == 11);
  CHECK(first->get<std::int64_t>(n) == 1);
  CHECK(lockstep_run_value_type_at(first->get(), n.index) == LOCKSTEP_INT);
  CHECK(error_of([&] { first->set(n, 1.0); }) == "the entry 'n' is of type int");
  CHECK(error_of([&] { first->set(n, "many"); }) ==
        "the entry 'n' is of type int: expected a whole number");
  CHECK(error_of([&] { first->get<bool>(n); }) == "the entry 'n' has another type");
  CHECK(error_of([&] { first->get<bool>(runtime::EntryHandle{7}); }) == "no such entry");
}

TEST_CASE("lists and objects by their handles") {
  runtime::Project project;
  project.add_leaf<Carry>("Carry", "Adds something to each of its ports");
  project.load_text(
      tree(R"(<Carry flags="{flags}" counts="{counts}" points="{points}" words="{words}"
                number="{number}" from="{from}" to="{to}"/>)"));
  const auto handle = [&](const char* key) { return project.find_entry(key); };
  runtime::Run run(project);
  run.set(handle("flags"), std::vector<bool>{false, true});
  run.set(handle("counts"), std::vector<std::int64_t>{-1});
  run.set(handle("points"), std::vector<double>{0.5});
  run.set(handle("words"), Strings{"", std::string("x\0y", 3)});
  run.set(handle("number"), 3);
  run.set(handle("from"), "1;2");
  CHECK(run.get<double>(handle("number")) == 3);
  CHECK(run.tick(0) == Status::Success);
  CHECK(run.get<std::vector<bool>>(handle("flags")) == std::vector<bool>{false, true, true});
  CHECK(run.get<std::vector<std::int64_t>>(handle("counts")) == std::vector<std::int64_t>{-1, 7});
  CHECK(run.get<std::vector<double>>(handle("points")) == std::vector<double>{0.5, 3});
  CHECK(run.get<Strings>(handle("words")) == Strings{"", std::string("x\0y", 3), "a;b"});
  CHECK(run.get<std::string>(handle("to")) == "2;4");
}

TEST_CASE("entries that are lists, numbers of either kind and objects") {
  runtime::Project project;
  project.add_leaf<Carry>("Carry", "Adds something to each of its ports");
  project.load_text(
      tree(R"(<Carry flags="{flags}" counts="{counts}" points="{points}" words="{words}"
                number="{number}" from="{from}" to="{to}"/>)"));
  runtime::Run run(project);
  CHECK(error_of([&] { run.get<std::vector<double>>("points"); }) ==
        "nothing has written the entry 'points'");
  run.set("flags", std::vector<bool>{false, true});
  run.set("counts", std::vector<std::int64_t>{-1});
  run.set("points", std::vector<double>{0.5});
  run.set("words", Strings{"", std::string("x\0y", 3)});
  run.set("number", 3);
  run.set("from", "1;2");
  CHECK(run.get<double>("number") == 3);
  CHECK(run.get<std::int64_t>("number") == 3);
  CHECK(run.tick(0) == Status::Success);
  CHECK(run.get<std::vector<bool>>("flags") == std::vector<bool>{false, true, true});
  CHECK(run.get<std::vector<std::int64_t>>("counts") == std::vector<std::int64_t>{-1, 7});
  CHECK(run.get<std::vector<double>>("points") == std::vector<double>{0.5, 3});
  CHECK(run.get<Strings>("words") == Strings{"", std::string("x\0y", 3), "a;b"});
  CHECK(run.get<std::string>("to") == "2;4");
  run.set("number", 0.25);
  CHECK(run.get<double>("number") == 0.25);
  CHECK(error_of([&] { run.get<std::int64_t>("number"); }) ==
        "the entry 'number' has another type");
  run.set("points", std::vector<double>{});
  CHECK(run.get<std::vector<double>>("points").empty());
}

TEST_CASE("entries are listed with their types, and a run knows what they have now") {
  runtime::Project project;
  project.add_leaf<Carry>("Carry", "Adds something to each of its ports");
  project.load_text(
      tree(R"(<Carry points="{points}" words="{words}" number="{number}" from="{from}"/>)"));
  std::vector<std::string> entries;
  std::vector<lockstep_type> types;
  for (std::uint32_t i = 0; i < lockstep_project_entry_count(project.get()); ++i) {
    lockstep_entry entry{};
    entry.struct_size = sizeof entry;
    REQUIRE(lockstep_project_entry(project.get(), i, &entry));
    entries.push_back(std::string(entry.key) + ": " + entry.type_name);
    types.push_back(entry.type);
  }
  CHECK(entries == Strings{"points: list of double", "words: list of string",
                           "number: int or double", "from: test.Pose"});
  CHECK(types == std::vector<lockstep_type>{LOCKSTEP_DOUBLE_LIST, LOCKSTEP_STRING_LIST,
                                            LOCKSTEP_NUMBER, LOCKSTEP_OBJECT});
  lockstep_entry entry{};
  entry.struct_size = sizeof entry;
  CHECK_FALSE(lockstep_project_entry(project.get(), 4, &entry));
  CHECK(lockstep_project_entry_count(nullptr) == 0);
  runtime::Run run(project);
  CHECK(lockstep_run_value_type(run.get(), "number") == 0);
  run.set("number", 3);
  CHECK(lockstep_run_value_type(run.get(), "number") == LOCKSTEP_INT);
  run.set("number", 0.5);
  CHECK(lockstep_run_value_type(run.get(), "number") == LOCKSTEP_DOUBLE);
  CHECK(lockstep_run_value_type(run.get(), "numbr") == 0);
  CHECK(std::string(lockstep_last_error()) ==
        "no node uses an entry 'numbr'; did you mean 'number'?");
}

TEST_CASE("objects go in and out by reference") {
  runtime::Project project;
  project.add_leaf<Carry>("Carry", "Adds something to each of its ports");
  project.load_text(tree(R"(<Carry number="{number}" from="{from}" to="{to}"/>)"));
  runtime::Run run(project);
  CHECK(error_of([&] { run.get_object<Pose>("from"); }) == "nothing has written the entry 'from'");
  const auto given = std::make_shared<Pose>(Pose{1, 2});
  run.set("from", given);
  CHECK(run.get_object<Pose>("from") == given);
  CHECK(given.use_count() == 2);
  run.set("number", 1);
  CHECK(run.tick(0) == Status::Success);
  const auto to = project.find_entry("to");
  CHECK(run.get_object<Pose>(to)->x == 2);
  run.set(to, std::shared_ptr<const Pose>(given));
  CHECK(run.get_object<Pose>(to) == given);
  CHECK(error_of([&] { run.set("number", given); }) ==
        "the entry 'number' is of type int or double, not test.Pose");
  CHECK(error_of([&] { run.set("from", std::shared_ptr<Pose>()); }) == "an object is null");
  CHECK(lockstep_run_get_object(run.get(), "from", nullptr) == nullptr);
}

TEST_CASE("lists and objects that do not fit their entry are errors") {
  runtime::Project project;
  project.add_leaf<Carry>("Carry", "Adds something to each of its ports");
  project.load_text(tree(R"(<Carry points="{points}" words="{words}" from="{from}"/>)"));
  runtime::Run run(project);
  CHECK(error_of([&] { run.set("points", std::vector<double>{1.0 / 0.0}); }) ==
        "a number must be finite");
  CHECK(error_of([&] { run.set("points", std::vector<bool>{}); }) ==
        "the entry 'points' is of type list of double");
  CHECK(error_of([&] {
          run.set("from", std::vector<double>{1, 2});
        }) == "the entry 'from' is of type test.Pose");
  CHECK(error_of([&] { run.set("from", "home"); }) ==
        "the entry 'from' is of type test.Pose: expected the text of a test.Pose");
  CHECK_FALSE(lockstep_run_set_double_list(run.get(), "points", nullptr, 1));
  CHECK_FALSE(lockstep_run_get_double_list(run.get(), "points", nullptr, nullptr));
  const lockstep_text none{nullptr, 3};
  CHECK_FALSE(lockstep_run_set_text_list(run.get(), "words", &none, 1));
  CHECK(std::string(lockstep_last_error()) == "a text is NULL");
}

TEST_CASE("a fault of a leaf is an error with everything halted, or a failure") {
  const runtime::Project project =
      project_of("<Parallel><Step/><Step step=\"-1\"/><Step/></Parallel>");
  runtime::Run run(project);
  CHECK(error_of([&] { run.tick(0); }) == "Main/Parallel/Step#2: cannot go back");
  CHECK(calls == Strings{"halt", "halt"});
  CHECK(run.fault() == "Main/Parallel/Step#2: cannot go back");
  run.restart(1);
  CHECK_FALSE(run.fault());

  runtime::Run tolerant(project, {0, 0.01, true});
  CHECK(tolerant.tick(0) == Status::Failure);
}

TEST_CASE("after a fault a run recovers: its next tick begins the tree") {
  const runtime::Project project =
      project_of("<Parallel><Step/><Step step=\"{step}\"/></Parallel>");
  runtime::RunSettings settings;
  Strings told;
  settings.log = [&](const std::string&, lockstep::LogLevel, const std::string& line) {
    told.push_back(line);
  };
  runtime::Run run(project, settings);
  run.set("step", -1);
  CHECK(error_of([&] { run.tick(0); }) == "Main/Parallel/Step#2: cannot go back");
  run.set("step", 0.5);
  CHECK(error_of([&] { run.tick(1); }) == "Main/Parallel/Step#2: cannot go back");
  calls.clear();
  run.recover();
  CHECK_FALSE(run.fault());
  CHECK(calls.empty());  // all was halted
  CHECK(run.get<double>("step") == 0.5);
  CHECK(run.tick(2) == Status::Running);
  CHECK(told == Strings{"cannot go back; the run continues"});
  run.recover();  // no fault: as halt
  CHECK(calls == Strings{"halt", "halt"});
  CHECK(run.tick(3) == Status::Running);
  CHECK_FALSE(lockstep_run_recover(nullptr));
}

TEST_CASE("a run whose leaves cannot be made again says so, and is not ticked") {
  runtime::Project project;
  project.add_leaf<Once>("Once", "Is made once");
  project.load_text(tree("<Once name=\"one\"/>"));
  Once::made = 0;
  runtime::Run run(project);
  const auto error = error_of([&] { run.restart(1); });
  CHECK(error.find("Main/one: ") == 0);
  CHECK(error.find("is there already") != std::string::npos);
  CHECK(lockstep_run_tick(run.get(), 0) == LOCKSTEP_RUNNING);
  CHECK(run.fault() == error);
  Once::made = 0;
  run.restart(1);
  CHECK(run.tick(0) == Status::Running);
}

TEST_CASE("observers see each tick, and what they throw comes out of it") {
  const runtime::Project project = project_of("<Step/>");
  runtime::Run run(project);
  std::vector<double> times;
  run.on_tick([&](std::uint64_t tick, double seconds, Status status) {
    CHECK(tick == times.size());
    CHECK(status == (tick == 3 ? Status::Success : Status::Running));
    times.push_back(seconds);
  });
  const auto result = run.loop({true});
  CHECK(result.reason == runtime::LoopResult::Reason::Completed);
  CHECK(result.status == Status::Success);
  CHECK(result.ticks == 4);
  REQUIRE(times.size() == 4);
  CHECK(times[3] == Approx(0.03));
  run.on_tick([](std::uint64_t, double, Status) { throw runtime::Error("enough"); });
  run.restart(0);
  times.clear();
  CHECK(error_of([&] { run.tick(0); }) == "enough");
}

TEST_CASE("an observer may add others, which see the next tick") {
  const runtime::Project project = project_of("<Step step=\"0.001\"/>");
  runtime::Run run(project);
  struct Seen {
    std::vector<std::uint64_t> ticks;
    int added = 0;
  } seen;
  const auto adds = [&run, &seen] {
    for (int i = 0; i < 20; ++i) {
      run.on_tick([&seen](std::uint64_t, double, Status) { ++seen.added; });
    }
  };
  run.on_tick([&seen, &adds](std::uint64_t tick, double, Status) {  // it is in std::function itself
    if (tick == 0) adds();
    seen.ticks.push_back(tick);
  });
  run.tick(0);
  CHECK(seen.added == 0);
  run.tick(1);
  CHECK(seen.added == 20);
  CHECK(seen.ticks == std::vector<std::uint64_t>{0, 1});
}

TEST_CASE("a loop ends at its limits, and halts what runs") {
  const runtime::Project project = project_of("<Step step=\"0.001\"/>");
  runtime::Run run(project);
  using Reason = runtime::LoopResult::Reason;
  CHECK(run.loop({true, 10}).reason == Reason::MaxTicks);
  CHECK(calls == Strings{"halt"});
  CHECK(error_of([&] { run.loop({true}); }) ==
        "the run has been ticked already: restart it before the loop");
  run.restart(0);
  CHECK(run.loop({true, 0, 0.5}).reason == Reason::Timeout);
  run.restart(0);
  int asked = 0;
  runtime::LoopSettings settings;
  settings.virtual_clock = true;
  settings.stop = [&] { return ++asked > 5; };
  auto result = run.loop(settings);
  CHECK(result.reason == Reason::Stopped);
  CHECK(result.ticks == 5);
  run.restart(0);
  settings = {};
  asked = 0;
  settings.stop = [&] { return ++asked == 2; };  // in the wait
  settings.max_ticks = 9;
  CHECK(run.loop(settings).reason == Reason::Stopped);
  run.restart(0);
  settings = {};
  settings.max_ticks = 3;
  result = run.loop(settings);  // on the wall clock
  CHECK(result.ticks == 3);
  CHECK(result.seconds >= 0.02);
}

TEST_CASE("a run in the place of another ends that one, and then frees what it calls back") {
  struct Gone {
    ~Gone() { calls.push_back("its log is gone"); }
  };
  const runtime::Project project = project_of("<Step/>");
  runtime::RunSettings settings;
  settings.log = [gone = std::make_shared<Gone>()](const std::string&, lockstep::LogLevel,
                                                   const std::string&) {};
  runtime::Run run(project, std::exchange(settings, {}));
  CHECK(run.tick(0) == Status::Running);
  run = runtime::Run(project);
  CHECK(calls == Strings{"halt", "its log is gone"});
  CHECK(run.tick(0) == Status::Running);
  runtime::Run& itself = run;
  run = std::move(itself);
  CHECK(run.tick(0.01) == Status::Running);
}

TEST_CASE("what on_tick or stop throws ends a loop in order") {
  const runtime::Project project = project_of("<Step step=\"0.001\"/>");
  const std::string file = std::filesystem::temp_directory_path() /
                           ("lockstep_thrown_" + std::to_string(getpid()) + ".jsonl");
  runtime::Run run(project);
  run.record(file);
  std::uint64_t last = 0;
  runtime::LoopSettings settings;
  settings.virtual_clock = true;
  SECTION("on_tick") {
    run.on_tick([](std::uint64_t tick, double, Status) {
      if (tick == 2) throw runtime::Error("enough");
    });
  }
  SECTION("stop") {
    settings.stop = [&]() -> bool {
      if (last == 2) throw runtime::Error("enough");
      return false;
    };
  }
  run.on_tick([&](std::uint64_t tick, double, Status) { last = tick; });
  settings.max_ticks = 100;
  CHECK(error_of([&] { run.loop(settings); }) == "enough");
  CHECK(last <= 2);
  CHECK(calls == Strings{"halt"});
  CHECK_FALSE(run.node(0).status);
  std::ifstream stream(file);
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  CHECK(text.find("\"end\"") != std::string::npos);
  std::filesystem::remove(file);
  run.restart(0);
  CHECK(run.tick(0) == Status::Running);
}

TEST_CASE("leaves of a run share its context, and log") {
  runtime::Project project;
  project.add_leaf<Counts>("Counts", "Counts its ticks");
  project.set_run_context<Shared>();
  project.load_text(tree("<Sequence><Counts/><Counts name=\"second\"/></Sequence>"));
  Strings lines;
  runtime::RunSettings settings;
  settings.log = [&](const std::string& who, lockstep::LogLevel, const std::string& text) {
    lines.push_back(who + ": " + text);
  };
  runtime::Run one(project, settings), other(project, settings);
  one.tick(0);
  other.tick(0);
  const Strings both = {"Main/Sequence/Counts: user 1", "Main/Sequence/second: user 2"};
  CHECK(lines == Strings{both[0], both[1], both[0], both[1]});
}

TEST_CASE("runs outlive their project, and may be in threads") {
  std::vector<std::unique_ptr<runtime::Run>> runs;
  {
    runtime::Project project;
    project.add_plugin_path(LOCKSTEP_BINARY_DIR "/plugins");
    project.set_argument("barriers", "0.5");
    project.load_file(LOCKSTEP_SOURCE_DIR "/trees/door_pulling.xml");
    for (int i = 0; i < 4; ++i) runs.push_back(std::make_unique<runtime::Run>(project));
  }
  std::array<std::uint64_t, 4> ticks{};
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    threads.emplace_back([&, i] {
      runs[i]->restart(7);
      ticks[i] = runs[i]->loop({true}).ticks;
    });
  }
  for (std::thread& thread : threads) thread.join();
  CHECK(ticks[0] > 100);
  CHECK((ticks[1] == ticks[0] && ticks[2] == ticks[0] && ticks[3] == ticks[0]));
}

TEST_CASE("several projects may load one plugin") {
  for (int round = 0; round < 2; ++round) {
    runtime::Project one, other;
    for (runtime::Project* project : {&one, &other}) {
      project->add_plugin_path(LOCKSTEP_BINARY_DIR "/plugins");
      project->load_file(LOCKSTEP_SOURCE_DIR "/trees/fetch_and_carry.xml");
    }
    runtime::Run run(one), second(other);
    CHECK(run.loop({true}).status == second.loop({true}).status);
  }
}

TEST_CASE("messages for a program have no options of the command line, and no place that is none") {
  struct Case {
    std::function<void(runtime::Project&)> change;
    std::string text, message;
  };
  const auto nothing = [](runtime::Project&) {};
  const std::string step = tree("<Step/>");
  const std::string argument =
      "<root lockstep=\"1\"><arg name=\"n\"/><BehaviorTree ID=\"Main\"><Step step=\"${n}\"/>"
      "</BehaviorTree></root>";
  const std::string two =
      "<root lockstep=\"1\"><BehaviorTree ID=\"A\"><Step/></BehaviorTree><BehaviorTree ID=\"B\">"
      "<Step/></BehaviorTree></root>";
  const Case kCases[] = {
      {[](auto& it) { it.set_argument("n", "1"); }, step, "\nunknown argument 'n' (no <arg>"},
      {nothing, argument, "has no default and is not given (the project needs a value for it)"},
      {[](auto& it) { it.set_value("x", "1"); }, step,
       "\nstart value of x: the main tree does not"},
      {[](auto& it) { it.set_value("x", "far"); }, tree("<Step step=\"{x}\"/>"),
       "(it comes from the project or from an attribute of a SubTree)"},
      {[](auto& it) { it.set_main_tree("C"); }, two, "\nunknown tree 'C'"},
      {nothing, two, "or choose one for the project; trees: 'A', 'B'"},
      {nothing, "<root lockstep=\"1\"><plugin name=\"none\"/></root>", "to the plugin path, or to"},
      {[](auto& it) { it.add_plugin("none"); }, step, "\nplugin 'none' is not found"},
      {nothing, "<root BTCPP_format=\"4\"><BehaviorTree ID=\"A\"><None/></BehaviorTree></root>",
       "if a plugin provides it, add that to the project"},
      {nothing, tree("<SetBlackboard value=\"1\" output_key=\"x\"/>"),
       "give the entry a start value"}};
  for (const Case& it : kCases) {
    INFO(it.message);
    runtime::Project project;
    project.add_leaf<Step>("Step", "");
    it.change(project);
    const std::string error = error_of([&] { project.load_text(it.text); });
    INFO(error);
    CHECK(error.find(it.message) != std::string::npos);
    CHECK(error.find("--") == std::string::npos);
    CHECK(error.find(":0:") == std::string::npos);
  }
  runtime::Project project;
  project.add_plugin_path("/nowhere").add_leaf<Step>("Step", "");
  project.load_text(tree("<Step step=\"{x}\"/>"));  // of which a warning tells
  REQUIRE(project.diagnostics().size() == 2);
  CHECK(project.diagnostics()[0].message == "plugin path /nowhere: there is no such directory");
  CHECK(project.diagnostics()[1].hint.find("give it a start value") != std::string::npos);
}

TEST_CASE("a leaf of the program may have any ID of the contract, and another is an error") {
  runtime::Project project;
  project.add_leaf<Step>("Move-Arm", "").add_leaf<Step>("Wärmen", "");
  const std::string rule = "' is no ID of a leaf: a letter, then letters, digits, '_' and '-'";
  for (const char* id : {"", "2nd", "Move Arm", "_Hidden", "a/b", "-"}) {
    INFO(id);
    CHECK(error_of([&] { project.add_leaf<Step>(id, ""); }) == "'" + std::string(id) + rule);
  }
  CHECK(error_of([&] { project.add_leaf<Step>(nullptr, ""); }) == "'" + rule);
  project.load_text(tree("<Sequence memory=\"true\"><Move-Arm/><Wärmen/></Sequence>"));
  CHECK(runtime::Run(project).loop({true}).status == Status::Success);

  runtime::Project other;
  other.add_leaf<Step>("W\xff", "");
  CHECK(error_of([&] { other.load_text(tree("<Step/>")); }).find("has the id 'W") !=
        std::string::npos);
}

TEST_CASE("leaves that come after loading are an error, in C++ and in C") {
  runtime::Project project = project_of("<Step/>");
  const std::string late = "the project has been loaded already";
  CHECK(error_of([&] { project.add_leaf<Step>("Late", ""); }) == late);
  CHECK(error_of([&] { project.set_run_context<Shared>(); }) == late);
  CHECK(error_of([&] { project.load_text(tree("<Step/>")); }) == late);
  lockstep_plugin plugin{};
  CHECK_FALSE(lockstep_project_add_leaves(project.get(), &plugin));
  CHECK(lockstep_last_error() == late);
}

TEST_CASE("an ID that is none is an error in C, with the rule") {
  auto type = lockstep::leaf<Step>("Step", "");
  type.id = "Move Arm";
  const lockstep_leaf_type* const types[] = {&type};
  lockstep_plugin plugin{};
  plugin.abi_major = LOCKSTEP_ABI_MAJOR;
  plugin.abi_minor = LOCKSTEP_ABI_MINOR;
  plugin.struct_size = sizeof plugin;
  plugin.name = "program";
  plugin.leaf_type_count = 1;
  plugin.leaf_types = types;
  const runtime::Project project;
  CHECK_FALSE(lockstep_project_add_leaves(project.get(), &plugin));
  const std::string error = lockstep_last_error();
  CHECK(error.find("leaf type 0 has the id 'Move Arm'") != std::string::npos);
  CHECK(error.find("(an id is a letter, then letters, digits, '_' and '-')") != std::string::npos);
}

TEST_CASE("two kinds of leaves with one tag are refused") {
  runtime::Project project;
  project.add_leaf<Step>("Step", "").add_leaf<Step>("Step", "");
  CHECK(error_of([&] { project.load_text(tree("<Step/>")); }).find("has the id 'Step'") !=
        std::string::npos);
}

TEST_CASE("no signal handler of the program is changed") {
  const auto handlers = [] {
    std::vector<void (*)(int)> all;
    for (int signal = 1; signal < NSIG; ++signal) {
      struct sigaction action {};
      sigaction(signal, nullptr, &action);
      all.push_back(action.sa_handler);
    }
    return all;
  };
  const auto before = handlers();
  const runtime::Project project = project_of("<Step/>");
  runtime::Run run(project);
  run.loop({true});
  CHECK(handlers() == before);
}

namespace {

// In a child of fork; what it returns is the exit code.
template <class Work>
int code_of_child(Work work) {
  const pid_t child = fork();
  if (child == 0) _exit(work() ? 0 : 1);
  int status = -1;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

constexpr const char* kProcesses =
    "<root lockstep=\"1\"><plugin name=\"steady\" program=\"steady.py\"/>"
    "<plugin name=\"motion\" isolate=\"true\"/><BehaviorTree ID=\"Main\"><Parallel><Steady/>"
    "<Advance step=\"0.01\"/></Parallel></BehaviorTree></root>";

}  // namespace

TEST_CASE("a forked child does nothing to a run of its parent") {
  runtime::Project project;
  project.add_plugin_path(LOCKSTEP_SOURCE_DIR "/tests/programs");
  project.add_plugin_path(LOCKSTEP_BINARY_DIR "/plugins");
  project.load_text(kProcesses);
  runtime::RunSettings settings;
  settings.virtual_time = true;
  runtime::Run run(project, settings);
  run.tick(0);
  CHECK(code_of_child([&] {
          const std::string foreign = "the run belongs to the process that has made it";
          const bool is_refused = error_of([&] { run.tick(0.01); }) == foreign &&
                                  error_of([&] { run.halt(); }) == foreign &&
                                  error_of([&] { run.restart(1); }) == foreign &&
                                  error_of([&] { run.node(0); }) == foreign &&
                                  error_of([&] { const runtime::Run other(project); }) ==
                                      "the project has plugins with a process of their own, which "
                                      "belongs to the process that has loaded it";
          lockstep_run_free(run.get());
          lockstep_project_free(project.get());
          return is_refused;
        }) == 0);
  for (int tick = 1; tick < 20; ++tick) CHECK(run.tick(tick * 0.01) == Status::Running);
  CHECK(run.node(2).progress > 0.15);
}

TEST_CASE("a forked child may use a project whose leaves are in the process") {
  const runtime::Project project = project_of("<Step/>");
  CHECK(code_of_child([&] {
          runtime::Run run(project);
          return run.loop({true}).ticks == 4;
        }) == 0);
}

TEST_CASE("NULL is an error and no crash") {
  const auto refused = [](bool good) {
    return !good && std::string(lockstep_last_error()).size() > 4;
  };
  lockstep_project* const project = lockstep_project_new();
  CHECK(refused(lockstep_project_add_plugin_path(project, nullptr)));
  CHECK(refused(lockstep_project_add_plugin(nullptr, "x")));
  CHECK(refused(lockstep_project_add_leaves(project, nullptr)));
  CHECK(refused(lockstep_project_set_argument(project, nullptr, "x")));
  CHECK(refused(lockstep_project_set_value(project, "x", nullptr)));
  CHECK(refused(lockstep_project_set_main_tree(project, nullptr)));
  CHECK(refused(lockstep_project_load_file(project, nullptr)));
  CHECK(refused(lockstep_project_load_text(project, "x", nullptr, 3)));
  CHECK(refused(lockstep_run_new(nullptr, nullptr) != nullptr));
  CHECK(refused(lockstep_run_restart(nullptr, 1)));
  CHECK(refused(lockstep_run_loop(nullptr, nullptr, nullptr)));
  CHECK(refused(lockstep_run_get_text(nullptr, "x") != nullptr));
  CHECK(refused(lockstep_run_get_text_at(nullptr, 0) != nullptr));
  CHECK(refused(lockstep_project_find_entry(project, "x", nullptr)));
  CHECK(lockstep_run_fault(nullptr, nullptr) == nullptr);
  CHECK(lockstep_project_node_count(nullptr) == 0);
  lockstep_run_free(nullptr);
  lockstep_project_free(nullptr);
  lockstep_project_free(project);
}

TEST_CASE("a program with a smaller struct of an older header is not written beyond it") {
  const runtime::Project project = project_of("<Step/>");
  runtime::Run run(project);
  lockstep_node_state state{};
  state.struct_size = offsetof(lockstep_node_state, progress);
  state.progress = 5;
  REQUIRE(lockstep_run_node(run.get(), 0, &state));
  CHECK(state.progress == 5);
  state.struct_size = 0;
  CHECK_FALSE(lockstep_run_node(run.get(), 0, &state));
}

TEST_CASE("a program ticks exactly once, and is told when a leaf wants a tick") {
  constexpr const char* kTree = R"(<root BTCPP_format="4"><BehaviorTree ID="Main">
    <AsyncSequence><AlwaysSuccess/><AlwaysSuccess/></AsyncSequence></BehaviorTree></root>)";
  runtime::Project project;
  project.load_text(kTree);
  int wakes = 0;
  runtime::RunSettings settings;
  settings.wake = [&] { ++wakes; };
  runtime::Run run(project, settings);
  CHECK(run.tick(0) == Status::Success);
  CHECK(wakes == 0);
  run.restart(0);
  CHECK(run.tick_once(0) == Status::Running);
  CHECK(wakes == 1);
  CHECK(run.tick_once(0.01) == Status::Success);
}

TEST_CASE("another thread ends the wait of a loop for its next period") {
  const runtime::Project project = project_of("<Step/>");
  runtime::RunSettings settings;
  settings.tick_period = 60;
  runtime::Run run(project, settings);
  std::atomic<int> ticks = 0;
  run.on_tick([&](std::uint64_t, double, Status) { ++ticks; });
  std::thread other([&] {
    for (int seen = 0; seen < 4;) {
      if (ticks == seen) {
        std::this_thread::yield();
        continue;
      }
      seen = ticks;
      run.wake();
    }
  });
  const auto result = run.loop();
  other.join();
  CHECK(result.ticks == 4);
  CHECK(result.seconds < 30);
}

TEST_CASE("a leaf ends the wait of a loop from a thread of its own") {
  runtime::Project project;
  project.add_leaf<Asks>("Asks", "Asks a thread");
  project.load_text(tree("<Sequence memory=\"true\"><Asks/><Asks/><Asks/></Sequence>"));
  runtime::RunSettings settings;
  settings.tick_period = 60;
  runtime::Run run(project, settings);
  const auto result = run.loop();
  CHECK(result.status == Status::Success);
  CHECK(result.seconds < 30);
}

TEST_CASE("a node that is watched is told before and after each tick, and gets another result") {
  const runtime::Project project = project_of(
      "<Sequence><Step name=\"a\" step=\"0.5\"/><Step name=\"b\" step=\"0.5\"/></Sequence>");
  struct Seen {
    std::vector<std::array<int, 3>> calls;
    lockstep_status before = LOCKSTEP_IDLE, after = LOCKSTEP_IDLE;
  } seen;
  const auto watch = [](void* user, lockstep_run*, std::uint32_t node, std::int32_t what,
                        lockstep_status status) -> lockstep_status {
    auto& it = *static_cast<Seen*>(user);
    it.calls.push_back({static_cast<int>(node), what, status});
    if (what == LOCKSTEP_BEFORE_TICK) return it.before;
    return what == LOCKSTEP_AFTER_TICK ? it.after : LOCKSTEP_IDLE;
  };
  using Calls = decltype(seen.calls);
  runtime::Run run(project);
  const std::array<std::uint32_t, 2> nodes{0, 1};
  REQUIRE(lockstep_run_watch_nodes(run.get(), nodes.data(), nodes.size(), watch, &seen));
  CHECK(run.tick(0) == Status::Running);
  CHECK(seen.calls == Calls{{0, 0, 0}, {1, 0, 0}, {1, 1, 1}, {0, 1, 1}});
  seen.calls.clear();
  run.halt();
  CHECK(seen.calls == Calls{{0, 2, 0}, {1, 2, 0}, {1, 3, 0}, {0, 3, 0}});
  seen.before = LOCKSTEP_FAILURE;
  CHECK(run.tick(0.01) == Status::Failure);
  seen.before = LOCKSTEP_IDLE;
  CHECK(run.tick(0.02) == Status::Running);
  seen.after = LOCKSTEP_SUCCESS;
  calls.clear();
  CHECK(run.tick(0.03) == Status::Success);
  CHECK(calls == Strings{"halt"});
  seen.after = 7;
  CHECK(error_of([&] { run.tick(0.04); }).find("has returned status 7") != std::string::npos);
  REQUIRE(lockstep_run_watch_nodes(run.get(), nullptr, 0, nullptr, nullptr));
  seen.calls.clear();
  run.restart(0);
  CHECK(run.tick(0) == Status::Running);
  CHECK(seen.calls.empty());
  const std::uint32_t none = 99;
  CHECK_FALSE(lockstep_run_watch_nodes(run.get(), &none, 1, watch, &seen));
}

// A watcher that returns `given` once.
struct WatchedOnce {
  std::int32_t what = LOCKSTEP_BEFORE_TICK;
  lockstep_status status = LOCKSTEP_IDLE;  // of the node then
  lockstep_status given = LOCKSTEP_IDLE;

  static lockstep_status call(void* user, lockstep_run*, std::uint32_t, std::int32_t what,
                              lockstep_status status) {
    auto& it = *static_cast<WatchedOnce*>(user);
    if (what != it.what || status != it.status) return LOCKSTEP_IDLE;
    return std::exchange(it.given, LOCKSTEP_IDLE);
  }
};

TEST_CASE("a status of a watcher that is none is a fault of the node, and leaves its leaf whole") {
  struct Row {
    WatchedOnce watch;
    bool fails_on_fault;
    Strings calls;  // of three ticks and a halt
  };
  const Strings whole = {"start", "tick", "tick"};
  const lockstep_status none = 77;
  const std::vector<Row> rows = {
      // Before its first tick, it is not started.
      {{LOCKSTEP_BEFORE_TICK, LOCKSTEP_IDLE, LOCKSTEP_RUNNING}, true, {}},
      {{LOCKSTEP_BEFORE_TICK, LOCKSTEP_IDLE, none}, true, {}},
      {{LOCKSTEP_BEFORE_TICK, LOCKSTEP_IDLE, LOCKSTEP_RUNNING}, false, {}},
      {{LOCKSTEP_BEFORE_TICK, LOCKSTEP_IDLE, none}, false, {}},
      // One that runs is halted.
      {{LOCKSTEP_BEFORE_TICK, LOCKSTEP_RUNNING, LOCKSTEP_RUNNING}, true, {"start", "tick", "halt"}},
      {{LOCKSTEP_BEFORE_TICK, LOCKSTEP_RUNNING, none}, false, {"start", "tick", "halt"}},
      {{LOCKSTEP_AFTER_TICK, LOCKSTEP_RUNNING, none}, true, {"start", "tick", "halt"}},
      {{LOCKSTEP_AFTER_TICK, LOCKSTEP_RUNNING, none}, false, {"start", "tick", "halt"}},
      // One that has ended is not.
      {{LOCKSTEP_AFTER_TICK, LOCKSTEP_SUCCESS, LOCKSTEP_RUNNING}, true, {"start", "tick", "tick"}},
      {{LOCKSTEP_AFTER_TICK, LOCKSTEP_SUCCESS, none}, true, {"start", "tick", "tick"}},
      {{LOCKSTEP_AFTER_TICK, LOCKSTEP_SUCCESS, LOCKSTEP_RUNNING}, false, {"start", "tick", "tick"}},
      {{LOCKSTEP_AFTER_TICK, LOCKSTEP_SUCCESS, none}, false, {"start", "tick", "tick"}},
  };
  runtime::Project project;
  project.add_leaf<Told>("Told", "Has two ticks");
  project.load_text(tree("<Told/>"));
  for (const Row& row : rows) {
    INFO(row.watch.what << " " << row.watch.status << " " << row.watch.given << " "
                        << row.fails_on_fault);
    calls.clear();
    runtime::Run run(project, {0, 0.01, row.fails_on_fault});
    WatchedOnce watch = row.watch;
    const std::uint32_t node = 0;
    REQUIRE(lockstep_run_watch_nodes(run.get(), &node, 1, WatchedOnce::call, &watch));
    for (int tick = 0; watch.given != LOCKSTEP_IDLE; ++tick) {
      REQUIRE(tick < 3);
      const bool is_fault = error_of([&] { run.tick(tick); }) != "no error";
      CHECK(is_fault == (!row.fails_on_fault && watch.given == LOCKSTEP_IDLE));
    }
    if (row.fails_on_fault) CHECK(run.node(0).status == Status::Failure);
    CHECK(calls == row.calls);
    if (!row.fails_on_fault) run.recover();
    CHECK(calls == row.calls);
    calls.clear();
    CHECK(run.tick(5) == Status::Running);
    CHECK(run.tick(6) == Status::Success);
    CHECK(calls == whole);
  }
}

TEST_CASE("a leaf whose halt is a fault is not halted again when its watcher gives a result") {
  runtime::Project project;
  project.add_leaf<Told>("Told", "Has two ticks");
  project.load_text(tree("<Told/>"));
  calls.clear();
  Told::breaks = true;
  runtime::Run run(project);
  WatchedOnce watch{LOCKSTEP_AFTER_TICK, LOCKSTEP_RUNNING, LOCKSTEP_SUCCESS};
  const std::uint32_t node = 0;
  REQUIRE(lockstep_run_watch_nodes(run.get(), &node, 1, WatchedOnce::call, &watch));
  CHECK(error_of([&] { run.tick(0); }) == "Main/Told: cannot halt");
  run.recover();
  CHECK(calls == Strings{"start", "tick", "halt"});
  Told::breaks = false;
}

TEST_CASE("a node that a leaf before it begins to watch is reported in the same tick") {
  runtime::Project project;
  project.add_leaf<DoesAsTold>("DoesAsTold", "Does what the test says");
  project.add_leaf<Step>("Step", "Makes a step");
  project.load_text(tree("<Parallel><DoesAsTold/><Step step=\"0.1\"/></Parallel>"));
  std::vector<std::uint32_t> told;  // outlives the run, whose end halts the node
  runtime::Run run(project);
  const auto watch = [](void* user, lockstep_run*, std::uint32_t node, std::int32_t,
                        lockstep_status) -> lockstep_status {
    static_cast<std::vector<std::uint32_t>*>(user)->push_back(node);
    return LOCKSTEP_IDLE;
  };
  DoesAsTold::in_tick = [] {};
  CHECK(run.tick(0) == Status::Running);
  const std::uint32_t step = 2;
  DoesAsTold::in_tick = [&] {
    if (told.empty()) REQUIRE(lockstep_run_watch_nodes(run.get(), &step, 1, watch, &told));
  };
  CHECK(run.tick(0.01) == Status::Running);
  CHECK(told == std::vector<std::uint32_t>{2, 2});  // before its tick and after it
}

TEST_CASE("a run of a program is recorded and has a monitor, from its first tick to its end") {
  const runtime::Project project = project_of("<Step/>");
  const std::string file = std::filesystem::temp_directory_path() /
                           ("lockstep_embedded_" + std::to_string(getpid()) + ".jsonl");
  {
    runtime::Run run(project);
    run.record(file);
    CHECK(run.monitor("0").find("http://127.0.0.1:") == 0);
    CHECK(error_of([&] { run.record(file); }).find("is recorded already") != std::string::npos);
    for (int i = 0; run.tick(i * 0.01) == Status::Running; ++i) {
    }
    CHECK(error_of([&] { run.monitor("0"); }) ==
          "the run has been ticked already: it is watched from its first tick on");
  }
  std::ifstream stream(file);
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  CHECK(text.find("\"end\"") != std::string::npos);
  CHECK(std::count(text.begin(), text.end(), '\n') == 6);
  runtime::Run looped(project);
  looped.record(file);
  CHECK(looped.loop({true}).ticks == 4);
  std::filesystem::remove(file);
  CHECK_THROWS(runtime::Run(project).record("/no/such/folder/run.jsonl"));
}

TEST_CASE("the log of a program learns once that its recording cannot be written") {
  const runtime::Project project = project_of("<Step/>");
  std::string logged;
  runtime::RunSettings settings;
  settings.log = [&](const std::string& who, lockstep::LogLevel, const std::string& text) {
    logged += who + ": " + text + "\n";
  };
  runtime::Run run(project, settings);
  run.record("/dev/full");
  for (int i = 0; run.tick(i * 0.01) == Status::Running; ++i) {
  }
  CHECK(logged == "lockstep: cannot write '/dev/full': No space left on device\n");
}

TEST_CASE("on the virtual clock, the last recorded tick of a program lasts a whole period") {
  const runtime::Project project = project_of("<Step step=\"0.001\"/>");
  const std::string file = std::filesystem::temp_directory_path() /
                           ("lockstep_times_" + std::to_string(getpid()) + ".jsonl");
  {
    runtime::RunSettings settings;
    settings.virtual_time = true;
    runtime::Run run(project, settings);
    run.record(file);
    for (int i = 0; i < 10; ++i) CHECK(run.tick(i * 0.01) == Status::Running);
  }
  std::ifstream stream(file);
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  CHECK(text.find(R"("ticks":10,"time_s":0.1,)") != std::string::npos);
  std::filesystem::remove(file);
}

TEST_CASE("the recording of a run that its program ends has the reason stopped, and no signal") {
  const runtime::Project project = project_of("<Step step=\"0.001\"/>");
  const std::string file = std::filesystem::temp_directory_path() /
                           ("lockstep_stopped_" + std::to_string(getpid()) + ".jsonl");
  {
    runtime::Run run(project);
    run.record(file);
    SECTION("between two ticks") {
      CHECK(run.tick(0) == Status::Running);
    }
    SECTION("in a loop") {
      int ticks = 0;
      runtime::LoopSettings settings;
      settings.virtual_clock = true;
      settings.stop = [&] { return ++ticks == 3; };
      CHECK(run.loop(settings).reason == runtime::LoopResult::Reason::Stopped);
    }
  }
  std::ifstream stream(file);
  const std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  CHECK(text.find(R"("reason":"stopped")") != std::string::npos);
  CHECK(text.find("signal") == std::string::npos);
  std::filesystem::remove(file);
}

TEST_CASE("a call that takes longer than the budget, or does not return, is reported") {
  runtime::Project project;
  project.add_leaf<Slow>("Slow", "Waits");
  project.load_text(tree("<Slow/>"));
  runtime::RunSettings settings;
  settings.tick_budget = 1e-9;
  settings.hang_limit = 0.001;
  std::string line;
  settings.log = [&](const std::string& who, lockstep::LogLevel, const std::string& text) {
    line = who + " " + text;
  };
  settings.hang = [](const std::string& who, const std::string& function, double) {
    Slow::told = who + " " + function;
    Slow::is_told = true;
  };
  runtime::Run run(project, settings);
  CHECK(run.tick(0) == Status::Success);
  CHECK(line.find("Main/Slow took ") == 0);
  CHECK(line.find("more than the budget of 0.000 ms") != std::string::npos);
  CHECK(Slow::told.find("Slow") != std::string::npos);
  CHECK(Slow::told.find("tick") != std::string::npos);
}

TEST_CASE("a program answers what its tree asks") {
  const runtime::Project project = project_of(
      "<Sequence memory=\"true\"><Script code=\"n := 2\"/>"
      "<Ask text=\"Take {n}?\" options=\"all;one\" answer=\"{chosen}\"/></Sequence>");
  constexpr std::uint32_t kAsk = 2;
  runtime::Run run(project);
  CHECK_FALSE(run.question(kAsk));
  CHECK_THROWS(run.answer(kAsk, "one"));  // nobody has asked yet
  CHECK(run.tick(0) == Status::Running);
  CHECK(run.question(kAsk) == "Take 2?");
  CHECK_FALSE(run.question(0));
  CHECK(error_of([&] { run.answer(kAsk, "none"); }) ==
        "'none' is no answer to 'Main/Sequence/Ask'");
  CHECK(error_of([&] { run.answer(0, "one"); }) == "the node asks nothing");
  CHECK(error_of([&] { run.answer(99, "one"); }) == "no such node");
  run.answer(kAsk, "one", "a test");
  CHECK(run.tick(1) == Status::Success);
  CHECK(run.get<std::string>("chosen") == "one");
  CHECK_FALSE(run.question(kAsk));
}

TEST_CASE("a leaf that has the name of a later node of the language stays what it is") {
  runtime::Project project;
  project.add_leaf<Step>("Ask", "Was there before");
  project.load_text(tree("<Ask name=\"mine\" step=\"0.5\"/>"));
  runtime::Run run(project);
  CHECK(run.tick(0) == Status::Running);
  CHECK(run.node(0).progress == 0.5);
  CHECK(run.tick(1) == Status::Success);
}
