// Runs the trees of a team together, from every state that they can reach with every answer of
// their leaves and every delay of their words: breadth first.
//
// Each robot begins in any period, and has one turn in each period from then on, in any order that
// does not change. A word is heard in
// that period or in a later one, at most `late` turns of its robot after it was said, or a newer
// one in its place. A robot that has ended says nothing more.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "verify/search_limits.h"
#include "verify/team/searched_robot.h"

namespace lockstep::host {

// One robot to be searched. All must outlive the search.
struct TeamTree {
  std::string name;
  const Tree& tree;
  const LeafModels& models;
  std::vector<TeamDeclaration> teams;
  std::span<const Property> properties = {};
};

// What a robot did in a turn.
struct TeamTurn {
  std::size_t robot = 0;
  bool ticks = false;   // else it has not begun, or has ended
  bool begins = false;  // it is its first tick
  struct Hears {
    std::size_t team, other;
    std::uint32_t age;  // of the word, in turns of the other one
  };
  std::vector<Hears> hears = {};
  // Whose last word came so long before the tick in which it was heard that they are silent now. A
  // word comes at any time between two ticks, so this may as well be in the next one.
  struct Silent {
    std::size_t team, other;
  };
  std::vector<Silent> silent = {};
  std::vector<LeafAnswer> answers = {};
};

struct TeamFinding {
  std::string name, message;
  std::vector<std::string> more = {};
  std::vector<TeamTurn> run = {};  // that shows it
  std::string accepted = {};       // why the leaf model accepts it; "": it does not
};

struct TeamSearchResult {
  SearchEnd end = SearchEnd::Complete;
  int signal = 0;
  std::uint64_t states = 0, transitions = 0;
  std::uint32_t periods = 0;  // of the longest of the shortest runs
  Nanoseconds took{0};
  std::vector<std::set<RobotState::Phase>> results = {};  // of each robot: how it may end
  // Of each robot and each of its properties: in some state it waits for something, which an
  // endless run may never do.
  std::vector<std::vector<bool>> owes = {};
  bool may_all_succeed = false, can_always_end = true;
  struct Spread {
    std::string team;
    double largest = 0;
  };
  std::vector<Spread> spreads = {};  // of the teams that are in step
  bool has_pool = false;
  bool has_barriers = false;         // that were looked at
  bool leaves_out_silences = false;  // there were too many at a time
  std::vector<TeamFinding> findings = {};

  bool is_complete() const { return end == SearchEnd::Complete; }
};

// How long before a tick a word may come that is heard in it.
constexpr Nanoseconds almost(Nanoseconds period) {
  return period - Nanoseconds(1);
}

class TeamSearch {
 public:
  TeamSearch(std::vector<TeamTree> trees, double rate, std::uint32_t late, bool must_end,
             const SearchLimits& limits);
  ~TeamSearch();

  TeamSearchResult search();
  // When a robot begins in a run, in seconds; nothing: never.
  std::optional<double> begin_of(const std::vector<TeamTurn>& run, std::size_t robot) const;
  const std::string& name(std::size_t robot) const { return trees_[robot].name; }
  // Who said what is heard.
  TeamLink link(std::size_t robot, const TeamTurn::Hears& heard) const {
    return *names_[robot].others[heard.team][heard.other];
  }
  SearchedRobot& robot(std::size_t number) { return *robots_[number]; }
  // The turns of a run once more: after each, the robot's ticker shows it.
  using AfterTurn = std::function<void(const TeamTurn& turn, SearchedRobot& robot)>;
  void play(const std::vector<TeamTurn>& run, const AfterTurn& after);

 private:
  struct Graph;
  using Visit = std::function<bool(TeamState&& next, const TeamTurn& turn)>;

  bool expand(const TeamState& from, const Visit& visit);
  bool tick(const TeamState& from, TeamTurn& turn, const Visit& visit);
  void begin_turn(const TeamState& from, const TeamTurn& turn);
  std::vector<std::vector<TeamTurn::Silent>> silences(const TeamState& from, const TeamTurn& turn);
  std::vector<std::vector<TeamTurn::Hears>> deliveries(const TeamState& from) const;
  std::vector<HeardWord> words(const TeamState& from, const TeamTurn& turn) const;
  TeamState after_turn(const TeamState& from, const TeamTurn& turn, RobotState robot) const;
  // A turn from the state with this number.
  struct Done {
    StateId state;
    const TeamState& from;
    const TeamTurn& turn;
  };
  void look(const Done& done, const TeamState& next);
  void look_at_properties(const Done& done, bool has_ended);
  void look_at_barriers(const Done& done);
  void look_at_resources(const Done& done, const TeamState& next);
  void look_at_spread(const TeamState& next);
  void find_trap();
  std::vector<std::string> waits_in(StateId state);
  std::vector<TeamTurn> run_to(StateId state);
  void add_finding(std::string name, std::string message, const Done& done);
  bool is_full();
  bool is_stopped();
  std::uint32_t periods_to(StateId state) const;

  std::vector<TeamTree> trees_;
  std::vector<TeamNames> names_;
  const double rate_;
  const bool must_end_;  // a team that cannot end is a finding
  const SearchLimits limits_;
  std::optional<TeamCode> code_;
  bool may_be_silent_ = false;                        // words may be so late that a robot is
  std::vector<std::vector<std::int64_t>> deadlines_;  // of robots and teams, in whole periods
  std::vector<std::unique_ptr<SearchedRobot>> robots_;
  StateStore store_;
  std::unique_ptr<Graph> graph_;
  std::vector<StateId> shown_by_;  // of each finding: from this state, its run has one turn
  TeamSearchResult result_;
  Nanoseconds began_{0}, told_{0};
  std::uint64_t looks_at_ = 0;  // limits, from so many transitions on
};

}  // namespace lockstep::host
