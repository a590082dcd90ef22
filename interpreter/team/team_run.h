// The teams of one run: gives its members what the transport has heard, before each tick, and says
// how far the own tree is, after it. The leaves that stand for other robots ask it.
#pragma once

#include <deque>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "team/member.h"
#include "team/pool.h"
#include "team/transport.h"
#include "trace/observer.h"

struct lockstep_plugin;

namespace lockstep::host {

struct NodeType;
struct Tree;

// The teams that the tree declares, in the order of their nodes; `period` is that of its ticks.
std::vector<TeamDeclaration> teams_of(const Tree& tree, Nanoseconds period);
// Why a run of the tree cannot be kept in a checkpoint: it shares resources with other robots.
std::optional<Problem> why_not_kept(const Tree& tree);

// The plugin with the leaves that stand for other robots: TeamMember for one, TeamResources for all
// that share a pool. It is in a project that has a team.
const lockstep_plugin& team_plugin();
bool stands_for_robots(const NodeType& type);

// Such a leaf: in a tree that is compiled.
struct RobotLeaf {
  std::uint32_t leaf = 0;  // in Tree::leaves
  std::string team;
  bool asks = false;      // for resources; otherwise it stands for one robot
  std::string other;      // that robot
  std::size_t place = 0;  // of the node that asks
  // What that asks for, as text; nothing: an entry has it.
  std::optional<std::string> wanted = {};
};
std::vector<RobotLeaf> robot_leaves(const Tree& tree);

class TeamRun final : public Observer {
 public:
  // All must outlive this. `run` is a random number.
  TeamRun(const Tree& tree, std::span<const TeamDeclaration> teams, std::uint64_t run,
          TeamTransport& transport, Clock& clock);
  ~TeamRun() override;

  // The leaves that are made in this thread from now on are those of this run. Without one, they
  // hear nobody.
  void use_here();

  // A node of the tree that uses the pool of a team, and the leaf that asks for it.
  struct Use {
    NodeIndex node = 0, asker = 0;
  };
  struct Team {
    Team(const TeamDeclaration& declaration, std::uint64_t run, std::vector<Use> uses);
    TeamMember member;
    std::optional<NodeIndex> node = {};  // that is in step
    std::vector<Use> uses;
    TeamPool pool;

    // The result of the leaf that stands for another one, in this tick; Failure: it cannot be
    // relied on.
    Status tick_robot(std::size_t other) const;
    // That of the leaf that asks for resources, once it is ticked.
    Status tick_asking(std::size_t place, ResourceSet set);
  };
  Team* team(std::string_view name);
  // After the run: "'right': not heard for 2.9 s": what was known of others in the last tick, where
  // that held the robot. "": nothing.
  const std::string& why() const { return why_; }

  const std::deque<Team>& teams() const { return teams_; }
  std::deque<Team>& teams() { return teams_; }

  // For a process that continues the run after a cut: the rounds of all teams, two numbers of each.
  // Does not allocate where `into` has room.
  void keep_rounds(std::vector<std::uint32_t>& into) const;
  // Before the first tick of that. False: they are of other teams.
  bool resume_rounds(std::span<const std::uint32_t> rounds);

  // By which the recordings of the other members name this run.
  static std::uint32_t short_run(std::uint64_t run) { return static_cast<std::uint32_t>(run); }

  AskedOfRun asked() const override;
  void before_tick(const Moment& moment, std::uint64_t tick, Nanoseconds time) override;
  void after_tick(const Moment& moment, const TickReport& report) override;
  void run_ended(const Moment& moment, const RunEnd& end) override;

 private:
  void say();
  void note_heard(Nanoseconds time);
  std::string find_why() const;

  std::deque<Team> teams_;
  std::vector<Heard> heard_;  // of the others of the first team in step, then of the next
  TeamTransport& transport_;
  Clock& clock_;
  std::vector<NodeState> column_;
  std::string why_;
};

}  // namespace lockstep::host
