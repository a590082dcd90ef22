#include "cli/run/break_conditions.h"

#include <algorithm>
#include <utility>

namespace lockstep::host {
namespace {

constexpr std::string_view kNever = "never ";

}  // namespace

Property::Parsed parse_break_condition(std::string_view text, const PropertyNames& names) {
  auto property = Property::parse(std::string(kNever).append(text), names);
  if (property) return property;
  PropertyError error = std::move(property.error());
  error.offset -= std::min(error.offset, kNever.size());
  return tl::unexpected(std::move(error));
}

BreakConditions::Watched::Watched(Property condition)
    : property(std::move(condition)),
      seen(property.nodes().size()),
      compared(std::make_unique<bool[]>(property.comparisons().size())),
      state(property.state_size()) {}

BreakConditions::BreakConditions(std::vector<Property> conditions) {
  for (Property& it : conditions) watched_.emplace_back(std::move(it));
  room_.reserve(2 * EntryComparison::kLongest);
}

AskedOfRun BreakConditions::asked() const {
  AskedOfRun asked{.within = !watched_.empty()};
  for (const Watched& it : watched_) {
    for (std::size_t place = 0; place < it.seen.size(); ++place) {
      if (it.property.needs_progress(place)) asked.progress.push_back(it.property.nodes()[place]);
    }
  }
  return asked;
}

std::string_view BreakConditions::after_tick(const Moment& moment) {
  std::string_view first;
  for (Watched& it : watched_) {
    const bool is = is_true(it, moment), was = std::exchange(it.was_true, is);
    if (is && !was && first.empty())
      first = std::string_view(it.property.text()).substr(kNever.size());
  }
  return first;
}

bool BreakConditions::is_true(Watched& watched, const Moment& moment) {
  const Property& property = watched.property;
  const auto nodes = property.nodes();
  for (std::size_t place = 0; place < nodes.size(); ++place) {
    if (property.needs_progress(place)) {
      watched.seen[place].progress = moment.progress[nodes[place]];
    }
  }
  const auto comparisons = property.comparisons();
  for (std::size_t i = 0; i < comparisons.size(); ++i) {
    const Entry& entry = moment.entries[comparisons[i].entry];
    watched.compared[i] = entry.has_value() ? comparisons[i].holds_for(entry.value(), room_)
                                            : comparisons[i].holds_without_value();
  }
  property.begin(watched.state.data());
  bool is = false;
  steps_.each(moment, nodes, watched.seen, [&](TickPart part) {
    const PropertyView view{watched.seen, {watched.compared.get(), comparisons.size()}};
    is = is || property.step(watched.state.data(), view, part) == PropertyVerdict::Violated;
  });
  return is;
}

}  // namespace lockstep::host
