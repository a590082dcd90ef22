// The words of properties: for their parser, and for editors.
#pragma once

#include <array>
#include <string_view>

namespace lockstep::host {

// The fields of a node: arm.running.
inline constexpr auto kPropertyFields = std::to_array<std::string_view>(
    {"running", "success", "failure", "idle", "skipped", "done", "ticked", "held", "progress"});
inline constexpr auto kPropertyWords = std::to_array<std::string_view>(
    {"never", "sometimes", "finally", "leads", "to", "within", "ticks", "tick", "only", "after",
     "at", "most", "until", "and", "or", "not"});

}  // namespace lockstep::host
