// Threaded leaves for trees on the virtual clock: they sleep, log, and may block.
#include <condition_variable>
#include <lockstep/leaf.hpp>
#include <mutex>

namespace {

using lockstep::Status;

struct SleepPorts : lockstep::Ports {
  Input<std::int64_t> steps{this, "steps", "4", "sleeps"};
  Input<double> seconds{this, "seconds", "0.1", "of each", "s"};
};

class Sleeps : public lockstep::ThreadedAction<SleepPorts> {
 public:
  void begin() override {
    steps_ = steps.get();
    seconds_ = seconds.get();
  }
  Status run(lockstep::Token& token) override {
    for (std::int64_t step = 0; step < steps_; ++step) {
      log("step " + std::to_string(step));
      if (!token.sleep_for(std::chrono::duration<double>(seconds_))) return Status::Failure;
      if (!token.wait_while_paused()) return Status::Failure;
      token.set_progress(static_cast<double>(step + 1) / static_cast<double>(steps_));
    }
    return Status::Success;
  }

 private:
  std::int64_t steps_ = 0;
  double seconds_ = 0;
};

struct YieldPorts : lockstep::Ports {
  Input<std::int64_t> times{this, "times", "100", "yields"};
};

class Yields : public lockstep::ThreadedAction<YieldPorts> {
 public:
  void begin() override { times_ = times.get(); }
  Status run(lockstep::Token& token) override {
    for (std::int64_t i = 0; i < times_ && !token.stop_requested(); ++i) token.yield();
    return Status::Success;
  }

 private:
  std::int64_t times_ = 0;
};

// Waits for what never comes.
class Blocks : public lockstep::ThreadedAction<> {
 public:
  Status run(lockstep::Token&) override {
    std::mutex mutex;
    std::condition_variable never;
    std::unique_lock<std::mutex> lock(mutex);
    never.wait(lock, [] { return false; });
    return Status::Success;
  }
};

class Throws : public lockstep::ThreadedAction<> {
 public:
  Status run(lockstep::Token& token) override {
    token.sleep_for(std::chrono::milliseconds(35));
    throw std::runtime_error("the planner is gone");
  }
};

}  // namespace

LOCKSTEP_PLUGIN("threaded", "1.0", "Threaded leaves for tests",
                lockstep::leaf<Sleeps>("Sleeps", "Sleeps and logs"),
                lockstep::leaf<Yields>("Yields", "Yields and does nothing else"),
                lockstep::leaf<Blocks>("Blocks", "Never returns"),
                lockstep::leaf<Throws>("Throws", "Throws after a while"));
