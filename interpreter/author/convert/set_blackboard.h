// SetBlackboard there is a Script here: an entry gets a literal or the value of another entry.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "base/core/value.h"
#include "language/document/document.h"

namespace lockstep::host {

// The script, or why it cannot be said here.
struct ConvertedSetter {
  std::string code = {};
  bool is_text = true;  // it assigns a text, or an entry
  bool is_entry = false;
  std::string problem = {}, hint = {};
  Place place = {};  // of what is the problem
};

// `type`: of the entry, if it is known.
ConvertedSetter setter_to_ours(const Document& document, std::uint32_t element,
                               std::optional<ValueType> type);

}  // namespace lockstep::host
