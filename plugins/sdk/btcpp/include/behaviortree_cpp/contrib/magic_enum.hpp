// The library brings a copy of magic_enum. Here it is that of the system.
#pragma once

#if __has_include(<magic_enum/magic_enum.hpp>)
#include <magic_enum/magic_enum.hpp>  // IWYU pragma: export
#elif __has_include(<magic_enum.hpp>)
#include <magic_enum.hpp>  // IWYU pragma: export
#else
#error "magic_enum is not installed: get it from https://github.com/Neargye/magic_enum"
#endif
