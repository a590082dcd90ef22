// The recordings of a run that was cut are read as one, so they have the same entries.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/core/problem.h"
#include "trace/shape.h"

namespace lockstep::host {

// An error if the newest of the files is a recording of the same tree with other entries than
// `keys`; none: all of the tree.
Result<void> check_same_entries(const std::vector<std::string>& files, const Shape& shape,
                                const std::optional<std::vector<std::string>>& keys);

}  // namespace lockstep::host
