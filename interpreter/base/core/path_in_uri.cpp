#include "base/core/path_in_uri.h"

#include <fmt/format.h>

#include <cctype>

namespace lockstep::host {

std::string path_in_uri(std::string_view path) {
  constexpr std::string_view kPlain = "/-._~";
  std::string text;
  for (const char c : path) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain = (byte < 0x80 && std::isalnum(byte) != 0) || kPlain.find(c) != kPlain.npos;
    text += plain ? std::string(1, c) : fmt::format("%{:02X}", byte);
  }
  return text;
}

}  // namespace lockstep::host
