// The measures that a user can ask for by name, the same for a study and for a recording:
// progress-distance, step-length, duration, predictability:NODE@P[=T]. Only the names: the numbers
// come from synchronized_measure.h and predictability.h.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace lockstep {

enum class MeasureKind : std::uint8_t {
  ProgressDistance,  // of a synchronized node: the sum over its ticks
  StepLength,        // of a synchronized node
  Duration,          // of the run: seconds, a period for each tick
  Predictability,    // of any node: ticks
};

struct MeasureSpec {
  MeasureKind kind = MeasureKind::ProgressDistance;
  std::string node;                // Predictability: a path, or the end of one
  double progress = 0;             // Predictability: in [0, 1]
  std::optional<double> expected;  // Predictability: the tick, from 0. None: the instant is told

  friend bool operator==(const MeasureSpec&, const MeasureSpec&) = default;
};

// The measure that `text` names. Else nothing, and what is wrong with it in `error`.
std::optional<MeasureSpec> parse_measure(std::string_view text, std::string& error);

// As parse_measure reads it: "predictability:task@0.6=600".
std::string to_text(const MeasureSpec& measure);
// For the axis of a plot: "duration (s)".
std::string_view axis_label(MeasureKind kind);

// The only path that is `node` or ends in "/" + `node`. Else nothing, and why in `error`.
std::optional<std::size_t> find_path(std::span<const std::string> paths, std::string_view node,
                                     std::string& error);
// "arm" of "Main/pull/arm".
std::string last_segment(std::string_view path);

}  // namespace lockstep
