#include "team/team_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>

#include "engine/tree.h"
#include "lockstep/ext/behavior.h"
#include "lockstep/ext/reason.h"
#include "lockstep/leaf.h"

namespace lockstep::host {
namespace {

thread_local TeamRun* run_here = nullptr;

enum Port : std::uint32_t { kTeamName, kSelf, kMemberName, kDeclaration, kDeadline, kPorts };

// --- the leaf
// -------------------------------------------------------------------------------------

struct RobotLeaf {
  const lockstep_host* host;
  const lockstep_caller* caller;
  const lockstep_reason* reason;
  const TeamRun* run;      // null: none
  const TeamMember* team;  // of it; null: not looked for yet, or the run has none
  std::size_t other;       // its place there
};

std::string_view text_of(const RobotLeaf& leaf, Port port) {
  const char* text = "";
  std::size_t size = 0;
  leaf.host->get_string(leaf.caller, port, &text, &size);
  return {text, size};
}

void* create_robot(const lockstep_host* host, const lockstep_caller* caller, void*) {
  const void* const reason = host->get_extension(LOCKSTEP_REASON);
  return new RobotLeaf{host,     caller,  static_cast<const lockstep_reason*>(reason),
                       run_here, nullptr, 0};
}

// Ports have values from the first tick on.
void find_team(RobotLeaf& leaf) {
  if (leaf.team != nullptr || leaf.run == nullptr) return;
  leaf.team = leaf.run->member(text_of(leaf, kTeamName));
  if (leaf.team == nullptr) return;
  const auto& others = leaf.team->declaration().others;
  const auto it = std::ranges::find(others, text_of(leaf, kMemberName));
  leaf.other = static_cast<std::size_t>(it - others.begin());
}

void destroy_robot(void* self) {
  delete static_cast<RobotLeaf*>(self);
}

// Why a member cannot be relied on; without an allocation, since it is said in each tick.
struct WhyNot {
  explicit WhyNot(const TeamMember::Known& known) {
    using Where = TeamMember::Where;
    switch (known.where) {
      case Where::InRound:
      case Where::NotBegun:
      case Where::Passed:
        return;
      case Where::Unheard:
        std::snprintf(text, sizeof text, "not heard yet");
        return;
      case Where::Silent:
        std::snprintf(text, sizeof text, "not heard for %.1f s", to_seconds(known.age));
        return;
      case Where::Nonsense:
        std::snprintf(text, sizeof text, "what it sends makes no sense");
        return;
      case Where::Contested:
        std::snprintf(text, sizeof text, "two robots have this name, or it contradicts itself");
        return;
      case Where::Stranger:
        std::snprintf(text, sizeof text, "its tree declares the team in another way");
        return;
    }
  }
  char text[64] = "";
};

constexpr const char* kOwnName = "another robot has the name of this one";

lockstep_status tick_robot(void* self) {
  RobotLeaf& leaf = *static_cast<RobotLeaf*>(self);
  find_team(leaf);
  const auto fail = [&](const char* why) {
    leaf.reason->say(leaf.caller, why);
    return LOCKSTEP_FAILURE + 0;
  };
  if (leaf.team == nullptr) return fail("this run is not connected with a team");
  if (leaf.team->is_contested()) return fail(kOwnName);
  const TeamMember::Known& known = leaf.team->known(leaf.other);
  if (!TeamMember::is_known(known.where)) return fail(WhyNot(known).text);
  if (known.where == TeamMember::Where::Passed) return LOCKSTEP_SUCCESS;
  return known.where == TeamMember::Where::InRound ? LOCKSTEP_RUNNING : LOCKSTEP_SKIPPED;
}

double robot_progress(void* self) {
  const RobotLeaf& leaf = *static_cast<const RobotLeaf*>(self);
  return leaf.team == nullptr ? 0.0 : leaf.team->known(leaf.other).progress;
}

constexpr lockstep_port text_port(const char* name, const char* doc) {
  lockstep_port port{};
  port.struct_size = sizeof port;
  port.type = LOCKSTEP_STRING;
  port.direction = LOCKSTEP_INPUT;
  port.name = name;
  port.doc = doc;
  return port;
}

const lockstep_port kRobotPorts[] = {
    text_port("team", "The team."), text_port("as", "The member that this robot is."),
    text_port("member", "The member that the node stands for."),
    text_port("declaration", "How the tree declares the team."), [] {
      lockstep_port port = text_port("deadline", "When it is silent; 0: five periods.");
      port.type = LOCKSTEP_DOUBLE;
      port.unit = "s";
      return port;
    }()};
const lockstep_port* const kRobotPortList[] = {&kRobotPorts[0], &kRobotPorts[1], &kRobotPorts[2],
                                               &kRobotPorts[3], &kRobotPorts[4]};
static_assert(std::size(kRobotPortList) == kPorts);

// For verify: another robot may do anything.
constexpr lockstep_behavior kAnything[] = {{"result", "success;failure;skipped"}};

const lockstep_leaf_type kRobotType = [] {
  lockstep_leaf_type type{};
  type.struct_size = sizeof type;
  type.kind = LOCKSTEP_ACTION;
  type.id = "TeamMember";
  type.doc = "Stands for another robot of a team, behind the child of an InStep.";
  type.port_count = kPorts;
  type.ports = kRobotPortList;
  type.create = create_robot;
  type.destroy = destroy_robot;
  type.tick = tick_robot;
  type.progress = robot_progress;
  type.behavior_count = std::size(kAnything);
  type.behavior = kAnything;
  return type;
}();
const lockstep_leaf_type* const kRobotTypes[] = {&kRobotType};

// A plugin set has a table of its own for each plugin.
bool is_robot(const LeafNode& leaf) {
  return leaf.type->leaf->tick == tick_robot;
}

std::string text_of(const Tree& tree, const LeafNode& leaf, Port port) {
  const PortBinding& binding = tree.ports[leaf.first_port + port];
  return std::get<std::string>(tree.constants[binding.constant]);
}

}  // namespace

const lockstep_plugin& team_plugin() {
  static const lockstep_plugin plugin = [] {
    lockstep_plugin it{};
    it.abi_major = LOCKSTEP_ABI_MAJOR;
    it.abi_minor = LOCKSTEP_ABI_MINOR;
    it.struct_size = sizeof it;
    it.name = "lockstep-team";
    it.doc = "The other robots of a team.";
    it.leaf_type_count = 1;
    it.leaf_types = kRobotTypes;
    return it;
  }();
  return plugin;
}

std::vector<TeamDeclaration> teams_of(const Tree& tree, Nanoseconds period) {
  std::vector<TeamDeclaration> teams;
  for (const LeafNode& leaf : tree.leaves) {
    if (!is_robot(leaf)) continue;
    const std::string team = text_of(tree, leaf, kTeamName);
    if (teams.empty() || teams.back().team != team) {
      const std::string declaration = text_of(tree, leaf, kDeclaration);
      const PortBinding& deadline = tree.ports[leaf.first_port + kDeadline];
      teams.push_back(
          {.team = team,
           .self = text_of(tree, leaf, kSelf),
           .others = {},
           .hash = hash_of_declaration(team + '\n' + declaration),
           .deadline = from_seconds(std::get<double>(tree.constants[deadline.constant])),
           .period = period});
    }
    teams.back().others.push_back(text_of(tree, leaf, kMemberName));
  }
  return teams;
}

TeamRun::TeamRun(const Tree& tree, std::span<const TeamDeclaration> teams, std::uint64_t run,
                 TeamTransport& transport, Clock& clock)
    : transport_(transport), clock_(clock), column_(tree.nodes.size()) {
  auto it = teams.begin();
  std::optional<NodeIndex> around;  // the node that the last one was in
  for (const LeafNode& leaf : tree.leaves) {
    if (!is_robot(leaf)) continue;
    heard_.push_back({.node = leaf.node});
    const NodeIndex parent = tree.labels[leaf.node].parent;
    if (std::exchange(around, std::optional(parent)) == parent) continue;
    teams_.push_back({TeamMember(*it++, run), parent});
  }
}

TeamRun::~TeamRun() {
  if (run_here == this) run_here = nullptr;
}

void TeamRun::use_here() {
  run_here = this;
}

const TeamMember* TeamRun::member(std::string_view team) const {
  for (const Team& it : teams_) {
    if (it.member.declaration().team == team) return &it.member;
  }
  return nullptr;
}

std::string TeamRun::why() const {
  for (const Team& it : teams_) {
    if (it.member.is_contested()) return kOwnName;
    const auto& others = it.member.declaration().others;
    for (std::size_t i = 0; i < others.size(); ++i) {
      const WhyNot why(it.member.known(i));
      if (*why.text != 0) return fmt::format("'{}': {}", others[i], why.text);
    }
  }
  return "";
}

AskedOfRun TeamRun::asked() const {
  return {.within = true, .heard = heard_};
}

void TeamRun::before_tick(const Moment&, std::uint64_t, Nanoseconds time) {
  for (HeardWord heard; transport_.take(heard);) {
    TeamMember& member = teams_[heard.team].member;
    heard.member == HeardWord::kOwnName ? member.hear_own_name(heard.word, heard.at)
                                        : member.hear(heard.member, heard.word, heard.at);
  }
  const Nanoseconds now = clock_.now();
  for (Team& it : teams_) it.member.look(now);
  note_heard(time);
}

void TeamRun::note_heard(Nanoseconds time) {
  auto heard = heard_.begin();
  for (const Team& it : teams_) {
    for (std::size_t i = 0; i < it.member.declaration().others.size(); ++i, ++heard) {
      const TeamMember::Known& known = it.member.known(i);
      const std::uint32_t run = short_run(known.run);
      if (known.number == heard->word && run == heard->run) continue;
      *heard = {.node = heard->node, .run = run, .word = known.number, .time = time};
    }
  }
}

void TeamRun::after_tick(const Moment& moment, const TickReport&) {
  for (Team& it : teams_) {
    // Within one tick it may succeed and begin again.
    bool has_succeeded = moment.ticked(it.node) && moment.has_succeeded(it.node);
    moment.within.each_part(column_, [&](std::span<const NodeState> states, bool, bool) {
      const NodeState state = states[it.node];
      has_succeeded |= state.ticked() && state.status() == Status::Success;
    });
    const auto end = has_succeeded ? TeamMember::End::Success : TeamMember::End::None;
    const bool is_in = moment.status(it.node) == Status::Running;
    it.member.set_own(is_in, is_in ? moment.used(it.node)[0] : 0.0, end);
  }
  say();
}

void TeamRun::run_ended(const Moment&, const RunEnd&) {
  for (Team& it : teams_) it.member.set_own(false, 0.0, TeamMember::End::None);
  say();
}

void TeamRun::say() {
  for (std::uint32_t i = 0; i < teams_.size(); ++i) transport_.say(i, teams_[i].member.word());
}

}  // namespace lockstep::host
