#include "record/use/recording_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "base/core/csv_field.h"
#include "base/core/diagnostics.h"
#include "record/read/tick_results.h"

namespace lockstep::host {
namespace {

bool is_active(const RecordedState& node) {
  return node.status != Status::Idle || node.ticked;
}

// As of the measure `factor`.
double least_factor(const RecordedTick& tick, const Shape& shape, std::size_t node) {
  double least = tick.nodes[node].factor;
  for (auto up = shape.nodes[node].parent; up; up = shape.nodes[*up].parent)
    least = std::min(least, tick.nodes[*up].factor);
  return least;
}

}  // namespace

bool write_csv(RecordingReader& reader, const CsvSink& write, CsvNames names, TickRange range) {
  constexpr std::size_t kFull = 1u << 16u;
  std::vector<std::string> paths;
  for (const ShapeNode& node : reader.header().nodes) {
    paths.push_back(csv_field(names == CsvNames::Printable ? printable(node.path) : node.path));
  }
  const bool paces = std::ranges::any_of(reader.header().nodes, &ShapeNode::paces);
  std::string rows = "tick,time_s,node,path,status,progress,ticked,held,results";
  rows += paces ? ",factor\n" : "\n";
  if (range.from > 0) reader.skip_to(range.from);
  while (const auto tick = reader.next()) {
    if (tick->tick < range.from) continue;
    if (tick->tick > range.to) break;
    const std::vector<std::string> results = results_within(*tick);
    for (std::size_t index = 0; index < tick->nodes.size(); ++index) {
      const RecordedState& node = tick->nodes[index];
      if (!is_active(node)) continue;
      rows += fmt::format("{},{},{},{},{},{},{:d},{:d},{}", tick->tick, tick->time, index,
                          paths[index], to_string(node.status), node.progress, node.ticked,
                          node.held, results.empty() ? std::string() : csv_field(results[index]));
      rows += paces ? fmt::format(",{}\n", least_factor(*tick, reader.header(), index)) : "\n";
    }
    if (rows.size() < kFull) continue;
    if (!write(rows)) return false;
    rows.clear();
  }
  return write(rows);
}

}  // namespace lockstep::host
