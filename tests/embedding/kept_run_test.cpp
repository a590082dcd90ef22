// Runs of a program that are kept in a file: what a program gets and must not do. That they
// continue after a kill is in kept_test.py. Here a copy of the file stands for that of a process
// that was killed.
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <lockstep/runtime.hpp>

#include "error_of.h"

namespace {

namespace fs = std::filesystem;
namespace runtime = lockstep::runtime;
using lockstep::Status;

struct CountPorts : lockstep::Ports {
  Input<std::int64_t> ticks{this, "ticks", "4", "how many"};
};

class Count : public lockstep::Action<CountPorts> {
 public:
  void start() override { done_ = 0; }
  Status tick() override { return ++done_ == ticks.get() ? Status::Success : Status::Running; }
  double progress() const override {
    return static_cast<double>(done_) / static_cast<double>(ticks.get());
  }

 private:
  std::int64_t done_ = 0;
};

// Cannot be restored.
class Breaks : public lockstep::Action<>, public lockstep::Kept<int> {
 public:
  Status tick() override { return Status::Running; }
  lockstep::AfterCut after_cut(const lockstep::Cut&) override {
    throw std::runtime_error("the table is gone");
  }
};

// A robot keeps its speed until it is told another one.
struct Moved {
  double at = 0, factor = 1;
};

struct MovePorts : lockstep::Ports {
  Input<double> step{this, "step", "0.1", "in each tick, at full speed"};
};

class Move : public lockstep::Action<MovePorts>, public lockstep::Kept<Moved> {
 public:
  Status tick() override {
    kept.at += step.get() * kept.factor;
    return kept.at >= 1 ? Status::Success : Status::Running;
  }
  double progress() const override { return kept.at < 1 ? kept.at : 1; }
  double set_pace(double factor) override { return kept.factor = factor; }
};

// The second one cannot be made.
class Unique : public lockstep::Action<> {
 public:
  Unique() {
    if (made++ > 0) throw std::runtime_error("the driver is gone");
  }
  Status tick() override { return Status::Running; }
  static inline int made = 0;
};

class KeptRuns {
 public:
  explicit KeptRuns(const std::string& nodes) {
    fs::create_directory(folder_);
    project_.add_leaf<Count>("Count", "Counts its ticks").add_leaf<Breaks>("Breaks", "Does");
    project_.add_leaf<Unique>("Unique", "Is made once").add_leaf<Move>("Move", "Moves");
    project_.load_text("<root lockstep=\"1\"><BehaviorTree ID=\"Main\">" + nodes +
                       "</BehaviorTree></root>");
  }
  ~KeptRuns() { fs::remove_all(folder_); }
  KeptRuns(const KeptRuns&) = delete;
  KeptRuns& operator=(const KeptRuns&) = delete;

  runtime::Run run(decltype(runtime::RunSettings::log) log = {}) const {
    runtime::RunSettings settings;
    settings.log = std::move(log);
    settings.tick_period = 0.1;
    settings.virtual_time = true;  // each tick is in the file
    return runtime::Run(project_, settings);
  }
  std::string file() const { return folder_ / "run.checkpoint"; }
  // As a kill would leave it now.
  std::string cut() const {
    fs::copy_file(file(), folder_ / "cut", fs::copy_options::overwrite_existing);
    return folder_ / "cut";
  }

 private:
  const fs::path folder_ =
      fs::temp_directory_path() / ("lockstep_kept_" + std::to_string(getpid()));
  runtime::Project project_;
};

}  // namespace

