#include "language/property/property.h"

#include <algorithm>

namespace lockstep::host {

std::string_view to_string(PropertyVerdict verdict) {
  constexpr std::string_view kNames[] = {"open", "holds", "violated"};
  return kNames[static_cast<std::size_t>(verdict)];
}

std::vector<ProgressComparison> Property::progress_comparisons() const {
  std::vector<ProgressComparison> all = formula_.progress;
  for (ProgressComparison& it : all) it.node = formula_.nodes[it.node];
  return all;
}

bool Property::needs_progress(std::size_t place) const {
  return std::ranges::any_of(formula_.progress,
                             [place](const ProgressComparison& it) { return it.node == place; });
}

// The state is a number in as few bytes as its largest value needs.
//   Never      nothing
//   Sometimes  1: it was so
//   LeadsTo    0: nothing is owed; else how many ticks ago the oldest debt began, and 1
//   OnlyAfter  1: what must come before has come
//   AfterNever 1: the first event has come
//   AtMost     how many ticks in a row it has been so
//   Until      1: the end has come
//   Finally    1: it is so after this tick
void Property::choose_state() {
  std::uint32_t most = 1;
  if (pattern_ == Pattern::Never) most = 0;
  if (pattern_ == Pattern::AtMost) most = ticks_;
  if (has_limit_) most = ticks_ + 1;  // between two moments of a tick
  for (; most != 0; most >>= 8u) ++state_size_;
}

void Property::begin(std::byte* state) const {
  std::fill_n(state, state_size_, std::byte{0});
}

std::uint32_t Property::load(const std::byte* state) const {
  std::uint32_t value = 0;
  for (std::size_t i = state_size_; i-- > 0;) {
    value = value << 8u | std::to_integer<std::uint32_t>(state[i]);
  }
  return value;
}

void Property::store(std::byte* state, std::uint32_t value) const {
  for (std::size_t i = 0; i < state_size_; ++i) state[i] = std::byte(value >> (8 * i) & 0xffu);
}

PropertyVerdict Property::step(std::byte* state, const PropertyView& view, TickPart part) const {
  using enum PropertyVerdict;
  const auto holds = [&](const FormulaCode& code) {
    return formula_.holds(code, view.nodes, view.comparisons);
  };
  const bool left = holds(left_);
  const bool right = !right_.empty() && holds(right_);
  switch (pattern_) {
    case Pattern::Never:
      return left ? Violated : Open;
    case Pattern::Sometimes:
      if (left) store(state, 1);
      return load(state) != 0 ? Holds : Open;
    case Pattern::LeadsTo:
      return step_leads_to(state, left, right, part);
    case Pattern::OnlyAfter:
      if (right) store(state, 1);
      if (load(state) != 0) return Holds;
      return left ? Violated : Open;
    case Pattern::AfterNever:
      if (right && load(state) != 0) return Violated;
      if (left) store(state, 1);
      return Open;
    case Pattern::AtMost:
      return step_at_most(state, left, part);
    case Pattern::Until:
      if (right) store(state, 1);
      if (load(state) != 0) return Holds;
      return left ? Open : Violated;
    case Pattern::Finally:
      store(state, left ? 1 : 0);
      return Open;
  }
  return Open;
}

// A tick counts once, however many of its moments are in the row.
PropertyVerdict Property::step_at_most(std::byte* state, bool left, TickPart part) const {
  const std::uint32_t row = left ? load(state) : 0;
  const bool counts = left && (row == 0 || part.is_first);
  if (counts && row == ticks_) return PropertyVerdict::Violated;
  store(state, counts ? row + 1 : row);
  return PropertyVerdict::Open;
}

PropertyVerdict Property::step_leads_to(std::byte* state, bool left, bool right,
                                        TickPart part) const {
  std::uint32_t debt = load(state);
  if (right) {
    debt = 0;
  } else if (debt != 0) {
    if (has_limit_ && part.is_first) ++debt;
  } else if (left) {
    debt = 1;
  }
  // The debt began debt - 1 ticks ago, and this tick has not paid it.
  if (has_limit_ && debt == ticks_ + 1 && part.is_last) return PropertyVerdict::Violated;
  store(state, debt);
  return PropertyVerdict::Open;
}

PropertyVerdict Property::at_end(const std::byte* state) const {
  using enum PropertyVerdict;
  const bool is_set = load(state) != 0;
  switch (pattern_) {
    case Pattern::Never:
    case Pattern::OnlyAfter:
    case Pattern::AfterNever:
    case Pattern::AtMost:
      return Holds;
    case Pattern::Sometimes:
    case Pattern::Until:
    case Pattern::Finally:
      return is_set ? Holds : Violated;
    case Pattern::LeadsTo:
      return is_set ? Violated : Holds;
  }
  return Holds;
}

}  // namespace lockstep::host
