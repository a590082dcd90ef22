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

// Of both leaves; then those of one.
enum Port : std::uint32_t { kTeamName, kSelf, kDeadline, kShared };
enum RobotPort : std::uint32_t { kMemberName = kShared, kDeclaration, kRobotPorts };
enum PoolPort : std::uint32_t { kMembers = kShared, kNames, kPlace, kWanted, kPoolPorts };

// --- the leaves ---------------------------------------------------------------------------------

struct TeamLeaf {
  const lockstep_host* host;
  const lockstep_caller* caller;
  const lockstep_reason* reason;
  TeamRun* run;         // null: none
  TeamRun::Team* team;  // of it; null: not looked for yet, or the run has none
  std::size_t place;    // of the other robot, or of the node that uses the pool
  ResourceSet wanted;   // by that
};

std::string_view text_of(const TeamLeaf& leaf, std::uint32_t port) {
  const char* text = "";
  std::size_t size = 0;
  leaf.host->get_string(leaf.caller, port, &text, &size);
  return {text, size};
}

// Ports have values from the first tick on.
bool find_team(TeamLeaf& leaf) {
  if (leaf.team != nullptr || leaf.run == nullptr) return false;
  leaf.team = leaf.run->team(text_of(leaf, kTeamName));
  return leaf.team != nullptr;
}

lockstep_status say(const TeamLeaf& leaf, const char* why, lockstep_status status) {
  leaf.reason->say(leaf.caller, why);
  return status;
}

constexpr const char* kOwnName = "another robot has the name of this one";

// Why nothing can be done with others; null: it can.
const char* why_apart(const TeamLeaf& leaf) {
  if (leaf.team == nullptr) return "this run is not connected with a team";
  return leaf.team->member.is_contested() ? kOwnName : nullptr;
}

void* create_leaf(const lockstep_host* host, const lockstep_caller* caller, void*) {
  const void* const reason = host->get_extension(LOCKSTEP_REASON);
  return new TeamLeaf{.host = host,
                      .caller = caller,
                      .reason = static_cast<const lockstep_reason*>(reason),
                      .run = run_here,
                      .team = nullptr,
                      .place = 0,
                      .wanted = 0};
}

