#include "language/property/property_checks.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace lockstep::host {

PropertyChecks::PropertyChecks(std::vector<Property> properties)
    : properties_(std::move(properties)) {
  for (const Property& property : properties_) {
    checked_.push_back({.first_node = nodes_.size(),
                        .first_comparison = comparisons_.size(),
                        .first_byte = states_.size()});
    for (std::size_t place = 0; place < property.nodes().size(); ++place) {
      nodes_.push_back(property.nodes()[place]);
      needs_progress_.push_back(property.needs_progress(place));
    }
    const auto comparisons = property.comparisons();
    comparisons_.insert(comparisons_.end(), comparisons.begin(), comparisons.end());
    states_.resize(states_.size() + property.state_size());
    property.begin(states_.data() + checked_.back().first_byte);
  }
  seen_.resize(nodes_.size());
  decided_by_.resize(nodes_.size());
  compared_ = std::make_unique<bool[]>(comparisons_.size());
  for (std::size_t i = 0; i < comparisons_.size(); ++i) {
    compared_[i] = comparisons_[i].holds_without_value();
  }
  violated_.reserve(properties_.size());
}

std::span<const std::size_t> PropertyChecks::step(std::uint64_t tick, TickPart part) {
  if (part.is_first) violated_.clear();
  if (has_given_up_) return violated_;
  for (std::size_t i = 0; i < properties_.size(); ++i) {
    Checked& it = checked_[i];
    if (it.verdict != PropertyVerdict::Open) continue;
    const Property& property = properties_[i];
    const PropertyView view{std::span(seen_).subspan(it.first_node, property.nodes().size()),
                            compared().subspan(it.first_comparison, property.comparisons().size())};
    it.verdict = property.step(states_.data() + it.first_byte, view, part);
    if (it.verdict == PropertyVerdict::Open) continue;
    it.decided = tick;
    std::ranges::copy(view.nodes, decided_by_.begin() + static_cast<std::ptrdiff_t>(it.first_node));
    if (it.verdict == PropertyVerdict::Violated) violated_.push_back(i);
  }
  return violated_;
}

std::span<const std::size_t> PropertyChecks::end(RunIsOver how) {
  violated_.clear();
  if (has_given_up_) return violated_;
  for (std::size_t i = 0; i < properties_.size(); ++i) {
    Checked& it = checked_[i];
    if (it.verdict != PropertyVerdict::Open) continue;
    const auto verdict = properties_[i].at_end(states_.data() + it.first_byte);
    const bool is_owed = verdict == PropertyVerdict::Violated || properties_[i].is_of_last_tick();
    if (is_owed && how == RunIsOver::FromOutside) continue;
    it.verdict = verdict;
    if (verdict == PropertyVerdict::Violated) violated_.push_back(i);
  }
  return violated_;
}

void PropertyChecks::give_up() {
  has_given_up_ = true;
}

// A head, whether each comparison holds, and the state of the monitor.
void PropertyChecks::keep(KeptProperties& into) const {
  into.resize(properties_.size());
  for (std::size_t i = 0; i < properties_.size(); ++i) {
    const Checked& it = checked_[i];
    KeptHead head{};
    std::memset(&head, 0, sizeof head);  // what is kept has no padding of chance
    head.verdict = it.verdict;
    head.is_decided = it.decided.has_value();
    head.decided = it.decided.value_or(0);
    auto& [text, bytes] = into[i];
    text.assign(properties_[i].text());
    bytes.assign(reinterpret_cast<const char*>(&head), sizeof head);
    const std::size_t count = properties_[i].comparisons().size();
    bytes.append(reinterpret_cast<const char*>(compared_.get() + it.first_comparison), count);
    bytes.append(reinterpret_cast<const char*>(states_.data() + it.first_byte), state_size(i));
  }
}

std::vector<std::string> PropertyChecks::go_on(const KeptProperties& kept) {
  std::vector<std::string> missing;
  for (std::size_t i = 0; i < properties_.size(); ++i) {
    const auto found =
        std::ranges::find(kept, properties_[i].text(), [](const auto& it) { return it.first; });
    const std::size_t count = properties_[i].comparisons().size();
    if (found == kept.end() || found->second.size() != sizeof(KeptHead) + count + state_size(i)) {
      missing.push_back(properties_[i].name());
      continue;
    }
    const char* from = found->second.data();
    KeptHead head{};
    std::memcpy(&head, from, sizeof head);
    from += sizeof head;
    Checked& it = checked_[i];
    it.verdict = head.verdict;
    if (head.is_decided) it.decided = head.decided;
    for (std::size_t place = 0; place < count; ++place)
      compared_[it.first_comparison + place] = *from++ != 0;
    std::memcpy(states_.data() + it.first_byte, from, state_size(i));
  }
  return missing;
}

bool PropertyChecks::any(PropertyVerdict verdict) const {
  return std::ranges::any_of(checked_,
                             [verdict](const Checked& it) { return it.verdict == verdict; });
}

}  // namespace lockstep::host
