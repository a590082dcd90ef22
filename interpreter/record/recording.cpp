#include "record/recording.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/core/wording.h"

namespace lockstep::host {

std::string kind_text(const ShapeNode& node) {
  if (!node.resources.empty()) {
    return fmt::format("{} resources={}", node.kind, joined(node.resources, ";"));
  }
  if (node.synchronization == Synchronization::Absolute) {
    if (!node.barriers) return node.kind + " barriers from an entry";
    return fmt::format("{} barriers={}", node.kind, joined(*node.barriers, ";"));
  }
  if (node.synchronization == Synchronization::Relative) {
    if (!node.delta) return node.kind + " delta from an entry";
    return fmt::format("{} delta={}", node.kind, *node.delta);
  }
  return node.kind;
}

Nanoseconds period_of(const RecordingHeader& header) {
  return header.rate_hz > 0 ? from_seconds(1 / header.rate_hz) : Nanoseconds(0);
}

void take_heard(std::span<const RecordedHeard> words, Nanoseconds time, std::vector<Heard>& heard) {
  for (const RecordedHeard& word : words) {
    auto it = std::ranges::find(heard, word.node, &Heard::node);
    if (word.word == 0) {
      if (it != heard.end()) heard.erase(it);
      continue;
    }
    if (it == heard.end()) it = heard.insert(it, {.node = word.node});
    if (it->run == word.run && it->word == word.word) continue;
    *it = {.node = word.node, .run = word.run, .word = word.word, .time = time};
  }
}

std::string shown_value(const RecordedEntry& entry) {
  return entry.value.value_or("(too long to be recorded)");
}

}  // namespace lockstep::host