void destroy_leaf(void* self) {
  delete static_cast<TeamLeaf*>(self);
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

lockstep_status to_leaf(Status status) {
  return static_cast<lockstep_status>(status);
}

lockstep_status tick_robot(void* self) {
  TeamLeaf& leaf = *static_cast<TeamLeaf*>(self);
  if (find_team(leaf)) {
    const auto& others = leaf.team->member.declaration().others;
    const auto it = std::ranges::find(others, text_of(leaf, kMemberName));
    leaf.place = static_cast<std::size_t>(it - others.begin());
  }
  if (const char* const why = why_apart(leaf)) return say(leaf, why, LOCKSTEP_FAILURE);
  const WhyNot why(leaf.team->member.known(leaf.place));
  if (*why.text != 0) return say(leaf, why.text, LOCKSTEP_FAILURE);
  return to_leaf(leaf.team->tick_robot(leaf.place));
}

double robot_progress(void* self) {
  const TeamLeaf& leaf = *static_cast<const TeamLeaf*>(self);
  return leaf.team == nullptr ? 0.0 : leaf.team->member.known(leaf.place).progress;
}

// Why a node waits for a pool; without an allocation.
struct WhyWaiting {
  WhyWaiting(const TeamRun::Team& team, std::size_t place) {
    using What = TeamPool::Obstacle::What;
    const TeamPool::Obstacle it = team.pool.obstacle(team.member, place);
    const TeamDeclaration& declaration = team.member.declaration();
    const char* const who = declaration.others[it.other].c_str();
    switch (it.what) {
      case What::None:
        return;
      case What::Owned:
      case What::Wanted: {
        std::size_t name = 0;
        while ((it.set >> name & 1U) == 0) ++name;
        const char* const does = it.what == What::Owned ? "has" : "waits for";
        std::snprintf(text, sizeof text, "'%s' %s '%s'", who, does,
                      declaration.resources[name].c_str());
        return;
      }
      case What::Unheard:
        std::snprintf(text, sizeof text, "'%s' is not heard yet", who);
        return;
      case What::Silent:
        std::snprintf(text, sizeof text, "'%s' is not heard for %.1f s", who,
                      to_seconds(team.member.known(it.other).age));
        return;
      case What::Contested:
        std::snprintf(text, sizeof text, "two robots have the name '%s', or it contradicts itself",
                      who);
        return;
      case What::Stranger:
        std::snprintf(text, sizeof text, "the tree of '%s' declares the pool in another way", who);
        return;
    }
  }
  char text[192] = "";
};

// A new activation: what the last one had is given back, also where both are in one tick.
void start_asking(void* self) {
  const TeamLeaf& leaf = *static_cast<const TeamLeaf*>(self);
  if (leaf.team != nullptr) leaf.team->pool.give_back(leaf.place);
}

lockstep_status tick_asking(void* self) {
  TeamLeaf& leaf = *static_cast<TeamLeaf*>(self);
  if (find_team(leaf)) {
    std::int64_t place = 0;
    leaf.host->get_int(leaf.caller, kPlace, &place);
    leaf.place = static_cast<std::size_t>(place);
  }
  if (const char* const why = why_apart(leaf)) return say(leaf, why, LOCKSTEP_FAILURE);
  const auto& names = leaf.team->member.declaration().resources;
  const ResourceList list = resource_list(text_of(leaf, kWanted), names);
  const Status status = leaf.team->tick_asking(leaf.place, all_resources(list.request()));
  if (status == Status::Success) return LOCKSTEP_SUCCESS;
  return say(leaf, WhyWaiting(*leaf.team, leaf.place).text, LOCKSTEP_RUNNING);
}

constexpr lockstep_port port_of(const char* name, const char* doc,
                                lockstep_type type = LOCKSTEP_STRING) {
  lockstep_port port{};
  port.struct_size = sizeof port;
  port.type = type;
  port.direction = LOCKSTEP_INPUT;
  port.name = name;
  port.doc = doc;
  return port;
}

constexpr lockstep_port kTeamPort = port_of("team", "The team.");
constexpr lockstep_port kAsPort = port_of("as", "The member that this robot is.");
constexpr lockstep_port kDeadlinePort = [] {
  lockstep_port port =
      port_of("deadline", "When a member is silent; 0: five periods.", LOCKSTEP_DOUBLE);
  port.unit = "s";
  return port;
}();
const lockstep_port kMemberPort = port_of("member", "The member that the node stands for.");
const lockstep_port kDeclarationPort = port_of("declaration", "How the tree declares the team.");
const lockstep_port* const kRobotPortList[] = {&kTeamPort, &kAsPort, &kDeadlinePort, &kMemberPort,
                                               &kDeclarationPort};
static_assert(std::size(kRobotPortList) == kRobotPorts);

const lockstep_port kMembersPort =
    port_of("members", "All members; the first one decides.", LOCKSTEP_STRING_LIST);
const lockstep_port kNamesPort = port_of("names", "All resources of the pool.");
const lockstep_port kPlacePort =
    port_of("place", "Which of the nodes that use the pool it asks for.", LOCKSTEP_INT);
const lockstep_port kWantedPort = port_of("resources", "What that node needs.");
const lockstep_port* const kPoolPortList[] = {
    &kTeamPort, &kAsPort, &kDeadlinePort, &kMembersPort, &kNamesPort, &kPlacePort, &kWantedPort};
static_assert(std::size(kPoolPortList) == kPoolPorts);

// For verify: other robots may do anything.
constexpr lockstep_behavior kAnyMember[] = {{"result", "success;failure;skipped"}};
constexpr lockstep_behavior kAnyAnswer[] = {{"result", "success;failure"}};

constexpr lockstep_leaf_type leaf_of(const char* id, const char* doc) {
  lockstep_leaf_type type{};
  type.struct_size = sizeof type;
  type.kind = LOCKSTEP_ACTION;
  type.id = id;
  type.doc = doc;
  type.create = create_leaf;
  type.destroy = destroy_leaf;
  return type;
}

const lockstep_leaf_type kRobotType = [] {
  lockstep_leaf_type type =
      leaf_of("TeamMember", "Stands for another robot of a team, behind the child of an InStep.");
  type.port_count = kRobotPorts;
  type.ports = kRobotPortList;
  type.tick = tick_robot;
  type.progress = robot_progress;
  type.behavior_count = std::size(kAnyMember);
  type.behavior = kAnyMember;
  return type;
}();
const lockstep_leaf_type kPoolType = [] {
  lockstep_leaf_type type = leaf_of(
      "TeamResources",
      "Asks the other robots for resources that they share, behind the child of a UseResources.");
  type.port_count = kPoolPorts;
  type.ports = kPoolPortList;
  type.start = start_asking;
  type.tick = tick_asking;
  type.behavior_count = std::size(kAnyAnswer);
  type.behavior = kAnyAnswer;
  return type;
}();
const lockstep_leaf_type* const kTeamTypes[] = {&kRobotType, &kPoolType};

// A plugin set has a table of its own for each plugin.
bool is_robot(const NodeType& type) {
  return type.leaf != nullptr && type.leaf->tick == tick_robot;
}
bool is_asking(const NodeType& type) {
  return type.leaf != nullptr && type.leaf->tick == tick_asking;
}
bool is_robot(const LeafNode& leaf) {
  return is_robot(*leaf.type);
}
bool is_asking(const LeafNode& leaf) {
  return is_asking(*leaf.type);
}

template <class T>
const T& constant_of(const Tree& tree, const LeafNode& leaf, std::uint32_t port) {
  return std::get<T>(tree.constants[tree.ports[leaf.first_port + port].constant]);
}

// The declaration with which the leaves of a team agree.
TeamDeclaration& declaration_of(std::vector<TeamDeclaration>& teams, const Tree& tree,
                                const LeafNode& leaf, Nanoseconds period) {
  const auto& name = constant_of<std::string>(tree, leaf, kTeamName);
  const auto known = std::ranges::find(teams, name, &TeamDeclaration::team);
  if (known != teams.end()) return *known;
  return teams.emplace_back(
      TeamDeclaration{.team = name,
                      .self = constant_of<std::string>(tree, leaf, kSelf),
                      .others = {},
                      .hash = 0,
                      .deadline = from_seconds(constant_of<double>(tree, leaf, kDeadline)),
                      .period = period});
}

void add_pool(TeamDeclaration& team, const Tree& tree, const LeafNode& leaf) {
  const auto& members = constant_of<std::vector<std::string>>(tree, leaf, kMembers);
  const auto& names = constant_of<std::string>(tree, leaf, kNames);
  team.others.clear();
  std::string text = team.team;
  for (const std::string& it : members) {
    if (it != team.self) team.others.push_back(it);
    text += '\n' + it;
  }
  team.place = static_cast<std::size_t>(std::ranges::find(members, team.self) - members.begin());
  team.resources.clear();
  for (const std::string_view it : resource_names(names)) {
    text.append(";").append(team.resources.emplace_back(it));
  }
  team.pool_hash = hash_of_declaration(text);
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
    it.leaf_type_count = std::size(kTeamTypes);
    it.leaf_types = kTeamTypes;
    return it;
  }();
  return plugin;
}

