// A robot in a search of its team: its tree from any state with any answers of its leaves, and what
// it knows of the others, which the code of a real run decides.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "run/live_moments.h"
#include "team/team_run.h"
#include "verify/stepper.h"
#include "verify/team/team_state.h"

namespace lockstep::host {

class HeldClock final : public Clock {
 public:
  Nanoseconds now() override { return TeamCode::kNow; }
  void sleep_until(Nanoseconds) override {}
  bool is_real() const override { return false; }
};

// Gives what it was given, and keeps what is said.
class HeldTransport final : public TeamTransport {
 public:
  bool take(HeardWord& into) override {
    if (given.empty()) return false;
    into = given.back();
    given.pop_back();
    return true;
  }
  void say(std::uint32_t team, const TeamWord& word) override {
    if (said.size() <= team) said.resize(team + 1);
    said[team] = word;
  }
  std::vector<HeardWord> given;
  std::vector<TeamWord> said;
};

class SearchedRobot final : private OutsideLeaves {
 public:
  // All must outlive this. `number`: of the robot in the list.
  SearchedRobot(const Tree& tree, const LeafModels& models, std::span<const Property> properties,
                const TeamNames& names, std::size_t number, double rate);

  // Its turn from this state on, in which it has heard these words; its first tick, if `begins`.
  // Then `tick` for each combination of answers, until `next` is false.
  void begin_turn(const RobotState& from, bool begins, std::span<const HeardWord> heard);
  // The state after it; ages are as before. `said` has what it says.
  RobotState tick();
  bool next() { return stepper_.next(); }
  // In place of combinations.
  void give(std::span<const LeafAnswer> answers) { stepper_.give(answers); }

  // Of the last tick.
  const Stepper& stepper() const { return stepper_; }
  Stepper& stepper() { return stepper_; }
  // The round in which the robot was when it was ticked, by team; and whether the node that is in
  // step runs, with which progress its child was before the tick, and whether it got one.
  struct Moved {
    std::uint32_t round = 0;
    bool runs = false, ticked = false;
    double from = 0;
  };
  const std::vector<Moved>& moved() const { return moved_; }
  // Why it does not go on, as far as it is about others; "": nothing.
  std::string why();

  // The node of the team that is in step, and the barriers of it; without barriers: it has a delta.
  struct InStep {
    NodeIndex node = 0;
    std::vector<double> barriers;
    bool ticks_at_barrier = false;
  };
  const std::vector<std::optional<InStep>>& in_step() const { return in_step_; }
  const StateStore& trees() const { return trees_; }
  const Tree& tree() const { return tree_; }

 private:
  struct Leaf {
    TeamRun::Team* team = nullptr;  // null: it is as its model
    bool asks = false;
    std::size_t other = 0, place = 0;
    ResourceSet wanted = 0;
  };
  bool has(std::uint32_t leaf) const override { return leaves_[leaf].team != nullptr; }
  void start(std::uint32_t leaf) override;
  Status tick(std::uint32_t leaf) override;
  double progress(std::uint32_t leaf) const override;

  const Tree& tree_;
  HeldClock clock_;
  HeldTransport transport_;
  TeamRun team_;
  std::vector<Leaf> leaves_;
  std::vector<std::optional<InStep>> in_step_;
  Stepper stepper_;
  LiveMoments moments_;
  StateStore trees_;
  StateId first_tree_ = 0;
  RobotState from_;
  std::vector<TeamMember::Memory> heard_;  // after it has looked
  std::vector<TeamPool::Memory> pools_;    // likewise
  std::vector<Moved> moved_;
};

}  // namespace lockstep::host
