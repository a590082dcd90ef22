// Files that a command reads together have the messages of those that they share: each is told
// once.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <tuple>

#include "base/core/diagnostics.h"

namespace lockstep::host {

class Told {
 public:
  Diagnostics only_new(const Diagnostics& diagnostics) {
    Diagnostics fresh;
    for (const Diagnostic& it : diagnostics.all()) {
      const SourceLocation& at = it.location;
      if (told_.emplace(at.file, at.line, at.column, it.message).second) fresh.add(it);
    }
    return fresh;
  }

 private:
  std::set<std::tuple<std::string, std::uint32_t, std::uint32_t, std::string>> told_;
};

}  // namespace lockstep::host
