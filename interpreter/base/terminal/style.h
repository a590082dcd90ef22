// The colors that the observers use, so that one meaning has the same color everywhere.
#pragma once

#include <string>
#include <string_view>

#include "base/core/style.h"

namespace lockstep::host {

// The ANSI sequence that begins a style; Plain ends every style.
constexpr std::string_view escape(Style style) {
  constexpr std::string_view kEscapes[] = {"\x1b[0m",  "\x1b[1m",  "\x1b[2m", "\x1b[32m",
                                           "\x1b[31m", "\x1b[33m", "\x1b[36m"};
  return kEscapes[static_cast<unsigned>(style)];
}

inline std::string styled(std::string_view text, Style style, bool color) {
  if (!color || style == Style::Plain) return std::string(text);
  return std::string(escape(style)).append(text).append(escape(Style::Plain));
}

}  // namespace lockstep::host
