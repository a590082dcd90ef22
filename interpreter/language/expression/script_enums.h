// Words that stand for numbers in scripts.
#pragma once

#include <functional>
#include <map>
#include <string>

namespace lockstep::host {

using ScriptEnums = std::map<std::string, double, std::less<>>;

}  // namespace lockstep::host
