// A ThreadedAction from start to end. The test and the work meet at gates; nobody sleeps. The work
// checks nothing itself: assertions belong to the test's thread.
#include <catch2/catch.hpp>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <stdexcept>
#include <thread>

#include "fake_host.h"
#include "lockstep/leaf.hpp"

namespace {

using lockstep::Status;
using lockstep::Token;
using sdk_test::FakeLeaf;
using sdk_test::PortValue;

class Gate {
 public:
  void open() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      open_ = true;
    }
    changed_.notify_all();
  }
  void wait() {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait(lock, [this] { return open_; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool open_ = false;
};

struct WorkPorts : lockstep::Ports {
  Input<double> in{this, "in", "0", ""};
  Output<double> out{this, "out", ""};
};

class Work : public lockstep::ThreadedAction<WorkPorts> {
 public:
  using ThreadedAction::log;
  using ThreadedAction::now;
  using ThreadedAction::random;

  void begin() override { value = in.get(); }
  Status run(Token& token) override { return work(*this, token); }
  void finish(Status) override { out.set(value); }

  double value = 0;
  static inline std::function<Status(Work&, Token&)> work;
};

constexpr lockstep_leaf_type kWork = lockstep::leaf<Work>("Work", "");

lockstep_status tick_to_end(FakeLeaf& leaf) {
  lockstep_status status = LOCKSTEP_RUNNING;
  while (leaf.host.error.empty() && status == LOCKSTEP_RUNNING) {
    status = leaf.tick();
    std::this_thread::yield();
  }
  return status;
}

Status work_until_halted(Work&, Token& token) {
  while (token.sleep_for(std::chrono::hours(1))) {
  }
  return Status::Failure;
}

}  // namespace

TEST_CASE("the work runs beside the ticks, and its result is the action's", "[sdk]") {
  const Status result = GENERATE(Status::Success, Status::Failure);
  Gate finish;
  Work::work = [&](Work& it, Token&) {
    finish.wait();
    it.value *= 2;
    return result;
  };
  FakeLeaf leaf(kWork, {2.5, 0.0});
  leaf.start();
  CHECK(leaf.tick() == LOCKSTEP_RUNNING);
  CHECK(leaf.tick() == LOCKSTEP_RUNNING);
  finish.open();
  CHECK(tick_to_end(leaf) == static_cast<lockstep_status>(result));
  CHECK(leaf.host.ports[1] == PortValue(5.0));
}

TEST_CASE("progress is what the work last said, and begins at 0", "[sdk]") {
  Gate said, go_on;
  Work::work = [&](Work&, Token& token) {
    token.set_progress(0.75);
    said.open();
    go_on.wait();
    return Status::Success;
  };
  FakeLeaf leaf(kWork, {0.0, 0.0});
  CHECK(leaf.progress() == 0);
  leaf.start();
  said.wait();
  CHECK(leaf.progress() == 0.75);
  go_on.open();
  CHECK(tick_to_end(leaf) == LOCKSTEP_SUCCESS);
  Work::work = work_until_halted;
  leaf.start();
  CHECK(leaf.progress() == 0);
  leaf.halt();
}

TEST_CASE("halt stops the work and waits for it", "[sdk]") {
  bool ended = false;
  Work::work = [&](Work& it, Token& token) {
    const Status status = work_until_halted(it, token);
    ended = token.stop_requested();
    return status;
  };
  FakeLeaf leaf(kWork, {0.0, 1.0});
  leaf.start();
  CHECK(leaf.tick() == LOCKSTEP_RUNNING);
  leaf.halt();
  CHECK(ended);
  CHECK(leaf.host.error.empty());
  CHECK(leaf.host.ports[1] == PortValue(1.0));
}

TEST_CASE("paused work waits until it is resumed", "[sdk]") {
  Gate paused, waiting;
  std::atomic<bool> resumed = false;
  Work::work = [&](Work&, Token& token) {
    paused.wait();
    const bool told = token.pause_requested();
    waiting.open();
    const bool go_on = token.wait_while_paused();
    return told && go_on && resumed ? Status::Success : Status::Failure;
  };
  FakeLeaf leaf(kWork, {0.0, 0.0});
  leaf.start();
  leaf.pause();
  paused.open();
  waiting.wait();
  CHECK(leaf.tick() == LOCKSTEP_RUNNING);
  resumed = true;
  leaf.resume();
  CHECK(tick_to_end(leaf) == LOCKSTEP_SUCCESS);
}

TEST_CASE("halt ends a pause", "[sdk]") {
  Gate waiting;
  bool go_on = true;
  Work::work = [&](Work&, Token& token) {
    waiting.open();
    while (token.wait_while_paused()) {
    }
    go_on = false;
    return Status::Failure;
  };
  FakeLeaf leaf(kWork, {0.0, 0.0});
  leaf.start();
  leaf.pause();
  waiting.wait();
  leaf.halt();
  CHECK_FALSE(go_on);
}

TEST_CASE("an exception in the work is the leaf's error at the next tick", "[sdk]") {
  Work::work = [](Work&, Token&) -> Status { throw std::runtime_error("motor is hot"); };
  FakeLeaf leaf(kWork, {0.0, 0.0});
  leaf.start();
  tick_to_end(leaf);
  CHECK(leaf.host.take_error() == "motor is hot");
  leaf.halt();
  CHECK(leaf.host.take_error().empty());
}

TEST_CASE("an exception that halt finds is not lost", "[sdk]") {
  Work::work = [](Work& it, Token& token) -> Status {
    work_until_halted(it, token);
    throw 42;
  };
  FakeLeaf leaf(kWork, {0.0, 0.0});
  leaf.start();
  leaf.halt();
  CHECK(leaf.host.take_error() == "an exception that is not a std::exception");
}

TEST_CASE("work that returns Running is an error", "[sdk]") {
  Work::work = [](Work&, Token&) { return Status::Running; };
  FakeLeaf leaf(kWork, {0.0, 0.0});
  leaf.start();
  tick_to_end(leaf);
  CHECK(leaf.host.take_error() == "run() returned neither success nor failure");
}

TEST_CASE("an action is active again after success, failure, halt and error", "[sdk]") {
  FakeLeaf leaf(kWork, {0.0, 0.0});
  const auto once = [&](std::function<Status(Work&, Token&)> work) {
    Work::work = std::move(work);
    leaf.start();
    return tick_to_end(leaf);
  };
  const auto succeed = [](Work&, Token& token) {
    return token.stop_requested() || token.pause_requested() ? Status::Failure : Status::Success;
  };
  CHECK(once(succeed) == LOCKSTEP_SUCCESS);
  CHECK(once([](Work&, Token&) { return Status::Failure; }) == LOCKSTEP_FAILURE);
  once([](Work&, Token&) -> Status { throw 42; });
  CHECK_FALSE(leaf.host.take_error().empty());
  Work::work = work_until_halted;
  leaf.start();
  leaf.pause();
  leaf.halt();
  CHECK(once(succeed) == LOCKSTEP_SUCCESS);
}

TEST_CASE("the work may log, but not use ports, time or random numbers", "[sdk]") {
  const auto use = GENERATE(
      as<std::function<void(Work&)>>(), [](Work& it) { it.in.get(); },
      [](Work& it) { it.out.set(1); }, [](Work& it) { it.now(); }, [](Work& it) { it.random(); });
  Work::work = [&](Work& it, Token&) {
    it.log("at work");
    use(it);
    return Status::Success;
  };
  FakeLeaf leaf(kWork, {0.0, 0.0});
  leaf.start();
  tick_to_end(leaf);
  CHECK(leaf.host.lines == std::vector<std::string>{"1 at work"});
  CHECK(leaf.host.take_error() ==
        "ports, time and random numbers belong to begin() and finish(), not run()");
}

TEST_CASE("an error in begin starts no work", "[sdk]") {
  bool worked = false;
  Work::work = [&](Work&, Token&) {
    worked = true;
    return Status::Success;
  };
  FakeLeaf leaf(kWork, std::vector<PortValue>(2));
  leaf.start();
  CHECK(leaf.host.take_error() == "port 'in' has no value");
  leaf.destroy();
  CHECK_FALSE(worked);
}

TEST_CASE("a leaf that is destroyed at work stops it first", "[sdk]") {
  bool ended = false;
  Work::work = [&](Work& it, Token& token) {
    work_until_halted(it, token);
    it.value = 1;
    ended = true;
    return Status::Failure;
  };
  FakeLeaf leaf(kWork, {0.0, 0.0});
  leaf.start();
  leaf.destroy();
  CHECK(ended);
}
