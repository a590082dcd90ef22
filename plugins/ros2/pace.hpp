// How a robot is slowed while a node with pace="true" asks for it: the attributes of the element,
// and who tells the robot.
#pragma once

#include <lockstep/leaf.h>

#include <atomic>
#include <memory>
#include <optional>
#include <string>

#include "elements.hpp"
#include "expression.hpp"
#include "hold.hpp"
#include "lines.hpp"
#include "target.hpp"

namespace ros2 {

struct Pace {
  bool is_given = false;  // else the robot cannot be slowed
  Target target = {};
  Expression value = {};

  // What the robot is told for a factor from 0 to 1. Nothing: the value has none.
  std::optional<double> at(double factor) const;
};

// `port` is the one with the wrong text.
Result<Pace> read_pace(const FixedTexts& texts, const lockstep_port& pace,
                       const lockstep_port& type, const lockstep_port& value,
                       const lockstep_port*& port);
// Whether a robot with this pace stands still at the factor 0.
std::optional<Problem> why_no_hold(const Pace& pace);

class PaceSignal final : public Waitable {
 public:
  explicit PaceSignal(const Pace& pace);

  // By the leaf.
  bool is_heard() const { return is_heard_.load(std::memory_order_relaxed); }
  // Whether a robot may still be as slow as an activation up to this one has told it.
  bool is_busy(std::uint64_t activation) const { return restored_.load() < activation; }
  Lines& lines() { return lines_; }

  // By the thread of ROS. An activation begins with the factor 1, and ends with what was found.
  // `message` has the other fields; `found` is what the robot has now, if the tree knows it.
  void open();
  void close() { teller_->close(); }
  void begin(std::uint64_t activation, std::shared_ptr<Message> message,
             std::optional<double> found);
  void slow(double factor);
  void hold(bool held);
  void end();

  void add_sizes(Sizes& /*sizes*/) const override {}
  void add_to(rcl_wait_set_t& /*set*/) override {}
  void take(const rcl_wait_set_t& /*set*/) override {}
  bool poll(Clock::time_point now) override;

 private:
  bool is_slow() const { return is_held_ || factor_ < 1; }
  void look_who_listens(Clock::time_point now);
  void take_answer();
  void take(const std::string& wrong);
  bool look(Clock::time_point now);
  std::optional<double> found();
  double wanted();
  bool is_told(double value) const;
  void tell(double value, Clock::time_point now);
  void forget();
  void warn(const std::string& what);

  const Pace& pace_;
  const std::shared_ptr<Teller> teller_;
  double factor_ = 1;
  bool is_held_ = false, has_ended_ = true;
  std::uint64_t activation_ = 0;
  std::optional<double> given_;  // what was found, by the tree

  std::optional<double> told_;  // nothing: the robot has what was found
  bool is_told_held_ = false, is_looked_ = false, is_again_ = false;
  bool is_open_ = false, is_obeyed_ = true;  // what was told last: not answered yet, not refused
  Ids listeners_;
  Clock::time_point next_{}, next_look_{}, missing_since_{};
  std::string warned_;

  std::atomic<bool> is_heard_{false};
  std::atomic<std::uint64_t> restored_{0};
  Lines lines_;
};

}  // namespace ros2
