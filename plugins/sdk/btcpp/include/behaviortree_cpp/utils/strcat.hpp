// Texts joined.
#pragma once

#include <string>
#include <string_view>

namespace BT {

template <class... Texts>
std::string StrCat(const Texts&... texts) {
  std::string joined;
  (joined.append(std::string_view(texts)), ...);
  return joined;
}

}  // namespace BT
