// How a view draws something, by what it means; base/terminal/style.h has the colors.
#pragma once

#include <cstdint>

namespace lockstep::host {

enum class Style : std::uint8_t { Plain, Strong, Dim, Good, Bad, Warning, Active };

}  // namespace lockstep::host
