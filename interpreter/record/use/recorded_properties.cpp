#include "record/use/recorded_properties.h"

#include <fmt/format.h>

#include "base/core/diagnostics.h"
#include "base/json/json.h"
#include "base/terminal/text_table.h"
#include "judge/measure/property_steps.h"
#include "record/read/recorded_moments.h"

namespace lockstep::host {
namespace {

RunIsOver how_it_ended(const std::optional<RecordedEnd>& end) {
  const bool by_itself = end && (end->reason == "completed" || end->reason == "fault");
  return by_itself ? RunIsOver::ByItself : RunIsOver::FromOutside;
}

}  // namespace

void check_recording(RecordingReader& reader, PropertyChecks& checks) {
  std::uint64_t next = 0;
  RecordedMoments moments(reader.header());
  PropertySteps steps(checks);
  while (const auto tick = reader.next()) {
    if (tick->tick != next) checks.give_up();
    next = tick->tick + 1;
    steps.after_tick(moments.read(*tick));
  }
  // Without a closing line, ticks may be missing behind the last one.
  if (!reader.gaps().empty() || !reader.end()) checks.give_up();
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
