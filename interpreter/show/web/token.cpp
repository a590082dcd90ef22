#include "show/web/token.h"

#include <fmt/format.h>
#include <sys/random.h>

#include <array>
#include <stdexcept>

namespace lockstep::host {

std::string make_token() {
  std::array<unsigned char, 16> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
    throw std::runtime_error("the system gives no random numbers");
  }
  std::string token;
  for (const unsigned char byte : bytes) token += fmt::format("{:02x}", byte);
  return token;
}

bool is_token(std::string_view token, std::string_view text) {
  unsigned difference = token.size() == text.size() ? 0 : 1;
  for (std::size_t i = 0; i < token.size(); ++i) {
    const char letter = i < text.size() ? text[i] : '\0';
    difference |= static_cast<unsigned char>(token[i]) ^ static_cast<unsigned char>(letter);
  }
  return difference == 0;
}

}  // namespace lockstep::host
