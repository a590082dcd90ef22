// One port of a leaf's descriptor, checked and translated. Only for descriptor.cpp.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "base/core/node_type.h"
#include "base/core/problem.h"
#include "lockstep/leaf.h"

namespace lockstep::host {

inline constexpr std::uint32_t kMaxDescriptorCount = 4096;  // of leaves, and of ports of a leaf

// A letter, then letters, digits, '_': ids of leaves and names of ports.
bool is_attribute_name(std::string_view text);

// `plugin` is the name of its plugin, `others` are the ports before it. The message says what is
// wrong with "it". The words that it may be are put into `choices`, and the port refers to them.
std::optional<Problem> read_port(const lockstep_port* from, std::string_view plugin,
                                 std::span<const Parameter> others,
                                 std::vector<std::string_view>& choices, Parameter& port);

}  // namespace lockstep::host
