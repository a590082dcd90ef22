#include "record/recording.h"

#include <fmt/format.h>

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

std::string shown_value(const RecordedEntry& entry) {
  return entry.value.value_or("(too long to be recorded)");
}

}  // namespace lockstep::host
