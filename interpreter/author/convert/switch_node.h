// A Switch: there, a node for each number of cases, from Switch2 to Switch6, with an attribute for
// each case; here, one node with a list of cases.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/core/value.h"
#include "language/document/document.h"

namespace lockstep::host {

// The attributes of one in the other language, in order; or why it cannot be said there.
struct ConvertedSwitch {
  std::vector<std::pair<std::string, std::string>> attributes = {};
  std::string difference = {};  // which case another value chooses there
  std::string problem = {}, hint = {};
  Place place = {};  // of what is the problem
};

// How many cases a node of this type has there; 0: it is no Switch.
std::uint32_t switch_cases_there(std::string_view type);
bool is_switch_attribute(std::string_view name);

// `type`: of what the cases are compared with, if it is known.
ConvertedSwitch switch_to_ours(const Document& document, std::uint32_t element, std::uint32_t cases,
                               std::optional<ValueType> type);
ConvertedSwitch switch_to_theirs(const Document& document, std::uint32_t element,
                                 std::uint32_t children, std::optional<ValueType> type);

}  // namespace lockstep::host