TEST_CASE("a program that resumes a run gets its time, its ticks and what its leaves do") {
  const KeptRuns runs(
      "<Parallel><Count name=\"a\"/><Count name=\"b\" on_resume=\"failure\"/></Parallel>");
  runtime::Run first = runs.run();
  CHECK_FALSE(first.keep(runs.file()));
  for (int tick = 0; tick < 3; ++tick) first.tick(0.1 * tick);
  runtime::KeepSettings settings;
  settings.on_resume = Status::Success;
  const std::string cut = runs.cut();
  runtime::Run second = runs.run();
  const auto resumed = second.keep(cut, settings);
  REQUIRE(resumed);
  CHECK(resumed->ticks == 3);
  CHECK(resumed->seconds == Approx(0.2));
  CHECK(resumed->gap >= 0);
  CHECK(resumed->text.find("; 'Main/Parallel/a' counts as succeeded") != std::string::npos);
  REQUIRE(resumed->leaves.size() == 2);
  CHECK(resumed->leaves[0].node == 1);
  CHECK(resumed->leaves[0].status == Status::Success);
  CHECK(resumed->leaves[1].status == Status::Failure);
  CHECK_FALSE(resumed->leaves[0].asked);
  CHECK(error_of([&] { second.tick(0.1); }) == "the time is before that of the last tick");
  std::uint64_t seen = 0;
  second.on_tick([&](std::uint64_t tick, double, Status) { seen = tick; });
  CHECK(second.tick(0.3) == Status::Failure);  // of b
  CHECK(seen == 3);
  CHECK(second.node(1).status == Status::Success);
  CHECK_FALSE(second.not_kept());
}

TEST_CASE("an answer that a program gives between two ticks outlasts a cut") {
  const KeptRuns runs("<Ask text=\"Well?\"/>");
  runtime::Run first = runs.run();
  CHECK_FALSE(first.keep(runs.file()));
  CHECK(first.tick(0) == Status::Running);
  first.answer(0, "no");
  const std::string cut = runs.cut();
  runtime::Run second = runs.run();
  REQUIRE(second.keep(cut));
  CHECK(second.tick(0.1) == Status::Failure);
}

TEST_CASE("a run that is given its times is resumed at the last of them") {
  const KeptRuns runs("<Count/>");
  runtime::Run first = runs.run();
  CHECK_FALSE(first.keep(runs.file()));
  for (const double time : {0.0, 0.25, 0.9}) first.tick(time);
  runtime::Run second = runs.run();
  const auto resumed = second.keep(runs.cut());
  REQUIRE(resumed);
  CHECK(resumed->ticks == 3);
  CHECK(resumed->seconds == Approx(0.9));
  CHECK_THROWS(second.tick(0.5));  // before the last one
  CHECK(second.tick(1.3) == Status::Running);
}

TEST_CASE("properties continue with the run, and a line names those that begin after the cut") {
  const KeptRuns runs("<Count name=\"a\" ticks=\"6\"/>");
  const auto check = [](runtime::Run& run, const std::string& property) {
    REQUIRE(lockstep_run_check(run.get(), property.c_str()));
  };
  runtime::Run first = runs.run();
  check(first, "late: a.success only after a.progress >= 0.9");
  check(first, "slow: never a.progress > 0.3");
  first.keep(runs.file());
  for (int tick = 0; tick < 3; ++tick) first.tick(0.1 * tick);
  std::vector<std::string> told;
  runtime::Run second = runs.run([&](auto, auto, auto line) { told.emplace_back(line); });
  check(second, "slow: never a.progress > 0.3");
  const std::string cut = runs.cut();
  REQUIRE(second.keep(cut));
  check(second, "late: a.success only after a.progress >= 0.9");
  check(second, "fresh: never a.failure");
  REQUIRE(lockstep_run_violation(second.get(), 0) != nullptr);
  CHECK(std::string(lockstep_run_violation(second.get(), 0)) ==
        "slow: violated in tick 2, before the cut");
  CHECK(lockstep_run_violation(second.get(), 1) == nullptr);
  CHECK(std::ranges::count(
            told, "the property 'fresh' was not checked before the cut: it begins here") == 1);
  CHECK(std::ranges::count_if(
            told, [](const auto& it) { return it.find("begins here") != it.npos; }) == 1);
}

