#include "verify/tick_answers.h"

#include <algorithm>
#include <stdexcept>

namespace lockstep::host {

TickAnswers::TickAnswers(const Symmetry& symmetry, std::size_t askers)
    : equal_before_(askers, kNone), first_(askers, kNone) {
  for (const EqualChildren& it : symmetry.classes()) {
    for (std::size_t i = 1; i < it.places.size() && it.has_one_leaf; ++i) {
      neighbors_.push_back({it.places[i - 1], it.places[i], it.nodes, it.words});
    }
  }
}

// States have equal children in one order, so those in equal states are beside each other.
void TickAnswers::begin_state(const RunState& run, const std::vector<LeafState>& leaves) {
  forget_first();
  digits_.clear();
  at_ = 0;
  is_given_ = has_equal_ = false;
  for (const Neighbors& it : neighbors_) {
    const bool is_equal = leaves[it.before.leaf] == leaves[it.here.leaf] && are_equal(it, run);
    equal_before_[it.here.leaf] = is_equal ? it.before.leaf : kNone;
    has_equal_ |= is_equal;
  }
}

bool TickAnswers::are_equal(const Neighbors& it, const RunState& run) {
  const auto equal = [](const auto& all, std::size_t one, std::size_t other, std::size_t count) {
    return std::equal(all.begin() + one, all.begin() + one + count, all.begin() + other);
  };
  return equal(run.activity, it.before.node, it.here.node, it.nodes) &&
         equal(run.bytes, it.before.word, it.here.word, it.words);
}

void TickAnswers::give(std::span<const LeafAnswer> answers) {
  is_given_ = true;
  given_.assign(answers.begin(), answers.end());
}

void TickAnswers::forget_first() {
  for (std::size_t i = 0; i < at_ && has_equal_; ++i) first_[digits_[i].asker] = kNone;
}

void TickAnswers::begin() {
  forget_first();
  at_ = 0;
  if (!is_given_) return;
  digits_.clear();
  is_used_.assign(given_.size(), false);
}

bool TickAnswers::next() {
  forget_first();
  digits_.resize(at_);
  at_ = 0;
  while (!digits_.empty() && digits_.back().value + 1 == digits_.back().count) digits_.pop_back();
  if (digits_.empty()) return false;
  ++digits_.back().value;
  return true;
}

std::uint32_t TickAnswers::choose(std::uint32_t count, std::uint32_t asker) {
  if (count <= 1) return 0;
  if (at_ == digits_.size()) {
    digits_.push_back({is_given_ ? given(asker) : least(asker), count, asker});
  }
  const Digit& digit = digits_[at_++];
  if (has_equal_ && first_[asker] == kNone) first_[asker] = digit.value;
  return digit.value;
}

// Equal leaves in equal states have the same answers to choose from, and are asked in their order.
std::uint32_t TickAnswers::least(std::uint32_t asker) const {
  const std::uint32_t before = equal_before_[asker];
  if (before == kNone || first_[asker] != kNone || first_[before] == kNone) return 0;
  return first_[before];
}

std::uint32_t TickAnswers::given(std::uint32_t asker) {
  for (std::size_t i = 0; i < given_.size(); ++i) {
    if (is_used_[i] || given_[i].asker != asker) continue;
    is_used_[i] = true;
    return given_[i].value;
  }
  throw std::logic_error("a tick asks for more than it did before");
}

std::vector<LeafAnswer> TickAnswers::asked() const {
  std::vector<LeafAnswer> asked;
  for (std::size_t i = 0; i < at_; ++i) asked.push_back({digits_[i].asker, digits_[i].value});
  return asked;
}

}  // namespace lockstep::host
