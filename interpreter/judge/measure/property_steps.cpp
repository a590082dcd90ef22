#include "judge/measure/property_steps.h"

namespace lockstep::host {

PropertyNames property_names(const Shape& shape) {
  PropertyNames names{.paths = paths_of(shape), .entries = {}};
  names.ends = PathEnds(names.paths);
  for (const ShapeEntry& it : shape.entries)
    names.entries.push_back({it.key, it.type, it.typing == Typing::Strict});
  return names;
}

namespace {

// What a comparison says of an entry, once that was written since `seen`; nothing: what it has
// said. An entry that has lost its value keeps the one before: recordings do not show that.
std::optional<bool> compare_entry(const Moment& moment, const EntryComparison& comparison,
                                  std::optional<std::uint32_t>& seen, std::string& room) {
  if (moment.texts.empty()) {
    const Entry& entry = moment.entries[comparison.entry];
    if (seen == entry.changes() || !entry.has_value()) return std::nullopt;
    seen = entry.changes();
    return comparison.holds_for(entry.value(), room);
  }
  const EntryText& entry = moment.texts[comparison.entry];
  if (seen.value_or(0) == entry.writes) return std::nullopt;
  seen = entry.writes;
  return entry.text ? comparison.holds_for_text(*entry.text) : comparison.holds_without_value();
}

}  // namespace

PropertySteps::PropertySteps(PropertyChecks& checks)
    : checks_(checks), writes_(checks.comparisons().size()) {
  room_.reserve(2 * EntryComparison::kLongest);
}

AskedOfRun PropertySteps::asked() const {
  AskedOfRun asked{.within = true};
  for (std::size_t place = 0; place < checks_.nodes().size(); ++place) {
    if (checks_.needs_progress(place)) asked.progress.push_back(checks_.nodes()[place]);
  }
  return asked;
}

std::span<const std::size_t> PropertySteps::after_tick(const Moment& moment) {
  const auto nodes = checks_.nodes();
  const auto seen = checks_.seen();
  for (std::size_t place = 0; place < seen.size(); ++place) {
    if (checks_.needs_progress(place)) seen[place].progress = moment.progress[nodes[place]];
  }
  for (std::size_t i = 0; i < writes_.size(); ++i) {
    const auto holds = compare_entry(moment, checks_.comparisons()[i], writes_[i], room_);
    if (holds) checks_.compared()[i] = *holds;
  }
  std::span<const std::size_t> violated;
  steps_.each(moment, nodes, seen,
              [&](TickPart part) { violated = checks_.step(moment.tick, part); });
  return violated;
}

}  // namespace lockstep::host
