#include "engine/ticker.h"

#include "engine/groups.h"
#include "engine/node_scripts.h"
#include "engine/node_watch.h"
#include "engine/readings.h"

namespace lockstep::host {

Ticker::Ticker(const Tree& tree, std::span<LeafSlot> leaves, Blackboard& board, FaultPolicy policy,
               LeafWatch* watch)
    : NodeContext(tree, leaves, board, policy, watch),
      is_plain_(groups_.empty() && readings_.empty()) {
  if (!readings_.empty()) make_room_for_progress();
}

// The first call of share_progress allocates, and in ticks nothing must.
void Ticker::make_room_for_progress() {
  const bool shares = shares_progress_;
  share_progress();
  shares_progress_ = shares;
}

Status Ticker::tick_root() {
  const InEngine scope(board_.lock.get());
  if (!is_plain_) [[unlikely]]
    return tick_root_beside();
  begin_tick();
  return end_calls(tick(0));
}

inline void Ticker::begin_tick() {
  ++state_.tick_number;
  shares_progress_ = false;
  state_.ended.clear();
  if (!held_leaves_.empty()) [[unlikely]]
    held_leaves_.look(*this);
  if (watch_ != nullptr) watch_->begin_tick();
  begin_calls();
}

// With what is beside the tree.
Status Ticker::tick_root_beside() {
  if (!readings_.empty()) readings_.read(*this);
  begin_tick();
  if (moments_ != nullptr) moments_->begin_tick(state_);
  const bool has_groups = !groups_.empty();
  if (has_groups) {
    groups_.tick(*this);
    begin_calls();  // what groups compute is no leaf's time
  }
  const Status result = tick(0);
  if (has_groups) groups_.end_tick();
  if (moments_ != nullptr) moments_->end_tick(state_);
  return end_calls(result);
}

Status Ticker::tick_root_again() {
  const InEngine scope(board_.lock.get());
  if (moments_ != nullptr) moments_->reopen(state_);
  groups_.reopen_tick();
  begin_calls();
  const Status result = tick(0);
  groups_.end_tick();
  if (moments_ != nullptr) moments_->end_tick(state_);
  return end_calls(result);
}

void Ticker::keep_moments() {
  if (moments_ != nullptr) return;
  moments_ = std::make_unique<Moments>(*this);
  make_room_for_progress();
  is_plain_ = false;
}

void Ticker::keep_moments_with_progress() {
  keep_moments();
  moments_->keep_progress();
}

void Ticker::begin_calls() {
  CallMark& mark = CallMark::this_thread();
  mark.set_tick(state_.tick_number - 1);
  const bool is_careful = watch_ != nullptr && watch_->looks_after_each_call();
  const bool gives_back = board_.lock != nullptr;  // around each call
  in_line_ =
      state_.interrupted || is_careful || gives_back || !is_usual_.is_guarded() ? nullptr : &mark;
  if (watch_ == nullptr) return;
  watch_->begin_calls();
  timer_ = watch_->timer();
}

Status Ticker::end_calls(Status result) {
  in_line_ = nullptr;
  if (watch_ != nullptr) watch_->end_tick();
  return result;
}

bool Ticker::answer(NodeIndex node, Answer given, std::uint32_t seen) {
  const auto answer = nodes_[node].kind->answer;
  if (answer == nullptr || !answer(*this, node, given.option, seen)) return false;
  const std::uint32_t next = state_.tick_number + 1;
  std::erase_if(answers_, [next](const GivenAnswer& it) { return it.number != next; });
  answers_.push_back({node, next, std::move(given.text), std::move(given.who)});
  return true;
}

void Ticker::halt_all() {
  const InEngine scope(board_.lock.get());
  shares_progress_ = false;
  state_.in_last_halt = true;
  halt_range(0, static_cast<NodeIndex>(tree_.nodes.size()));
  state_.in_last_halt = false;
}

void Ticker::recover() {
  halt_all();
  state_.faulted = false;
  state_.fault = {};
  state_.interrupted = !state_.failing.empty();
}

void Ticker::watch_nodes(std::span<const NodeIndex> nodes, NodeWatch* watch) {
  if (watches_ == nullptr) watches_ = std::make_unique<NodeWatches>(tree_);
  watches_->watch(nodes, watch);
  nodes_ = watches_->nodes();
  end_calls_in_line();  // in a tick: a loop over leaves goes on with other nodes
  scripts_.use(watches_->hooked());
  notes_halts_ = tree_.has_halt_hooks || watch != nullptr;
}

void Ticker::reset() {
  shares_progress_ = false;
  state_.reset();
  parameters_.reset();
  scripts_.reset();
  held_leaves_.reset();
  if (watch_ != nullptr) watch_->begin_run(tree_, leaves_, &is_usual_);
  for (LeafSlot& leaf : leaves_) leaf.out_of_range = leaf.went_on = false;
  for (Reason& it : reasons_) it.number = 0;
  answers_.clear();
}

}  // namespace lockstep::host
