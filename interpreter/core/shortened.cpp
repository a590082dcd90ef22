#include "core/shortened.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/utf8.h"

namespace lockstep {

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
  std::array<char, 48> rest{};
  const auto end = fmt::format_to_n(rest.data(), rest.size(), " ... ({} more bytes)",
                                    text.size() - front.size());
  append({rest.data(), end.size});
}

Shortened Shortened::as_it_is(std::string_view text) {
  Shortened shortened;
  shortened.append(text);
  return shortened;
}

}  // namespace lockstep
