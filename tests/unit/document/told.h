// What diagnostics say, in short lines that a table can hold. For the tests of document/.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "base/core/diagnostics.h"

namespace lockstep::host {

// "file:line:column: message", as in a rendered diagnostic, sorted.
inline std::vector<std::string> told(Diagnostics diagnostics) {
  diagnostics.sort();
  std::vector<std::string> lines;
  for (auto diagnostic : diagnostics.all()) {
    diagnostic.hint.clear();
    diagnostic.excerpt = {};
    diagnostic.code = {};
    auto line = render(diagnostic, false);
    line.pop_back();
    const std::string_view severity = "error: ";
    if (const auto at = line.find(severity); at != std::string::npos)
      line.erase(at, severity.size());
    lines.push_back(std::move(line));
  }
  return lines;
}

inline std::vector<std::string> hints(Diagnostics diagnostics) {
  diagnostics.sort();
  std::vector<std::string> list;
  for (const auto& diagnostic : diagnostics.all()) list.push_back(diagnostic.hint);
  return list;
}

}  // namespace lockstep::host
