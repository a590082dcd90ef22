// Checks the attributes of the two elements that only affect loading, <arg> and <include>.
#pragma once

#include <span>
#include <string_view>

#include "language/document/document.h"
#include "language/document/reporter.h"

namespace lockstep::host {

// Reports attributes of `element` that are not in `known`, required ones that are missing (the
// first `required` of `known`), and elements inside it. False when a required one is missing.
bool check_vocabulary(const Document& document, std::uint32_t element,
                      std::span<const std::string_view> known, std::size_t required,
                      const Reporter& report);

}  // namespace lockstep::host
