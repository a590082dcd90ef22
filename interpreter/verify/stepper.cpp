#include "verify/stepper.h"

namespace lockstep::host {
namespace {

constexpr std::uint64_t kMostTicksAtOnce = 10'000, kTicksBetweenQuestions = 256;
const Symmetry kNoSymmetry;

SavedRun saved(const Ticker& ticker) {
  SavedRun run;
  ticker.save(run);
  return run;
}

}  // namespace

Stepper::Stepper(const Tree& tree, const LeafModels& models, std::span<const Property> properties,
                 Nanoseconds period, const Symmetry& symmetry, bool rising_answers)
    : period_(period),
      board_(tree),
      answers_(tree, rising_answers ? symmetry : kNoSymmetry,
               tree.leaves.size() + models.facts.size()),
      leaves_(tree, models, board_, answers_),
      ticker_(tree, leaves_.slots(), board_),
      watch_(tree, properties),
      fresh_(saved(ticker_)),
      from_(fresh_),
      code_(tree, models, fresh_, nodes_of(properties, tree), symmetry),
      parameters_(tree, fresh_),
      from_leaves_(leaves_.states()),
      from_facts_(leaves_.facts()),
      property_bytes_(watch_.state_size()),
      from_properties_(property_bytes_) {
  ticker_.keep_moments();
}

StateBytes Stepper::first_state() {
  ticker_.restore(fresh_);
  leaves_.restore(std::vector<LeafState>(from_leaves_.size()),
                  std::vector<FactState>(from_facts_.size(), FactState::Unknown));
  code_.before_fold(ticker_);
  watch_.begin(property_bytes_.data());
  StateBytes state;
  code_.encode(ticker_, leaves_, property_bytes_, StateCode::Children::AsTheyAre, state);
  return state;
}

void Stepper::load(std::span<const std::byte> state, bool is_first) {
  code_.decode(state, from_, from_leaves_, from_facts_, from_properties_, from_read_);
  parameters_.give(from_, from_read_, ticker_);
  leaves_.restore(from_leaves_, from_facts_);
  time_ = is_first ? Nanoseconds(0) : period_;
  answers_.begin_state(from_.run, from_leaves_);
}

Status Stepper::tick(std::uint64_t most) {
  ticker_.restore(from_);
  leaves_.restore_again(from_leaves_, from_facts_);
  answers_.begin();
  leaves_.begin_tick();
  if (!watch_.empty()) {
    property_bytes_ = from_properties_;
    ticker_.set_now(time_);
    watch_.before_tick(ticker_);
  }
  Status status = ticker_.tick_root(time_);
  for (root_ticks_ = 1; ticker_.is_asked() && root_ticks_ < most; ++root_ticks_) {
    if (gives_up_ && root_ticks_ % kTicksBetweenQuestions == 0 && gives_up_()) break;
    const auto node = ticker_.take_request();
    if (!node || status != Status::Running || ticker_.faulted()) break;
    if (root_ticks_ == kMostTicksAtOnce) {
      ticker_.set_fault(*node, "asked for another tick 10,000 times in one period");
      break;
    }
    if (before_tick_again_) before_tick_again_(leaves_);
    status = ticker_.tick_root_again();
  }
  if (!watch_.empty()) {
    const bool is_over = status != Status::Running || ticker_.faulted();
    watch_.after_tick(property_bytes_.data(), ticker_, leaves_.facts(), is_over);
  }
  return status;
}

const StateBytes& Stepper::fold() {
  parameters_.learn(from_, ticker_);
  code_.before_fold(ticker_);
  ticker_.fold();
  leaves_.fold();
  code_.encode(ticker_, leaves_, property_bytes_, StateCode::Children::Sorted, folded_);
  return folded_;
}

const StateBytes& Stepper::in_place() {
  code_.encode(ticker_, leaves_, property_bytes_, StateCode::Children::AsTheyAre, moved_);
  return moved_;
}

const StateBytes& Stepper::moved(std::span<const std::byte> state,
                                 std::span<const NodeIndex> places) {
  code_.move(state, places, moved_);
  return moved_;
}

}  // namespace lockstep::host
