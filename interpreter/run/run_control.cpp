#include "run/run_control.h"

#include <algorithm>
#include <utility>

#include "engine/blackboard.h"
#include "run/set_entry.h"

namespace lockstep::host {

std::uint64_t RunControl::give(Order order) {
  std::uint64_t number = 0;
  {
    const Lock lock(mutex_);
    number = ++given_;
    new_.push_back(std::move(order));
    has_new_.store(true, std::memory_order_release);
  }
  bell_.ring();
  return number;
}

std::optional<bool> RunControl::effect_of(std::uint64_t number) const {
  const Lock lock(mutex_);
  if (number > obeyed_) return has_ended() ? std::optional(false) : std::nullopt;
  return std::ranges::find(vain_, number) == vain_.end();
}

void RunControl::wait_for_effects(Nanoseconds longest) {
  const std::uint32_t seen = effects_.rung();
  {
    const Lock lock(mutex_);
    if (obeyed_ == given_ || has_ended()) return;
  }
  effects_.wait(seen, longest);
}

void RunControl::report_effects() {
  if (std::exchange(reported_, taken_) == taken_) return;
  {
    const Lock lock(mutex_);
    obeyed_ = taken_;
  }
  effects_.ring();
}

void RunControl::end(const Ticker& ticker) {
  for (const GivenAnswer& it : untaken_) tell_vain_(it, Vain::RunEnds);
  for (const GivenAnswer& it : ticker.waiting_answers()) tell_vain_(it, Vain::RunEnds);
  is_paused_ = false;
  is_attended_ = true;
  std::vector<Order> unseen;
  {
    const Lock lock(mutex_);
    has_ended_.store(true, std::memory_order_release);
    unseen.swap(new_);
  }
  for (const Order& it : unseen) {
    if (it.what == Order::What::Answer) tell_vain_({it.node, 0, it.text, it.who}, Vain::RunEnds);
  }
  effects_.ring();
}

RunControl::State RunControl::state() const {
  const Lock lock(mutex_);
  return state_;
}

void RunControl::need_attendance(Nanoseconds longest) {
  longest_alone_ = longest;
  const Lock lock(mutex_);
  state_.is_attended = true;
}

bool RunControl::take_orders(Ticker& ticker, Blackboard& blackboard) {
  const bool has_changed = obey_new(ticker, blackboard);
  if (!longest_alone_) return has_changed;
  const Nanoseconds now = monotonic_now();
  if (!attended_) attended_ = now;
  const bool was_attended = is_attended_;
  is_attended_ = now - *attended_ < *longest_alone_;
  if (was_attended != is_attended_) {
    const Lock lock(mutex_);
    state_.is_attended = is_attended_;
  }
  return has_changed;
}

bool RunControl::obey_new(Ticker& ticker, Blackboard& blackboard) {
  if (!has_new_.load(std::memory_order_acquire)) return false;
  std::vector<Order> orders;
  {
    const Lock lock(mutex_);
    orders.swap(new_);
    has_new_.store(false, std::memory_order_release);
  }
  bool has_changed = false;
  std::vector<std::uint64_t> vain;
  for (const Order& order : orders) {
    ++taken_;
    const Effect effect = obey(order, ticker, blackboard);
    has_changed |= effect == Effect::OnState;
    if (effect != Effect::None) continue;
    vain.push_back(taken_);
    tell_vain_({order.node, 0, order.text, order.who}, Vain::NobodyWaits);
  }
  const Lock lock(mutex_);
  state_.speed = speed_;
  constexpr std::size_t kMost = 1000;
  vain_.insert(vain_.end(), vain.begin(), vain.end());
  while (vain_.size() > kMost) vain_.pop_front();
  return has_changed;
}

RunControl::Effect RunControl::obey(const Order& order, Ticker& ticker, Blackboard& blackboard) {
  switch (order.what) {
    case Order::What::Pause:
      pause(false);
      break;
    case Order::What::Resume:
      is_paused_ = false;
      ticks_left_.reset();
      break;
    case Order::What::Step:
      is_paused_ = false;
      ticks_left_ = ticks_left_.value_or(0) + order.ticks;
      break;
    case Order::What::Halt:
      is_halted_ = true;
      break;
    case Order::What::Speed:
      speed_ = order.speed;
      break;
    case Order::What::Set:
      set_entry(blackboard.entries[order.slot], order.type, nullptr, order.value);
      return Effect::OnState;
    case Order::What::Attend:
      attended_ = monotonic_now();
      break;
    case Order::What::Answer:
      return answer(order, ticker) ? Effect::OnState : Effect::None;
    case Order::What::Break:
      order.is_on ? breakpoints_.set(ticker, order.breakpoint)
                  : breakpoints_.remove(order.breakpoint);
      break;
  }
  return Effect::OnLoop;
}

// What came with a question that the person has not seen yet is no answer to it.
bool RunControl::answer(const Order& order, Ticker& ticker) {
  const std::uint32_t last = ticker.tick_number();
  const std::uint64_t seen = order.seen ? std::min<std::uint64_t>(*order.seen + 1, last) : last;
  return ticker.answer(order.node, {order.option, order.text, order.who},
                       static_cast<std::uint32_t>(seen));
}

// An entry without a type keeps none, as one of a tree for BehaviorTree.CPP may.
void RunControl::count_tick(Ticker& ticker) {
  take_answers(ticker);
  reached_ = breakpoints_.reached(ticker);
  const bool is_last = ticks_left_ && --*ticks_left_ == 0;
  if (reached_ || is_last) pause(!reached_);
}

// A node takes its answer in its next tick. One that was halted before has told so.
void RunControl::take_answers(const Ticker& ticker) {
  const auto given = ticker.answers();
  untaken_.insert(untaken_.end(), given.begin(), given.end());
  std::erase_if(untaken_, [&](const GivenAnswer& it) {
    return ticker.ticked(it.node) || ticker.status(it.node) != Status::Running;
  });
}

void RunControl::pause(bool is_stepping) {
  is_paused_ = true;
  is_stepping_ = is_stepping;
  ticks_left_.reset();
}

void RunControl::report_standing(bool stands) {
  const Lock lock(mutex_);
  state_.is_paused = stands;
  state_.breakpoint = stands ? reached_ : std::nullopt;
  if (stands) pauses_.fetch_add(1, std::memory_order_release);
}

void RunControl::wait(Nanoseconds longest) {
  const std::uint32_t seen = bell_.rung();
  if (!has_new_.load(std::memory_order_acquire)) bell_.wait(seen, longest);
}

}  // namespace lockstep::host
