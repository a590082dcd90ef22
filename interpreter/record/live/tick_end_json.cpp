#include "record/live/tick_end_json.h"

#include <fmt/format.h>

#include <algorithm>

#include "record/lines.h"
#include "record/live/event_counts.h"

namespace lockstep::host {
namespace {

void take_moment_node(JsonValue node, EventCounts& counts) {
  std::uint64_t numbers[3] = {};  // index, ticked, held
  std::size_t field = 0;
  auto status = Status::Idle;
  node.each_item([&](JsonValue it) {
    const std::size_t place = field++;
    if (place != 1) {
      numbers[place == 0 ? 0 : std::min<std::size_t>(place - 1, 2)] = it.whole();
      return;
    }
    const std::string_view name = it.text();
    for (const StatusRow& row : kStatuses) {
      if (row.name == name) status = row.status;
    }
  });
  const auto activity = numbers[2] != 0 ? Activity::Paused : static_cast<Activity>(status);
  counts.take_moment_node(static_cast<NodeIndex>(numbers[0]),
                          NodeState::of(activity, numbers[1] != 0));
}

void take_moment(JsonValue moment, EventCounts& counts) {
  std::optional<std::uint64_t> times;
  moment.each_item([&](JsonValue it) {
    if (!times) {
      times = it.whole();
    } else {
      it.each_item([&](JsonValue node) { take_moment_node(node, counts); });
    }
  });
  counts.take_moment(times.value_or(1));
}

void take_more(JsonValue more, EventCounts& counts) {
  NodeTotals totals;
  std::size_t field = 0;
  more.each_item([&](JsonValue it) {
    const std::uint64_t number = it.whole();
    if (field == 0) totals.node = static_cast<NodeIndex>(number);
    if (field > 0 && field <= NodeTotals::kKinds) totals.counts[field - 1] = number;
    ++field;
  });
  counts.take_more(totals);
}

void take_fault(JsonValue fault, EventCounts& counts) {
  bool is_node = true;
  fault.each_item([&](JsonValue it) {
    if (is_node) {
      counts.take_fault(static_cast<NodeIndex>(it.whole()));
    } else {
      it.skip();
    }
    is_node = false;
  });
}

void take_entry(JsonValue entry, EventCounts& counts) {
  std::optional<std::size_t> index;
  entry.each_item([&](JsonValue it) {
    if (!index) {
      index = it.whole();
    } else {
      counts.take_entry(*index, it.is_null() ? std::nullopt : std::optional(it.text()));
    }
  });
}

}  // namespace

void TickEndJson::read(std::string text, EventCounts& counts) {
  text.insert(0, "{\"\":[");
  reader_.read(text, [&](JsonObject line) {
    const auto faults = [&](JsonValue all) {
      all.each_item([&](JsonValue it) { take_fault(it, counts); });
    };
    const auto entries = [&](JsonValue all) {
      all.each_item([&](JsonValue it) { take_entry(it, counts); });
    };
    const auto moments = [&](JsonValue all) {
      all.each_item([&](JsonValue it) { take_moment(it, counts); });
    };
    const auto more = [&](JsonValue all) {
      all.each_item([&](JsonValue it) { take_more(it, counts); });
    };
    line.read({{lines::kTick["moments"], moments, kMayLack},
               {lines::kTick["more"], more, kMayLack},
               {lines::kTick["faults"], faults, kMayLack},
               {lines::kTick["entries"], entries, kMayLack}});
  });
}

std::string counts_json(const EventCounts& counts, std::uint64_t tick) {
  std::string text = fmt::format(",\"{}\":[", lines::kTick["counts"]);
  const char* separator = "";
  for (std::size_t node = 0; node < counts.nodes(); ++node) {
    const EventCounts::Counts it = counts.of_node(node, tick);
    if (it == EventCounts::Counts{}) continue;
    text += fmt::format("{}[{}", separator, node);
    for (const std::uint64_t count : it) text += fmt::format(",{}", count);
    text += ']';
    separator = ",";
  }
  text += fmt::format("],\"{}\":[", lines::kTick["written"]);
  separator = "";
  for (std::size_t entry = 0; entry < counts.entries(); ++entry) {
    if (counts.of_entry(entry) == 0) continue;
    text += fmt::format("{}[{},{}]", separator, entry, counts.of_entry(entry));
    separator = ",";
  }
  return text += ']';
}

}  // namespace lockstep::host
