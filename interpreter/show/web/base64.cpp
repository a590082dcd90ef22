#include "show/web/base64.h"

namespace lockstep::host {

void Base64::add(std::string_view bytes) {
  text_.clear();
  if (!rest_.empty()) {
    const std::string_view missing = bytes.substr(0, 3 - rest_.size());
    rest_ += missing;
    bytes.remove_prefix(missing.size());
    if (rest_.size() < 3) return;
    add_group(rest_);
    rest_.clear();
  }
  for (; bytes.size() >= 3; bytes.remove_prefix(3)) add_group(bytes.substr(0, 3));
  rest_ = bytes;
  sink_(text_);
}

void Base64::finish() {
  text_.clear();
  if (!rest_.empty()) add_group(rest_);
  sink_(text_);
}

// One to three bytes. What is missing is filled up.
void Base64::add_group(std::string_view bytes) {
  constexpr std::string_view kLetters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  unsigned group = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    group = group << 8u | (i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0u);
  }
  for (unsigned letter = 0; letter < 4; ++letter) {
    text_ += letter > bytes.size() ? '=' : kLetters[group >> (18 - 6 * letter) & 63u];
  }
}

}  // namespace lockstep::host