TEST_CASE("a run that paces continues after a cut as if there was none, tick by tick") {
  const KeptRuns runs(
      "<ParallelAbsolute barriers=\"0.5\" pace=\"true\"><Move name=\"slow\"/>"
      "<Move name=\"fast\" step=\"0.3\"/></ParallelAbsolute>");
  using Trace = std::vector<double>;
  // From this tick on, after each: the progress of both. It is cut after so many ticks.
  const auto trace = [](runtime::Run& run, std::uint64_t tick, std::uint64_t most) {
    Trace seen;
    for (Status status = Status::Running; status == Status::Running && tick < most; ++tick) {
      status = run.tick(0.1 * static_cast<double>(tick));
      for (const std::uint32_t node : {1u, 2u}) seen.push_back(run.node(node).progress);
    }
    return seen;
  };
  runtime::Run whole = runs.run();
  const Trace expected = trace(whole, 0, 100);
  const std::uint64_t ticks = expected.size() / 2;
  REQUIRE(ticks > 9);
  for (std::uint64_t cut_at = 1; cut_at < ticks; ++cut_at) {
    INFO("cut after " << cut_at << " ticks");
    runtime::Run first = runs.run();
    first.keep(runs.file());
    Trace seen = trace(first, 0, cut_at);
    runtime::Run second = runs.run();
    REQUIRE(second.keep(runs.cut())->ticks == cut_at);
    const Trace rest = trace(second, cut_at, 100);
    seen.insert(seen.end(), rest.begin(), rest.end());
    CHECK(seen == expected);
    fs::remove(runs.file());
  }
}

TEST_CASE("a loop continues a run that is resumed") {
  const KeptRuns runs("<Count ticks=\"6\"/>");
  runtime::Run first = runs.run();
  first.keep(runs.file());
  for (int tick = 0; tick < 3; ++tick) first.tick(0.1 * tick);
  runtime::Run second = runs.run();
  const std::string cut = runs.cut();
  REQUIRE(second.keep(cut));
  runtime::LoopSettings loop;
  loop.virtual_clock = true;
  const runtime::LoopResult result = second.loop(loop);
  CHECK(result.ticks == 9);  // it counts anew
  CHECK(result.seconds == Approx(0.9));
  CHECK_FALSE(runs.run().keep(cut));  // it has ended
}

TEST_CASE("a result, a halt and a restart are no cuts, but the next tick may be cut") {
  const KeptRuns runs("<Count ticks=\"2\"/>");
  const auto is_cut = [&] { return runs.run().keep(runs.cut()).has_value(); };
  runtime::Run run = runs.run();
  run.keep(runs.file());
  CHECK_FALSE(is_cut());
  run.tick(0);
  CHECK(is_cut());
  CHECK(run.tick(0.1) == Status::Success);
  CHECK_FALSE(is_cut());
  run.tick(0.2);
  CHECK(is_cut());
  run.halt();
  CHECK_FALSE(is_cut());
  run.tick(0.3);
  CHECK(is_cut());
  run.restart(0);
  CHECK_FALSE(is_cut());
  run.tick(0);
  CHECK_FALSE(is_cut());  // it is not kept any more
  run.restart(0);
  CHECK_FALSE(run.keep(runs.file()));
  run.tick(0);
  CHECK(is_cut());
}

TEST_CASE("a leaf that breaks when it is restored ends the run, which may recover and is kept") {
  const KeptRuns runs("<Breaks/>");
  runtime::Run first = runs.run();
  first.keep(runs.file());
  first.tick(0);
  const std::string cut = runs.cut();
  {
    runtime::Run run = runs.run();
    CHECK(error_of([&] { run.keep(cut); }).find("the table is gone") != std::string::npos);
    run.recover();
    CHECK(run.tick(0.1) == Status::Running);
    fs::copy_file(cut, runs.file() + "2");
    runtime::Run third = runs.run();
    CHECK(error_of([&] { third.keep(runs.file() + "2"); }).find("the table is gone") !=
          std::string::npos);
  }
  CHECK_FALSE(runs.run().keep(cut));
}

