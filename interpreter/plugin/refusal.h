// Why a plugin is not accepted, and what its user or author can do. Only within plugin/.
#pragma once

#include <string>

namespace lockstep {

struct Refusal {
  std::string message;  // continues "plugin 'x.so' "
  std::string hint;
};

}  // namespace lockstep
