#include "unit/recording/random_recording.h"

#include <fmt/format.h>

#include <limits>

#include "record/json_lines.h"

namespace lockstep::host::test {
namespace {

std::size_t below(std::mt19937& random, std::size_t limit) {
  return std::uniform_int_distribution<std::size_t>(0, limit - 1)(random);
}

std::string text_of(NodeIndex node, const RecordedState& state) {
  return fmt::format("[{},\"{}\",{},{:d},{:d}]", node, to_string(state.status), state.progress,
                     state.ticked, state.held);
}

RecordedState random_state(std::mt19937& random) {
  RecordedState state;
  state.status = static_cast<Status>(below(random, 4));
  state.progress = static_cast<double>(below(random, 1001)) / 1000;
  state.ticked = below(random, 2) == 1;
  state.held = below(random, 4) == 0;
  state.limit = below(random, 5) == 0 ? std::numeric_limits<double>::infinity()
                                      : static_cast<double>(below(random, 11)) / 10;
  return state;
}

void append_line(const TimelineTick& moment, const std::vector<RecordedState>& before,
                 std::string& out) {
  if (moment.lost > 0) {
    out += fmt::format("{{\"lost\":{{\"ticks\":{},\"from\":{}}}}}\n", moment.lost,
                       moment.tick - moment.lost);
  }
  out += fmt::format("{{\"tick\":{},\"time_s\":{},\"nodes\":[", moment.tick, moment.time);
  bool first = true;
  for (std::size_t node = 0; node < before.size(); ++node) {
    if (moment.nodes[node] == before[node]) continue;
    if (!first) out += ',';
    first = false;
    out += text_of(static_cast<NodeIndex>(node), moment.nodes[node]);
  }
  std::vector<LimitChange> limits;
  for (NodeIndex node = 0; node < before.size(); ++node) {
    const double limit = moment.nodes[node].limit;
    if (limit != before[node].limit) limits.push_back({node, limit});
  }
  std::vector<Fault> faults;
  for (const RecordedFault& fault : moment.faults) faults.push_back({fault.node, fault.message});
  std::string end;
  json_lines::set_tick_end(end, {.limits = limits, .faults = faults});
  out += end;
}

}  // namespace

std::string RandomRecording::text() const {
  std::string out = json_lines::header(header);
  std::vector<RecordedState> before(header.nodes.size());
  RecordedEnd closing = end;
  for (const TimelineTick& moment : ticks) {
    append_line(moment, before, out);
    before = moment.nodes;
    closing.ticks = moment.tick + 1;
    closing.lost += moment.lost;
  }
  return out + json_lines::end(closing);
}

RandomRecording random_recording(std::mt19937& random, const RandomRecordingOptions& options) {
  RandomRecording recording;
  recording.header.id = "Main";
  recording.header.file = "a.xml";
  recording.header.version = "0.1.0";
  recording.header.rate_hz = 10;
  recording.header.clock = "virtual";
  recording.header.nodes.push_back({.path = "Main/root", .kind = "Parallel", .name = "root"});
  for (std::size_t node = 1; node < options.nodes; ++node) {
    recording.header.nodes.push_back({.path = fmt::format("Main/root/{}", node),
                                      .kind = "Advance",
                                      .name = std::to_string(node),
                                      .parent = 0});
  }
  std::uint64_t tick = 0;
  std::vector<RecordedState> nodes(options.nodes);
  for (std::size_t number = 0; number < options.ticks; ++number) {
    const std::uint64_t lost = options.gaps && below(random, 8) == 0 ? 1 + below(random, 5) : 0;
    tick += lost;
    for (RecordedState& state : nodes) {
      if (below(random, 3) == 0) state = random_state(random);
    }
    TimelineTick moment{.number = number,
                        .tick = tick,
                        .time = static_cast<double>(tick) / 10,
                        .nodes = nodes,
                        .faults = {},
                        .lost = lost};
    if (below(random, 10) == 0) {
      moment.faults.push_back(
          {static_cast<NodeIndex>(below(random, options.nodes)), fmt::format("fault {}", number)});
    }
    recording.ticks.push_back(moment);
    ++tick;
  }
  recording.end.result = "stopped";
  recording.end.reason = "max_ticks";
  return recording;
}

RecordedState other_state(std::mt19937& random, const RecordedState& state) {
  RecordedState other = state;
  switch (below(random, 5)) {
    case 0:
      other.status = static_cast<Status>((static_cast<unsigned>(state.status) + 1) % 4);
      break;
    case 1:
      other.progress = state.progress == 0 ? 1 : 0;
      break;
    case 2:
      other.ticked = !state.ticked;
      break;
    case 3:
      other.limit = state.limit == 0.5 ? 0.25 : 0.5;
      break;
    default:
      other.held = !state.held;
  }
  return other;
}

}  // namespace lockstep::host::test