TEST_CASE("a run whose leaves could not be made again is not kept before it is restarted") {
  const KeptRuns runs("<Unique/>");
  Unique::made = 0;
  runtime::Run run = runs.run();
  const std::string error = error_of([&] { run.restart(1); });
  CHECK(error.find("the driver is gone") != std::string::npos);
  CHECK_FALSE(lockstep_run_keep(run.get(), runs.file().c_str(), nullptr, nullptr));
  CHECK(lockstep_last_error() == error);
  CHECK_FALSE(fs::exists(runs.file()));
  Unique::made = 0;
  run.restart(1);
  CHECK_FALSE(run.keep(runs.file()));
  CHECK(run.tick(0) == Status::Running);
}

TEST_CASE("a program keeps a run from its first tick on, once, and before it is watched") {
  const KeptRuns runs("<Count ticks=\"9\"/>");
  runtime::Run run = runs.run();
  run.keep(runs.file());
  CHECK(error_of([&] { run.keep(runs.file()); }) == "the run is kept already");
  CHECK(error_of([&] { runs.run().keep(runs.file()); }).find("another run keeps its checkpoints") !=
        std::string::npos);
  runtime::Run ticked = runs.run();
  ticked.tick(0);
  CHECK(error_of([&] { ticked.keep(runs.file()); }) ==
        "the run has been ticked already: it is kept from its first tick on");
  runtime::Run watched = runs.run();
  watched.monitor("0");
  CHECK(error_of([&] { watched.keep(runs.file()); }) ==
        "the run is watched already: keep it first");
  runtime::KeepSettings settings;
  settings.sync = -1;
  CHECK(error_of([&] { runs.run().keep(runs.file(), settings); }) ==
        "sync is not a number of seconds");
  settings = {};
  settings.on_resume = Status::Running;
  CHECK(error_of([&] { runs.run().keep(runs.file(), settings); }) ==
        "on_resume is not LOCKSTEP_IDLE, LOCKSTEP_SUCCESS or LOCKSTEP_FAILURE");
  CHECK(error_of([&] { runs.run().keep("/no/such/folder/file"); }) != "no error");
}

TEST_CASE("a run whose state cannot be kept any more continues, and is not resumed") {
  const KeptRuns runs(
      "<Sequence memory=\"true\"><Script code=\"text := 'x'\"/><Count ticks=\"9\"/></Sequence>");
  std::string logged;
  runtime::Run run = runs.run([&](const std::string& who, lockstep::LogLevel,
                                  const std::string& text) { logged += who + ": " + text + "\n"; });
  run.keep(runs.file());
  run.tick(0);
  CHECK_FALSE(run.not_kept());
  // The disk is full.
  const auto before = signal(SIGXFSZ, SIG_IGN);
  rlimit limit{};
  getrlimit(RLIMIT_FSIZE, &limit);
  const rlimit small{1 << 20, limit.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  run.set("text", std::string(4 << 20, 'x'));
  CHECK(run.tick(0.1) == Status::Running);
  setrlimit(RLIMIT_FSIZE, &limit);
  signal(SIGXFSZ, before);
  REQUIRE(run.not_kept());
  CHECK(run.not_kept()->find("the checkpoint has nothing after 1 tick: cannot write '") == 0);
  CHECK(logged.find("lockstep: nothing is kept any more: cannot write '") == 0);
  CHECK(run.tick(0.2) == Status::Running);
  const std::string cut = runs.cut();
  CHECK(error_of([&] { runs.run().keep(cut); }).find("' has no state of its run after 1 tick: ") !=
        std::string::npos);
  run.restart(0);
  CHECK_FALSE(run.not_kept());
}
