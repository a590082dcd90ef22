#include "record/read/tick_results.h"

#include <fmt/format.h>

namespace lockstep::host {

std::vector<std::string> results_within(const RecordedTick& tick) {
  if (tick.moments.empty()) return {};
  struct Row {  // of equal results
    std::uint64_t times;
    Status result;
  };
  std::vector<std::vector<Row>> rows(tick.nodes.size());
  std::vector<NodeState> column;
  const auto add = [&](NodeIndex node, Status result, std::uint64_t times) {
    std::vector<Row>& of_node = rows[node];
    const bool is_same = !of_node.empty() && of_node.back().result == result;
    is_same ? void(of_node.back().times += times) : of_node.push_back({times, result});
  };
  tick.moments.each(column, [&](std::span<const NodeState> now, const TickMoment& it, bool) {
    for (NodeIndex node = 0; node < now.size(); ++node) {
      if (now[node].ticked() && has_ended(now[node].status())) {
        add(node, now[node].status(), it.times);
      }
    }
  });
  for (const NodeTotals& it : tick.moments.rest) {
    for (const Status result : {Status::Success, Status::Failure, Status::Skipped}) {
      if (it.of(result) > 0) add(it.node, result, it.of(result));
    }
  }
  std::vector<std::string> results(rows.size());
  for (std::size_t node = 0; node < rows.size(); ++node) {
    for (const Row& it : rows[node]) {
      if (!results[node].empty()) results[node] += ", ";
      if (it.times > 1) results[node] += fmt::format("{} times ", it.times);
      results[node] += to_string(it.result);
    }
  }
  return results;
}

}  // namespace lockstep::host
