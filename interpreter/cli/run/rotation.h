// The value of `run --record-rotate`.
#pragma once

#include <optional>
#include <string_view>

#include "record/write/recorder.h"

namespace lockstep::host {

// "500kB", "64MiB", "30s", "10min", "2h".
std::optional<Rotation> rotation_from(std::string_view text);

}  // namespace lockstep::host