std::vector<TeamDeclaration> teams_of(const Tree& tree, Nanoseconds period) {
  std::vector<TeamDeclaration> teams;
  for (const LeafNode& leaf : tree.leaves) {
    if (is_asking(leaf)) add_pool(declaration_of(teams, tree, leaf, period), tree, leaf);
    if (!is_robot(leaf)) continue;
    TeamDeclaration& team = declaration_of(teams, tree, leaf, period);
    const auto& other = constant_of<std::string>(tree, leaf, kMemberName);
    if (std::ranges::find(team.others, other) == team.others.end()) team.others.push_back(other);
    team.hash =
        hash_of_declaration(team.team + '\n' + constant_of<std::string>(tree, leaf, kDeclaration));
  }
  return teams;
}

std::optional<Problem> why_not_kept(const Tree& tree) {
  const auto asks = [](const LeafNode& it) { return is_asking(it); };
  if (std::ranges::none_of(tree.leaves, asks)) return std::nullopt;
  return Problem{"a run that shares resources with other robots cannot be kept",
                 "another robot may own them when it continues"};
}

bool stands_for_robots(const NodeType& type) {
  return is_robot(type) || is_asking(type);
}

std::vector<RobotLeaf> robot_leaves(const Tree& tree) {
  std::vector<RobotLeaf> found;
  for (std::uint32_t i = 0; i < tree.leaves.size(); ++i) {
    const LeafNode& leaf = tree.leaves[i];
    if (!stands_for_robots(*leaf.type)) continue;
    RobotLeaf& it = found.emplace_back();
    it.leaf = i;
    it.team = constant_of<std::string>(tree, leaf, kTeamName);
    it.asks = is_asking(leaf);
    if (!it.asks) {
      it.other = constant_of<std::string>(tree, leaf, kMemberName);
      continue;
    }
    it.place = static_cast<std::size_t>(constant_of<std::int64_t>(tree, leaf, kPlace));
    if (tree.ports[leaf.first_port + kWanted].slot == PortBinding::kUnbound)
      it.wanted = constant_of<std::string>(tree, leaf, kWanted);
  }
  return found;
}

Status TeamRun::Team::tick_robot(std::size_t other) const {
  using Where = TeamMember::Where;
  const Where where = member.known(other).where;
  if (member.is_contested() || !TeamMember::is_known(where)) return Status::Failure;
  if (where == Where::Passed) return Status::Success;
  return where == Where::InRound ? Status::Running : Status::Skipped;
}

