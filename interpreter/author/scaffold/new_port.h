// A port, as `--port` asks for it.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/core/problem.h"
#include "base/core/value.h"

namespace lockstep::host {

enum class PortDirection { Input, Output, InOut };

struct NewPort {
  PortDirection direction = PortDirection::Input;
  std::string name;
  ValueType type = ValueType::String;
  std::optional<std::string> default_text = {};  // as a tree would write it
};

// "goal:string", "speed:double=0.5", "out:angle:double", "inout:tries:int=0", "path:list of
// double".
Result<NewPort> parse_port(std::string_view text);

}  // namespace lockstep::host
