#include "base/core/any_value.h"

namespace lockstep::host {

Value value_of_any_type(const std::string& text) {
  if (const auto whole = parse_int(text)) return *whole;
  if (const auto real = parse_double(text)) return *real;
  if (text == "true" || text == "false") return text == "true";
  return text;
}

}  // namespace lockstep::host
