// How a robot is slowed while a node with pace="true" asks for it: the attributes of the element,
// and who tells the robot.
#pragma once

#include <lockstep/leaf.h>

#include <atomic>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

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

// Tells one robot, for all leaves that slow it.
class PaceSignal final : public Waitable, public std::enable_shared_from_this<PaceSignal> {
 public:
  explicit PaceSignal(const Pace& pace) : pace_(&pace) {}
  // The one for this target and type.
  static std::shared_ptr<PaceSignal> of(const Pace& pace);

  // A leaf, and its activation.
  class User {
   public:
    explicit User(const Pace& pace) : pace_(pace) {}
    // Whether the robot may still be as slow as an activation up to this one wanted it.
    bool is_busy(std::uint64_t activation) const { return restored_.load() < activation; }
    // For a process after a cut: whether the robot was told anything, and what it had before, NaN
    // if that is not known.
    bool is_told() const { return is_told_.load(std::memory_order_relaxed); }
    double found() const { return found_.load(std::memory_order_relaxed); }

   private:
    friend class PaceSignal;
    const Pace& pace_;
    std::uint64_t activation_ = 0;
    double factor_ = 1;
    bool is_held_ = false;
    std::atomic<std::uint64_t> restored_{0};
    std::atomic<bool> is_told_{false};
    std::atomic<double> found_{0};
  };

  // By any thread.
  bool is_heard() const { return is_heard_.load(std::memory_order_relaxed); }
  Lines& lines() { return lines_; }

  // By the thread of ROS. An activation begins with the factor 1, and ends with what was found.
  // `message` has the other fields; `given` is what the robot has now, if the tree knows it.
  using UserPtr = std::shared_ptr<User>;
  void open();
  void close(const UserPtr& user);
  void begin(const UserPtr& user, std::uint64_t activation, std::shared_ptr<Message> message,
             std::optional<double> given);
  // Another process may have changed the robot since then: it is set again.
  void tell_again();
  void slow(User& user, double factor);
  void hold(User& user, bool held);
  void end(const UserPtr& user, std::uint64_t activation);

  void add_sizes(Sizes& /*sizes*/) const override {}
  void add_to(rcl_wait_set_t& /*set*/) override {}
  void take(const rcl_wait_set_t& /*set*/) override {}
  bool poll(Clock::time_point now) override;

 private:
  bool is_held() const { return factor_ == 0; }
  bool is_slow() const { return factor_ < 1; }
  bool is_after_cut() const { return told_ && std::isnan(*told_); }
  void update();
  void find_listeners(Clock::time_point now);
  void take_answer();
  void take(const std::string& wrong);
  bool look(Clock::time_point now);
  std::optional<double> found();
  double wanted();
  bool is_told(double value) const;
  void tell(double value, Clock::time_point now);
  void forget();
  void show();
  void warn(const std::string& what);

  int leaves_ = 0;
  std::shared_ptr<Teller> teller_;
  const Pace* pace_;             // of the activation that began last
  std::vector<UserPtr> users_;   // whose activation has not ended
  std::vector<UserPtr> ending_;  // whose activation has ended, while the robot is slow
  double factor_ = 1;            // the largest of the users; 0: held
  std::optional<double> given_;  // what was found, by the tree

  std::optional<double> told_;  // nothing: the robot has what was found; NaN: it is not known what
  bool is_told_held_ = false, is_looked_ = false, is_again_ = false;
  bool is_open_ = false, is_obeyed_ = true;  // what was told last: not answered yet, not refused
  Ids listeners_;
  Clock::time_point next_{}, next_look_{}, missing_since_{};
  std::string warned_;

  std::atomic<bool> is_heard_{false};
  Lines lines_;
};

}  // namespace ros2
