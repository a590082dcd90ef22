// The table of failure modes and effects as `lockstep verify --fmea` prints it.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "verify/failure_table.h"

namespace lockstep::host {

struct FmeaReport {
  const Tree& tree;
  std::span<const Property> properties;
  std::span<const FailureRow> rows;
  double rate;
};

// `format`: md (or text, which is the same), csv or json.
std::string to_text(const FmeaReport& report, std::string_view format);

}  // namespace lockstep::host
