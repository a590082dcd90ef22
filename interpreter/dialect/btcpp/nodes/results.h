// The results that a tree may name for a node.
#pragma once

#include <string_view>

namespace lockstep::host::btcpp {

// In the order of Status, from Running.
inline constexpr std::string_view kResults[] = {"RUNNING", "SUCCESS", "FAILURE", "SKIPPED"};

}  // namespace lockstep::host::btcpp
