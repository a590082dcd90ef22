// What a script reads of the run itself, as it was at the start of the tick: progress(arm),
// held(arm), status(arm), owner(dock). All scripts of a tick see the same, whatever was ticked
// before them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/core/status.h"
#include "base/core/value.h"

namespace lockstep::host {

struct Reading {
  enum class What : std::uint8_t { Progress, Held, Status, Owner };

  What what;
  std::string of;      // a node's path or the end of one; of Owner: a resource, or pool/resource
  std::size_t offset;  // of that, in the text of the script
};

// The same in a tree: the node or the resource that it means.
struct BoundReading {
  std::uint32_t node;  // of Owner: that of the pool
  Reading::What what;
  std::uint32_t resource = 0;  // of Owner: its number in the pool

  friend auto operator<=>(const BoundReading&, const BoundReading&) = default;
};

struct ReadingRow {
  Reading::What what;
  std::string_view name;
  ValueType type;
  std::string_view doc;
};
inline constexpr std::array kReadings = {
    ReadingRow{Reading::What::Progress, "progress", ValueType::Double,
               "the progress of a node, in [0, 1]: 0 while it is idle, 1 after it succeeded"},
    ReadingRow{Reading::What::Held, "held", ValueType::Bool,
               "whether a synchronized node or a pool withholds the ticks of a node"},
    ReadingRow{Reading::What::Status, "status", ValueType::String,
               "idle, running, success, failure or skipped"},
    ReadingRow{Reading::What::Owner, "owner", ValueType::String,
               "the path of the UseResources that owns a resource, or none"},
};
inline constexpr std::string_view kNoOwner = "none";

constexpr const ReadingRow& row_of(Reading::What what) {
  return kReadings[static_cast<std::size_t>(what)];
}

// "progress(arm)"
inline std::string shown(const Reading& reading) {
  return std::string(row_of(reading.what).name) + "(" + reading.of + ")";
}

}  // namespace lockstep::host
