#include "core/printable_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "core/utf8.h"

namespace lockstep {

std::string printable_json(std::string_view json) {
  constexpr char32_t kDelete = 0x7F;  // below it the serializer has escaped all; '\n' is its own
  std::string out;
  while (!json.empty()) {
    const auto character = json.substr(0, std::max<std::size_t>(utf8_length(json), 1));
    const char32_t code = code_point(character);
    if (code >= kDelete && is_obeyed_by_terminals(code)) {
      fmt::format_to(std::back_inserter(out), "\\u{:04x}", static_cast<unsigned>(code));
    } else {
      out += character;
    }
    json.remove_prefix(character.size());
  }
  return out;
}

}  // namespace lockstep
