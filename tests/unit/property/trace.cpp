#include "unit/property/trace.h"

#include <utility>

namespace lockstep::host::test {

PropertyNames Trace::names() const {
  PropertyNames names;
  for (const TraceNode& it : nodes) names.paths.push_back(it.path);
  for (const TraceEntry& it : entries) names.entries.push_back({it.key, it.type, true});
  return names;
}

SeenNode Trace::seen(std::size_t node, std::size_t tick) const {
  const TraceNode& it = nodes[node];
  SeenNode seen;
  const char letter = it.ticks[tick];
  switch (letter) {
    case 'r':
    case 'h':
      seen.status = Status::Running;
      break;
    case 's':
      seen.status = Status::Success;
      break;
    case 'f':
      seen.status = Status::Failure;
      break;
    case 'k':
      seen.status = Status::Skipped;
      break;
    default:
      seen.status = Status::Idle;
  }
  seen.held = letter == 'h';
  seen.ticked = letter != 'h' && letter != 'i';
  if (tick < it.progress.size()) seen.progress = it.progress[tick];
  return seen;
}

std::string verdict_of(const Property& property, const Trace& trace, RunIsOver end) {
  PropertyChecks checks({property});
  for (std::size_t tick = 0; tick < trace.size(); ++tick) {
    for (std::size_t i = 0; i < checks.nodes().size(); ++i) {
      checks.seen()[i] = trace.seen(checks.nodes()[i], tick);
    }
    for (std::size_t i = 0; i < checks.comparisons().size(); ++i) {
      const EntryComparison& comparison = checks.comparisons()[i];
      const std::string& value = trace.entries[comparison.entry].values[tick];
      checks.compared()[i] =
          value.empty() ? comparison.holds_without_value() : comparison.holds_for_text(value);
    }
    checks.step(trace.tick_of(tick), trace.part(tick));
  }
  checks.end(end);
  std::string text(to_string(checks.verdict(0)));
  if (const auto tick = checks.decided(0)) text += " " + std::to_string(*tick);
  return text;
}

}  // namespace lockstep::host::test
