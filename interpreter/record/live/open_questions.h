// The questions that a run asks at this moment, for people: in a terminal, by `lockstep answer`.
// The page has them from the lines of the run.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/core/clock.h"
#include "base/system/mutex.h"
#include "trace/observer.h"
#include "trace/shape.h"

namespace lockstep::host {

struct OpenQuestion {
  NodeIndex node = 0;
  std::string text;
  std::uint64_t tick = 0;  // in which it was asked
  Nanoseconds time{0};     // of that

  friend bool operator==(const OpenQuestion&, const OpenQuestion&) = default;
};

class OpenQuestions final : public Observer {
 public:
  // What people are told: a question that is new, or how one has ended.
  using Tell = std::function<void(const std::string& line)>;
  // `shape` must outlive this. `on_change` is called on the tick thread when questions have come or
  // gone.
  OpenQuestions(const Shape& shape, Tell tell, std::function<void()> on_change);

  // In the order in which they were asked. For any thread.
  std::vector<OpenQuestion> now() const;

  // The answer that counted, to the question that this node asked in this tick; none: it has not
  // come, or that was long ago. For any thread.
  std::optional<GivenAnswer> answer_to(NodeIndex node, std::uint64_t tick) const;

  void after_tick(const Moment& moment, const TickReport& report) override;
  void run_ended(const Moment& moment, const RunEnd& end) override;

 private:
  // Whether the question is over. An answer that came is taken in the next tick that reaches the
  // node: one that is held may be halted before.
  bool is_over(const Moment& moment, const OpenQuestion& question) const;
  void end(const Moment& moment, const OpenQuestion& question) LOCKSTEP_REQUIRES(mutex_);

  const Shape& shape_;
  const Tell tell_;
  const std::function<void()> on_change_;
  std::vector<NodeIndex> asking_;  // the nodes that may ask
  mutable Mutex mutex_;
  std::vector<OpenQuestion> now_ LOCKSTEP_GUARDED_BY(mutex_);
  struct Answered {
    OpenQuestion question;
    GivenAnswer answer;
  };
  std::deque<Answered> answered_ LOCKSTEP_GUARDED_BY(mutex_);  // the last ones
  std::map<NodeIndex, GivenAnswer> given_;                     // that were not taken yet
};

// Whether a run of the tree may ask something.
bool asks_people(const Shape& shape);

}  // namespace lockstep::host
