// Builds text where only async-signal-safe functions may be called: in fixed memory, cut at its
// end.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace lockstep::host {

class SignalText {
 public:
  SignalText& operator<<(std::string_view text) {
    const std::size_t fits = std::min(text.size(), text_.size() - size_);
    std::memcpy(text_.data() + size_, text.data(), fits);
    size_ += fits;
    return *this;
  }
  SignalText& operator<<(std::uint64_t number) { return digits(number, 10); }
  SignalText& hexadecimal(std::uint64_t number) { return (*this << "0x").digits(number, 16); }
  // "2.0", with one digit after the point.
  SignalText& tenths(double number) {
    const auto all = static_cast<std::uint64_t>(std::llround(number * 10));
    return *this << all / 10 << "." << all % 10;
  }

  std::string_view text() const { return {text_.data(), size_}; }

 private:
  SignalText& digits(std::uint64_t number, unsigned base) {
    std::array<char, 20> reversed;
    std::size_t count = 0;
    do reversed[count++] = "0123456789abcdef"[number % base];
    while ((number /= base) != 0);
    while (count > 0) *this << std::string_view(&reversed[--count], 1);
    return *this;
  }

  std::array<char, 4096> text_;
  std::size_t size_ = 0;
};

}  // namespace lockstep::host
