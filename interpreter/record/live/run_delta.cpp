#include "record/live/run_delta.h"

#include <algorithm>
#include <cstring>
#include <set>

#include "base/core/differences.h"
#include "base/core/synchronization.h"

namespace lockstep::host {
namespace {

constexpr std::uint8_t kMoved = 32;     // above NodeChange::kTicked
constexpr std::uint8_t kUnknown = 255;  // no Activity

bool is_running(std::uint8_t state) {
  return status_of(static_cast<Activity>(state & (NodeChange::kTicked - 1u))) == Status::Running;
}

// Simple enough for the compiler to do many nodes at a time.
void put_states(const Moment& moment, const std::uint8_t* moved, std::uint8_t* states) {
  const std::uint32_t tick = moment.number;
  const std::uint8_t ticked = tick != 0 ? NodeChange::kTicked : 0;  // 0: there was none yet
  const Activity* const activity = moment.activity.data();
  const std::uint32_t* const last = moment.reached.data();
  const std::size_t count = moment.activity.size();
  for (std::size_t i = 0; i < count; ++i) {
    const auto of_tick = static_cast<std::uint8_t>(last[i] == tick ? ticked : 0);
    states[i] =
        static_cast<std::uint8_t>(static_cast<std::uint8_t>(activity[i]) | of_tick | moved[i]);
  }
}

// The synchronized nodes, and the children that measures compare, in order.
std::vector<NodeIndex> compared_nodes(const Shape& shape) {
  std::set<NodeIndex> nodes;
  for (NodeIndex node = 0; node < shape.nodes.size(); ++node) {
    const ShapeNode& it = shape.nodes[node];
    const bool compares = compares_progress(it.synchronization);
    if (compares) nodes.insert(node);
    if (compares || it.latches) nodes.insert(it.held().begin(), it.held().end());
  }
  return {nodes.begin(), nodes.end()};
}

}  // namespace

RunDelta::RunDelta(const Shape& shape)
    : measured_(compared_nodes(shape)),
      succeeded_(measured_),  // for its room
      progress_(shape.nodes.size()),
      source_(shape.nodes.size()),
      moved_(shape.nodes.size()),
      state_(shape.nodes.size()),
      kept_(shape.nodes.size()),
      kept_progress_(shape.nodes.size()),
      changes_(shape.nodes.size()) {
  for (const ShapeNode& it : shape.nodes) is_leaf_.push_back(it.children.empty());
  std::size_t compared = 0;
  for (const ShapeNode& it : shape.nodes) {
    if (!it.paces) continue;
    for (const NodeIndex node : it.held()) kept_factors_.push_back({.node = node});
  }
  factors_.reserve(kept_factors_.size());
  for (const NodeIndex node : synchronized_nodes(shape)) {
    kept_limits_.push_back({.node = node});
    const ShapeNode& it = shape.nodes[node];
    if (it.is_pool()) continue;
    keepers_.push_back({.node = node, .held = it.held(), .is_group = it.is_group()});
    compared += keepers_.back().held.size();
  }
  own_progress_.reserve(compared);
  first_user_ = kept_limits_.size();
  for (const NodeIndex node : users_of_pools(shape)) kept_limits_.push_back({.node = node});
  limits_.reserve(kept_limits_.size());
  for (const NodeIndex node : repeating_nodes(shape)) kept_rounds_.push_back({.node = node});
  rounds_.reserve(kept_rounds_.size());
}

// Only running nodes are asked. The progress of all others follows from their Activity, so it is
// computed again only after a change of Activity.
void RunDelta::before_tick(const Moment& moment) {
  moment.live->share_progress();
  const std::span<const Activity> activity = moment.activity;
  for_each_difference(activity, source_.data(), [&](NodeIndex node) {
    set_progress(node, moment.live->progress(node));
    const bool running = status_of(activity[node]) == Status::Running;
    source_[node] = running ? kUnknown : static_cast<std::uint8_t>(activity[node]);
  });
}

std::span<const NodeChange> RunDelta::changes(const Moment& moment) {
  take_used(moment);
  put_states(moment, moved_.data(), state_.data());
  count_ = 0;
  has_turns_ = has_begun_ = false;
  if (is_whole_) {
    for (NodeIndex node = 0; node < state_.size(); ++node) {
      if ((state_[node] | kept_[node]) != 0 || progress_[node] != 0) add_change(node);
    }
  } else {
    for_each_difference(std::span<const std::uint8_t>(state_), kept_.data(),
                        [this](NodeIndex node) { add_change(node); });
  }
  return {changes_.data(), count_};
}

void RunDelta::add_change(NodeIndex node) {
  const auto state = static_cast<std::uint8_t>(state_[node] & ~kMoved);
  changes_[count_++] = {.progress = progress_[node], .node = node, .state = state};
  has_turns_ |= state != kept_[node];
  has_begun_ |= is_running(state) && !is_running(kept_[node]);
}

std::span<const NodeIndex> RunDelta::succeeded(const Moment& moment) {
  succeeded_.clear();
  if (moment.ended.empty()) return {};
  for (const NodeIndex node : measured_) {
    const bool is_ended = std::ranges::find(moment.ended, node) != moment.ended.end();
    if (is_ended) succeeded_.push_back(node);
  }
  return succeeded_;
}

std::span<const LimitChange> RunDelta::limits(const Moment& moment) {
  limits_.clear();
  for (std::size_t i = 0; i < kept_limits_.size(); ++i) {
    const LimitChange& kept = kept_limits_[i];
    const bool is_as_kept = i < first_user_ && !moment.ticked(kept.node);
    const double limit = is_as_kept ? kept.limit : moment.limit(kept.node);
    const bool is_new = limit != (all_limits_ ? 0 : kept.limit);
    if (is_new || (is_whole_ && limit != 0)) limits_.push_back({kept.node, limit});
  }
  return limits_;
}

std::span<const RoundChange> RunDelta::rounds(const Moment& moment) {
  rounds_.clear();
  for (const RoundChange& kept : kept_rounds_) {
    const bool is_running = moment.status(kept.node) == Status::Running;
    const Round round = is_running ? moment.live->round(kept.node) : Round{};
    const bool is_new = round != kept.round;
    if (is_new || (is_whole_ && round != Round{})) rounds_.push_back({kept.node, round});
  }
  return rounds_;
}

std::span<const FactorChange> RunDelta::factors(const Moment& moment) {
  factors_.clear();
  for (const FactorChange& kept : kept_factors_) {
    const double factor = moment.factor(kept.node);
    if (factor != kept.factor || (is_whole_ && factor != 1))
      factors_.push_back({kept.node, factor});
  }
  return factors_;
}

std::span<const ReasonChange> RunDelta::reasons(const Moment& moment) {
  reasons_.clear();
  while (kept_reasons_.size() < moment.reasons.size()) {
    kept_reasons_.emplace_back().reserve(kMostOfReason);
  }
  for (std::size_t i = 0; i < moment.reasons.size(); ++i) {
    const Reason& it = moment.reasons[i];
    const std::string_view text = moment.holds(it) ? std::string_view(it.text) : "";
    if (text == kept_reasons_[i] && !(is_whole_ && !text.empty())) continue;
    reasons_.push_back({.place = i, .node = it.node, .text = text});
  }
  return reasons_;
}

std::span<const Heard> RunDelta::heard(const Moment& moment) {
  heard_.clear();
  if (kept_heard_.size() != moment.heard.size()) {
    kept_heard_.assign(moment.heard.begin(), moment.heard.end());
    heard_.reserve(moment.heard.size());
    forget_heard();
  }
  for (std::size_t i = 0; i < moment.heard.size(); ++i) {
    const Heard &it = moment.heard[i], &kept = kept_heard_[i];
    const bool is_new = it.word != kept.word || it.run != kept.run;
    if (is_new || (is_whole_ && it.word != 0)) heard_.push_back(it);
  }
  return heard_;
}

void RunDelta::forget_heard() {
  for (Heard& kept : kept_heard_) kept = {.node = kept.node};
}

void RunDelta::start_over() {
  forget_heard();
  for (std::string& kept : kept_reasons_) kept.clear();
  for (FactorChange& kept : kept_factors_) kept.factor = 1;
  std::ranges::fill(kept_, 0);
  std::ranges::fill(kept_progress_, 0);
  for (NodeIndex node = 0; node < progress_.size(); ++node) set_progress(node, progress_[node]);
  for (RoundChange& kept : kept_rounds_) kept.round = {};
  all_limits_ = true;
}

void RunDelta::keep() {
  all_limits_ = is_whole_ = false;
  auto kept_round = kept_rounds_.begin();
  for (const RoundChange& change : rounds_) {  // in the same order
    while (kept_round->node != change.node) ++kept_round;
    kept_round->round = change.round;
  }
  auto kept_factor = kept_factors_.begin();
  for (const FactorChange& change : factors_) {  // in the same order
    while (kept_factor->node != change.node) ++kept_factor;
    kept_factor->factor = change.factor;
  }
  for (const ReasonChange& change : reasons_) kept_reasons_[change.place] = change.text;
  auto kept_heard = kept_heard_.begin();
  for (const Heard& it : heard_) {  // in the same order
    while (kept_heard->node != it.node) ++kept_heard;
    *kept_heard = it;
  }
  auto kept = kept_limits_.begin();
  for (const LimitChange& change : limits_) {  // in the same order
    while (kept->node != change.node) ++kept;
    kept->limit = change.limit;
  }
  for (const NodeChange& change : std::span(changes_).first(count_)) {
    kept_[change.node] = change.state;
    kept_progress_[change.node] = change.progress;
    moved_[change.node] = 0;
  }
}

void RunDelta::set_progress(NodeIndex node, double progress) {
  progress_[node] = progress;
  moved_[node] = progress != kept_progress_[node] ? kMoved : 0;
}

// The numbers that a synchronized node has used replace those from before its tick.
void RunDelta::take_used(const Moment& moment) {
  own_progress_.clear();
  for (const Keeper& it : keepers_) {
    if (!asked_children(moment, it.node, it.held, it.is_group)) continue;
    const std::span<const double> used = moment.used(it.node);
    for (std::size_t child = 0; child < it.held.size(); ++child) {
      const NodeIndex node = it.held[child];
      const double number = is_left_out(used[child]) ? 0 : used[child];
      const bool has_run = source_[node] == kUnknown;
      if (has_run && is_leaf_[node] && number != progress_[node]) {
        own_progress_.push_back({.node = node, .progress = progress_[node]});
      }
      set_progress(node, number);
      source_[node] = kUnknown;
    }
  }
}

}  // namespace lockstep::host
