#include "base/core/shortened.h"

#include <algorithm>
#include <charconv>
#include <limits>

#include "base/core/utf8.h"

namespace lockstep::host {

void Shortened::append(std::string_view part) {
  const std::string_view fits = utf8_front(part, text_.size() - 1 - size_);
  std::copy(fits.begin(), fits.end(), text_.begin() + static_cast<std::ptrdiff_t>(size_));
  size_ += fits.size();
  text_[size_] = '\0';
}

Shortened::Shortened(std::string_view text) : Shortened() {
  const std::string_view front = utf8_front(text, kLongest);
  append(front);
  if (front.size() == text.size()) return;
  std::array<char, std::numeric_limits<std::size_t>::digits10 + 1> rest{};
  const auto digits =
      std::to_chars(rest.data(), rest.data() + rest.size(), text.size() - front.size());
  append(" ... (");
  append({rest.data(), digits.ptr});
  append(" more bytes)");
}

Shortened Shortened::as_it_is(std::string_view text) {
  Shortened shortened;
  shortened.append(text);
  return shortened;
}

}  // namespace lockstep::host
