// The library brings a copy of nlohmann's JSON. Here it is that of the system.
#pragma once

#if __has_include(<nlohmann/json.hpp>)
#include <nlohmann/json.hpp>  // IWYU pragma: export
#else
#error "nlohmann's JSON is not installed: on Debian and Ubuntu, apt install nlohmann-json3-dev"
#endif
