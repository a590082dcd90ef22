#include "verify/stepper.h"

#include "engine/groups.h"

namespace lockstep::host {
namespace {

constexpr int kMostTicksAtOnce = 10'000;

SavedRun saved(const Ticker& ticker) {
  SavedRun run;
  ticker.save(run);
  return run;
}

std::size_t size_of(const Monitors& monitors) {
  std::size_t size = 0;
  for (const auto& it : monitors) size += it->state_size();
  return size;
}

}  // namespace

Stepper::Stepper(const Tree& tree, const LeafModels& models, const Monitors& monitors,
                 Nanoseconds period)
    : tree_(tree),
      monitors_(monitors),
      period_(period),
      board_(tree),
      leaves_(tree, models, board_, odometer_),
      ticker_(tree, leaves_.slots(), board_),
      fresh_(saved(ticker_)),
      from_(fresh_),
      code_(tree, models, fresh_),
      from_leaves_(leaves_.states()),
      from_facts_(leaves_.facts()),
      monitor_bytes_(size_of(monitors)),
      from_monitors_(monitor_bytes_) {}

StateBytes Stepper::first_state() {
  ticker_.restore(fresh_);
  std::byte* at = monitor_bytes_.data();
  for (const auto& it : monitors_) {
    it->begin(at);
    at += it->state_size();
  }
  StateBytes state;
  code_.encode(ticker_, leaves_, monitor_bytes_, state);
  return state;
}

void Stepper::load(std::span<const std::byte> state, bool is_first) {
  code_.decode(state, from_, from_leaves_, from_facts_, from_monitors_);
  time_ = is_first ? Nanoseconds(0) : period_;
  odometer_.start_over();
}

Status Stepper::tick() {
  ticker_.restore(from_);
  leaves_.states() = from_leaves_;
  leaves_.facts() = from_facts_;
  leaves_.restored();
  odometer_.begin();
  leaves_.begin_tick();
  Status status = ticker_.tick_root(time_);
  for (int count = 1; ticker_.is_asked(); ++count) {
    const auto node = ticker_.take_request();
    if (!node || status != Status::Running || ticker_.faulted()) break;
    if (count == kMostTicksAtOnce) {
      ticker_.set_fault(*node, "asked for another tick 10,000 times in one period");
      break;
    }
    status = ticker_.tick_root_again();
  }
  violated_ = nullptr;
  if (!monitors_.empty()) step_monitors(status);
  return status;
}

void Stepper::step_monitors(Status status) {
  monitor_bytes_ = from_monitors_;
  std::byte* at = monitor_bytes_.data();
  for (const auto& it : monitors_) {
    Monitor::Answer answer = it->step(at, ticker_);
    if (answer == Monitor::Answer::Open && status != Status::Running) answer = it->at_end(at);
    if (answer == Monitor::Answer::Violated && violated_ == nullptr) violated_ = it.get();
    at += it->state_size();
  }
}

const StateBytes& Stepper::fold() {
  ticker_.fold();
  leaves_.fold();
  code_.encode(ticker_, leaves_, monitor_bytes_, folded_);
  return folded_;
}

}  // namespace lockstep::host
