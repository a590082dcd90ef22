// A person who types: what comes next where the run pauses (`run --break`), and answers to what the
// tree asks. The loop gives it a picture of the run where it stands, or says that questions have
// changed; a thread of its own shows that, reads stdin, and gives orders to the run.
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "base/core/problem.h"
#include "base/system/file_descriptor.h"
#include "base/system/mutex.h"
#include "cli/run/break_conditions.h"
#include "judge/summary/why.h"
#include "record/live/open_questions.h"
#include "run/run_control.h"
#include "trace/observer.h"

namespace lockstep::host {

// "NODE[:before|after|success|failure|barrier]"; without a word: before.
Result<Breakpoint> parse_breakpoint(std::string_view text, const Shape& shape);

// Where a run pauses, as the command line gives it.
struct PausePlaces {
  std::vector<Breakpoint> breakpoints = {};
  std::vector<Property> conditions = {};

  bool empty() const { return breakpoints.empty() && conditions.empty(); }
};

class Prompt final : public Observer {
 public:
  // `shape`, `control` and `questions`, which may be null, must outlive this.
  Prompt(const Shape& shape, RunControl& control, const PausePlaces& places, bool is_real_time,
         const OpenQuestions* questions);
  ~Prompt() override;

  // Questions have come or gone. For any thread.
  void look_at_questions();

  AskedOfRun asked() const override {
    AskedOfRun asked = conditions_.asked();
    asked.within |= why_.asked().within;
    return asked;
  }
  void before_tick(const Moment& moment, std::uint64_t tick, Nanoseconds time) override;
  void after_tick(const Moment& moment, const TickReport& report) override;
  void standing(const Moment& moment) override;
  void run_ended(const Moment& moment, const RunEnd& end) override;

 private:
  // The run where it stands.
  struct Picture {
    std::string where;  // "after tick 31 (0.310 s): 'Main/grasp' failed"
    std::string why, entries;
    bool is_only_unattended = false;  // else somebody, or a breakpoint, has paused it
    bool is_own = false;              // a breakpoint or a condition of this prompt has
  };

  void live();
  void ask(const Picture& picture);
  void ask(const OpenQuestion& question);
  std::optional<OpenQuestion> next_question() const;
  // Nothing: stdin is closed, or meanwhile the run has ended or `is_over` has become true.
  std::optional<std::string> read_line(const std::function<bool()>& is_over);
  bool is_over();
  void take_wake() const;
  // False: the run goes on.
  bool obey(std::string_view line, const Picture& picture);
  void obey_break(std::string_view words, bool is_on);
  void set(const Breakpoint& breakpoint, bool is_on);
  void close();
  void obey_set(std::string_view words);
  void give(RunControl::Order::What what, std::uint64_t ticks = 0);
  std::string where(const Moment& moment) const;
  std::string entries(const Moment& moment) const;
  void end();

  const Shape& shape_;
  RunControl& control_;
  const bool is_real_time_;
  WhyWatch why_;
  BreakConditions conditions_;
  std::string_view condition_;  // that the last tick made true; "": none
  FileDescriptor wake_;         // the thread looks: there is a picture, or the run has ended
  Mutex mutex_;
  std::optional<Picture> picture_ LOCKSTEP_GUARDED_BY(mutex_);
  bool is_over_ LOCKSTEP_GUARDED_BY(mutex_) = false;
  std::vector<Breakpoint> breakpoints_ LOCKSTEP_GUARDED_BY(mutex_);
  std::uint64_t step_ = 1;  // ticks of the last s
  std::string rest_;        // read, and not used yet
  std::atomic<bool> stands_{false};
  std::atomic<bool> is_closed_{false};  // stdin: nothing comes any more
  const OpenQuestions* const questions_;
  std::optional<OpenQuestion> answered_;  // and the run has not taken that yet
  std::thread thread_;
};

}  // namespace lockstep::host
