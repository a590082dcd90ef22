#include "recording/write/live_json.h"

#include <fmt/format.h>

#include <charconv>

#include "json/reader.h"
#include "recording/lines.h"

namespace lockstep::host {
namespace {

// The end of a line: ],"faults":[[3,"threw"]],"entries":[[0,"1"]]}
class TickEndJson final : public TickEndReader {
 public:
  void read(std::string text, EventCounts& counts) override {
    text.insert(0, "{\"\":[");
    reader_.read(text, [&](JsonObject line) {
      const auto faults = [&](JsonValue all) {
        all.each_item([&](JsonValue it) { take_fault(it, counts); });
      };
      const auto entries = [&](JsonValue all) {
        all.each_item([&](JsonValue it) { take_entry(it, counts); });
      };
      line.read({{lines::kTick["faults"], faults, kMayLack},
                 {lines::kTick["entries"], entries, kMayLack}});
    });
  }

 private:
  static void take_fault(JsonValue fault, EventCounts& counts) {
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

  static void take_entry(JsonValue entry, EventCounts& counts) {
    std::optional<std::size_t> index;
    entry.each_item([&](JsonValue it) {
      if (!index) {
        index = it.whole();
      } else {
        counts.take_entry(*index, it.is_null() ? std::nullopt : std::optional(it.text()));
      }
    });
  }

  JsonReader reader_;
};

}  // namespace

// The line begins as {"tick":7,…
std::optional<std::uint64_t> tick_of_json(std::string_view line) {
  constexpr std::string_view kTick = "{\"tick\":";
  static_assert(kTick.substr(2, kTick.size() - 4) == lines::kTick["tick"]);
  if (!line.starts_with(kTick)) return std::nullopt;
  std::uint64_t tick = 0;
  const auto read = std::from_chars(line.data() + kTick.size(), line.data() + line.size(), tick);
  return read.ec == std::errc() ? std::optional(tick) : std::nullopt;
}

bool is_end_json(std::string_view line) {
  constexpr std::string_view kEnd = "{\"end\"";
  static_assert(kEnd.substr(2, kEnd.size() - 3) == lines::kEndLine["end"]);
  return line.starts_with(kEnd);
}

// ,"counts":[[3,1,150,0,0,2,0],…],"written":[[0,12],…]
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

std::unique_ptr<TickEndReader> json_tick_end_reader() {
  return std::make_unique<TickEndJson>();
}

}  // namespace lockstep::host