Status TeamRun::Team::tick_asking(std::size_t place, ResourceSet set) {
  if (member.is_contested()) return Status::Failure;
  return pool.ask(place, set) ? Status::Success : Status::Running;
}

TeamRun::Team::Team(const TeamDeclaration& declaration, std::uint64_t run, std::vector<Use> nodes)
    : member(declaration, run), uses(std::move(nodes)), pool(member.declaration(), run) {}

TeamRun::TeamRun(const Tree& tree, std::span<const TeamDeclaration> teams, std::uint64_t run,
                 TeamTransport& transport, Clock& clock)
    : transport_(transport), clock_(clock), column_(tree.nodes.size()) {
  for (const TeamDeclaration& declaration : teams) {
    std::vector<Use> uses;
    std::optional<NodeIndex> node;
    for (const LeafNode& leaf : tree.leaves) {
      const bool is_of_team = is_robot(leaf) || is_asking(leaf);
      if (!is_of_team || constant_of<std::string>(tree, leaf, kTeamName) != declaration.team)
        continue;
      const NodeIndex parent = tree.labels[leaf.node].parent;
      if (is_robot(leaf)) {
        node = parent;
        heard_.push_back({.node = leaf.node});
      }
      if (!is_asking(leaf)) continue;
      const auto place = static_cast<std::size_t>(constant_of<std::int64_t>(tree, leaf, kPlace));
      uses.resize(std::max(uses.size(), place + 1));
      uses[place] = {parent, leaf.node};
    }
    teams_.emplace_back(declaration, run, std::move(uses)).node = node;
  }
}

TeamRun::~TeamRun() {
  if (run_here == this) run_here = nullptr;
}

void TeamRun::use_here() {
  run_here = this;
}

TeamRun::Team* TeamRun::team(std::string_view name) {
  const auto it = std::ranges::find_if(
      teams_, [&](const Team& team) { return team.member.declaration().team == name; });
  return it == teams_.end() ? nullptr : &*it;
}

void TeamRun::keep_rounds(std::vector<std::uint32_t>& into) const {
  into.clear();
  for (const Team& it : teams_) {
    into.push_back(it.member.round());
    into.push_back(it.member.passed());
  }
}

bool TeamRun::resume_rounds(std::span<const std::uint32_t> rounds) {
  if (rounds.size() != 2 * teams_.size()) return false;
  for (std::size_t i = 0; i < teams_.size(); ++i)
    teams_[i].member.resume(rounds[2 * i], rounds[2 * i + 1]);
  return true;
}

std::string TeamRun::find_why() const {
  for (const Team& it : teams_) {
    if (it.member.is_contested()) return kOwnName;
    for (std::size_t place = 0; place < it.uses.size(); ++place) {
      const WhyWaiting why(it, place);
      if (it.pool.waits(place) && *why.text != 0) return why.text;
    }
    if (!it.member.is_in()) continue;
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
  for (Team& it : teams_) {
    it.member.look(now);
    it.pool.look(it.member, now);
  }
  note_heard(time);
}

void TeamRun::note_heard(Nanoseconds time) {
  auto heard = heard_.begin();
  for (const Team& it : teams_) {
    if (!it.node) continue;
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
    for (std::size_t place = 0; place < it.uses.size(); ++place) {
      const Use& use = it.uses[place];
      const bool has_asked = moment.status(use.asker) != Status::Idle;  // in this activation
      if (moment.status(use.node) != Status::Running || !has_asked) it.pool.give_back(place);
    }
    it.pool.end_tick();
    if (!it.node) continue;
    // Within one tick it may succeed and begin again.
    bool has_succeeded = moment.ticked(*it.node) && moment.has_succeeded(*it.node);
    moment.within.each_part(column_, [&](std::span<const NodeState> states, bool, bool) {
      const NodeState state = states[*it.node];
      has_succeeded |= state.ticked() && state.status() == Status::Success;
    });
    const auto end = has_succeeded ? TeamMember::End::Success : TeamMember::End::None;
    const bool is_in = moment.status(*it.node) == Status::Running;
    it.member.set_own(is_in, is_in ? moment.used(*it.node)[0] : 0.0, end);
  }
  say();
}

void TeamRun::run_ended(const Moment&, const RunEnd&) {
  why_ = find_why();
  for (Team& it : teams_) {
    it.member.set_own(false, 0.0, TeamMember::End::None);
    it.pool.leave();
  }
  say();
}

void TeamRun::say() {
  for (std::uint32_t i = 0; i < teams_.size(); ++i) {
    transport_.say(i, teams_[i].member.word(teams_[i].pool.word()));
  }
}

}  // namespace lockstep::host
