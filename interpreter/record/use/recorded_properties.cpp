#include "record/use/recorded_properties.h"

#include <fmt/format.h>

#include <vector>

#include "base/core/diagnostics.h"
#include "base/json/json.h"
#include "base/terminal/text_table.h"
#include "judge/measure/live_properties.h"

namespace lockstep::host {
namespace {

void step(const RecordedTick& tick, PropertyChecks& checks, std::vector<NodeState>& moment) {
  const auto seen = checks.seen();
  for (std::size_t place = 0; place < seen.size(); ++place) {
    const RecordedState& state = tick.nodes[checks.nodes()[place]];
    seen[place] = {state.status, state.ticked, state.held, state.progress};
  }
  const auto comparisons = checks.comparisons();
  for (const RecordedEntry& entry : tick.entries) {
    for (std::size_t i = 0; i < comparisons.size(); ++i) {
      if (comparisons[i].entry != entry.entry) continue;
      checks.compared()[i] = entry.value ? comparisons[i].holds_for_text(*entry.value)
                                         : comparisons[i].holds_without_value();
    }
  }
  if (tick.moments.empty()) {
    checks.step(tick.tick);
    return;
  }
  tick.moments.each_part(moment, [&](std::span<const NodeState> states, bool first, bool last) {
    for (std::size_t place = 0; place < seen.size(); ++place) {
      see_node(seen[place], states[checks.nodes()[place]], first);
    }
    checks.step(tick.tick, {.is_first = first, .is_last = last});
  });
}

RunIsOver how_it_ended(const std::optional<RecordedEnd>& end) {
  const bool by_itself = end && (end->reason == "completed" || end->reason == "fault");
  return by_itself ? RunIsOver::ByItself : RunIsOver::FromOutside;
}

}  // namespace

void check_recording(RecordingReader& reader, PropertyChecks& checks) {
  std::uint64_t next = 0;
  std::vector<NodeState> moment;
  while (const auto tick = reader.next()) {
    if (tick->tick != next) checks.give_up();
    next = tick->tick + 1;
    step(*tick, checks, moment);
  }
  if (!reader.gaps().empty()) checks.give_up();
  checks.end(how_it_ended(reader.end()));
}

std::string to_table(const PropertyChecks& checks) {
  std::vector<TableRow> rows = {{"verdict", "tick", "property"}};
  for (std::size_t i = 0; i < checks.all().size(); ++i) {
    const Property& it = checks.all()[i];
    const auto tick = checks.decided(i);
    rows.push_back({std::string(to_string(checks.verdict(i))),
                    tick ? fmt::format("{}", *tick) : "-",
                    printable(it.has_name() ? it.name() + ": " + it.text() : it.text())});
  }
  return text_table(rows, rows.front().size());
}

std::string to_json(const PropertyChecks& checks) {
  Json json = Json::array();
  for (std::size_t i = 0; i < checks.all().size(); ++i) {
    const Property& it = checks.all()[i];
    json.push_back({{"name", it.name()},
                    {"property", it.text()},
                    {"verdict", to_string(checks.verdict(i))},
                    {"tick", checks.decided(i)}});
  }
  return json.printable();
}

}  // namespace lockstep::host
