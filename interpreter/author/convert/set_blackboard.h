// SetBlackboard there is a Script here: an entry gets a literal or the value of another entry.
#pragma once

#include <cstdint>
#include <string>

#include "language/document/document.h"

namespace lockstep::host {

// The script, or why it cannot be said here.
struct ConvertedSetter {
  std::string code = {};
  std::string problem = {}, hint = {};
  Place place = {};  // of what is the problem
};

ConvertedSetter setter_to_ours(const Document& document, std::uint32_t element);

}  // namespace lockstep::host
