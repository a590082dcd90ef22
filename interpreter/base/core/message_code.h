// The kind of a message, for programs: stable, while the text may change. message_kinds.h has all.
#pragma once

#include <cstddef>
#include <string_view>

namespace lockstep::host {

// Made by "unknown-node"_code. tests/unit compares the codes in the sources with the table.
class MessageCode {
 public:
  constexpr MessageCode() = default;

  constexpr std::string_view text() const { return text_; }
  constexpr bool empty() const { return text_.empty(); }

 private:
  constexpr explicit MessageCode(std::string_view text) : text_(text) {}
  friend consteval MessageCode operator""_code(const char* text, std::size_t size);

  std::string_view text_;  // of a literal
};

consteval MessageCode operator""_code(const char* text, std::size_t size) {
  return MessageCode({text, size});
}

}  // namespace lockstep::host
