// What a loaded tree is made from, by names for people: another value is another tree.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "run/loading/load.h"

namespace lockstep::host {

using TreeIdentity = std::vector<std::pair<std::string, std::string>>;

// `mark` makes a value of a text. Files are named from the folder of the main file, wherever the
// command runs.
TreeIdentity identity_of(const Loaded& loaded,
                         const std::function<std::string(std::string_view text)>& mark);

}  // namespace lockstep::host
