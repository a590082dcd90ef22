// Leaves that say in the file LOG what happens to them, and end their process in the middle of a
// tick at the time CUT_AT of the run.
#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <lockstep/leaf.hpp>
#include <stdexcept>
#include <string>

namespace {

using lockstep::Status;

struct StepPorts : lockstep::Ports {
  Input<std::string> who{this, "who", "it", "what it says of itself"};
  Input<std::int64_t> number{this, "number", "0", "behind that; 0: none"};
  Input<std::int64_t> ticks{this, "ticks", "1", "so many until its result"};
  Input<bool> fails{this, "fails", "false", "its result"};
  Output<std::int64_t> count{this, "count", "its ticks"};
};

class Step : public lockstep::ProgressAction<StepPorts> {
 public:
  void start() override {
    done_ = 0;
    say("begins");
  }
  Status tick() override {
    const char* const cut = std::getenv("CUT_AT");
    if (cut != nullptr && now() > std::atof(cut) - 1e-6) kill(getpid(), SIGKILL);
    ++done_;
    count.set(done_);
    char at[32];
    std::snprintf(at, sizeof at, "at %.3f", share());
    say(at);
    set_progress(share());
    if (done_ < ticks.get()) return Status::Running;
    say(fails.get() ? "fails" : "succeeds");
    return fails.get() ? Status::Failure : Status::Success;
  }
  void halt() override { say("is halted"); }
  void pause() override { say("is held"); }
  void resume() override { say("goes on"); }
  double progress() const override {
    if (done_ < 0) say("is asked before it begins");
    return share();
  }

 protected:
  double share() const { return static_cast<double>(done_) / static_cast<double>(ticks.get()); }
  void say(const char* what) const {
    const char* const log = std::getenv("LOG");
    if (log == nullptr) return;
    const int file = open(log, O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0600);
    const std::string digits = number.get() == 0 ? "" : std::to_string(number.get());
    const std::string line = std::string(who.view()) + digits + " " + what + "\n";
    if (write(file, line.data(), line.size()) < 0) std::abort();
    close(file);
  }

  std::int64_t done_ = -1;
};

// A Step that goes on after a cut, over the two functions.
class Move : public Step {
 public:
  std::size_t save(void* bytes, std::size_t room) const override {
    const std::string text = std::to_string(done_);
    std::memcpy(bytes, text.data(), std::min(text.size(), room));
    return text.size();
  }
  lockstep::AfterCut restore(std::string_view bytes, const lockstep::Cut& cut) override {
    const char* const what = std::getenv("AFTER_CUT");
    const std::string word = what == nullptr ? "go on" : what;
    if (word == "begin") return lockstep::AfterCut::StartsAgain;
    if (word == "fail") return lockstep::AfterCut::CannotContinue;
    if (word == "throw") throw std::runtime_error("the arm is gone");
    if (cut.power || !(cut.gap >= 0) || cut.lost_ticks != 1) say("has another cut");
    done_ = std::stoll(std::string(bytes));
    set_progress(share());
    say(cut.held ? "is still held" : "goes on after the cut");
    if (cut.on_resume == LOCKSTEP_FAILURE) say("would fail");
    if (cut.on_resume == LOCKSTEP_SUCCESS) say("would succeed");
    return lockstep::AfterCut::Continues;
  }
};

// What `plugin check` finds: it continues, but from its beginning.
class Forget : public lockstep::Action<>, public lockstep::Kept<int> {
 public:
  Status tick() override { return ++kept < 9 ? Status::Running : Status::Success; }
  double progress() const override { return kept / 9.0; }
  lockstep::AfterCut after_cut(const lockstep::Cut&) override {
    kept = 0;
    return lockstep::AfterCut::Continues;
  }
};

}  // namespace

LOCKSTEP_PLUGIN("cut", "1.0", "Ends its process", lockstep::leaf<Step>("Step", "Counts ticks."),
                lockstep::leaf<Move>("Move", "Counts ticks, also over a cut."),
                lockstep::leaf<Forget>("Forget", "Counts ticks, and forgets them in a cut."));
