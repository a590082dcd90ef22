#include "author/server/uri.h"

#include <charconv>

#include "base/core/path_in_uri.h"

namespace lockstep::host {

std::string path_of_uri(std::string_view uri) {
  constexpr std::string_view kFile = "file://";
  if (!uri.starts_with(kFile)) return std::string(uri);
  const auto slash = uri.find('/', kFile.size());  // the name of a host may stand before it
  if (slash == uri.npos) return std::string(uri);
  uri.remove_prefix(slash);
  std::string path;
  while (!uri.empty()) {
    unsigned char byte = 0;
    const std::string_view digits = uri.substr(1, 2);
    const auto [end, failure] =
        std::from_chars(digits.data(), digits.data() + digits.size(), byte, 16);
    const bool is_coded = uri.front() == '%' && digits.size() == 2 && failure == std::errc() &&
                          end == digits.data() + 2;
    path += is_coded ? static_cast<char>(byte) : uri.front();
    uri.remove_prefix(is_coded ? 3 : 1);
  }
  return path;
}

std::string uri_of_path(std::string_view path) {
  if (!path.starts_with('/')) return std::string(path);
  return "file://" + path_in_uri(path);
}

}  // namespace lockstep::host
