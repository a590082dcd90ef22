// Measures as users write them: their names with their arguments, and the nodes that these name.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "base/core/problem.h"
#include "judge/measure/measure.h"

namespace lockstep::host {

// The measure that `text` names.
Result<MeasureSpec> parse_measure(std::string_view text);

// As parse_measure reads it: "predictability:task@0.6=600".
std::string to_text(const MeasureSpec& spec);
// For the axis of a plot: "duration (s)".
std::string axis_label(const MeasureSpec& spec);
// The objects of a measure, for people: "each parallel".
std::string_view to_string(MeasureOf of);
// "progress-distance[[K1:K2]], …, predictability:NODE@P[=T]": all measures.
std::string measure_usages();

// The only path that is `name` or ends in "/" + `name`; `what` is what the paths belong to.
Result<std::size_t> find_path(std::span<const std::string> paths, std::string_view name,
                              std::string_view what = "node");

}  // namespace lockstep::host
