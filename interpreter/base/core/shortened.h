// An untrusted text for a message: its first 500 bytes, and how many more there are. Does not
// allocate.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace lockstep::host {

class Shortened {
 public:
  static constexpr std::size_t kLongest = 500;  // bytes of the text

  Shortened() { text_[0] = '\0'; }
  explicit Shortened(std::string_view text);
  Shortened(const Shortened& from) : Shortened() { append(from.text()); }
  Shortened& operator=(const Shortened& from) {
    size_ = 0;
    append(from.text());
    return *this;
  }
  // A text that another process has already shortened.
  static Shortened as_it_is(std::string_view text);

  std::string_view text() const { return {text_.data(), size_}; }
  const char* c_str() const { return text_.data(); }

 private:
  void append(std::string_view part);

  std::array<char, kLongest + 80> text_;  // ends with a NUL; what is behind it has no meaning
  std::size_t size_ = 0;
};

}  // namespace lockstep::host
