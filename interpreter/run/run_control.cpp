#include "run/run_control.h"

#include "engine/blackboard.h"

#include <algorithm>
#include <utility>

namespace lockstep::host {

void RunControl::give(Order order) {
  {
    const Lock lock(mutex_);
    new_.push_back(std::move(order));
    has_new_.store(true, std::memory_order_release);
  }
  bell_.ring();
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

void RunControl::take_orders(Ticker& ticker, Blackboard& blackboard) {
  obey_new(ticker, blackboard);
  if (!longest_alone_) return;
  const Nanoseconds now = monotonic_now();
  if (!attended_) attended_ = now;
  if (std::exchange(is_attended_, now - *attended_ < *longest_alone_) == is_attended_) return;
  const Lock lock(mutex_);
  state_.is_attended = is_attended_;
}

void RunControl::obey_new(Ticker& ticker, Blackboard& blackboard) {
  if (!has_new_.load(std::memory_order_acquire)) return;
  std::vector<Order> orders;
  {
    const Lock lock(mutex_);
    orders.swap(new_);
    has_new_.store(false, std::memory_order_release);
  }
  for (const Order& order : orders) obey(order, ticker, blackboard);
  const Lock lock(mutex_);
  state_.speed = speed_;
}

void RunControl::obey(const Order& order, Ticker& ticker, Blackboard& blackboard) {
  switch (order.what) {
    case Order::What::Pause:
      pause(false);
      return;
    case Order::What::Resume:
      is_paused_ = false;
      ticks_left_.reset();
      return;
    case Order::What::Step:
      is_paused_ = false;
      ticks_left_ = ticks_left_.value_or(0) + order.ticks;
      return;
    case Order::What::Halt:
      is_halted_ = true;
      return;
    case Order::What::Speed:
      speed_ = order.speed;
      return;
    case Order::What::Set:
      return set(blackboard.entries[order.slot], order);
    case Order::What::Attend:
      attended_ = monotonic_now();
      return;
    case Order::What::Answer:
      return answer(order, ticker);
    case Order::What::Break:
      if (order.is_on) return breakpoints_.set(ticker, order.breakpoint);
      return breakpoints_.remove(order.breakpoint);
  }
}

// What came with a question that the person has not seen yet is no answer to it.
void RunControl::answer(const Order& order, Ticker& ticker) {
  const std::uint32_t last = ticker.tick_number();
  const std::uint64_t seen = order.seen ? std::min<std::uint64_t>(*order.seen + 1, last) : last;
  ticker.answer(order.node, {order.option, order.text, order.who},
                static_cast<std::uint32_t>(seen));
}

// An entry without a type keeps none, as one of a tree for BehaviorTree.CPP may.
void RunControl::set(Entry& entry, const Order& order) {
  if (!entry.is_present) make_entry(entry, Typing::Any);
  if (entry.typing != Typing::Any) {
    write_entry(entry, order.type, nullptr, order.value);
  } else {
    entry.assign(order.value);
  }
}

void RunControl::count_tick(Ticker& ticker) {
  reached_ = breakpoints_.reached(ticker);
  const bool is_last = ticks_left_ && --*ticks_left_ == 0;
  if (reached_ || is_last) pause(!reached_);
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
