// A run that pauses at breakpoints, and a person who then types what comes next: `run --break`. The
// loop gives it a picture of the run where it stands; a thread of its own shows that, reads
// commands from stdin, and gives orders to the run.
#pragma once

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
  // `shape` and `control` must outlive this.
  Prompt(const Shape& shape, RunControl& control, const PausePlaces& places, bool is_real_time);
  ~Prompt() override;

  AskedOfRun asked() const override { return conditions_.asked(); }
  void after_tick(const Moment& moment, const TickReport& report) override;
  void standing(const Moment& moment) override;
  void run_ended(const Moment& moment, const RunEnd& end) override;

 private:
  // The run where it stands.
  struct Picture {
    std::string where;  // "after tick 31 (0.310 s): 'Main/grasp' failed"
    std::string why, entries;
  };

  void live();
  void ask(const Picture& picture);
  std::optional<std::string> read_line();
  // False: the run goes on.
  bool obey(std::string_view line, const Picture& picture);
  void obey_break(std::string_view words, bool is_on);
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
  std::uint64_t step_ = 1;  // ticks of the last s
  std::string rest_;        // read, and not used yet
  bool is_closed_ = false;  // stdin: no command comes any more
  std::thread thread_;
};

}  // namespace lockstep::host
