#include "language/document/ros_packages.h"

namespace lockstep::host {

std::optional<std::filesystem::path> RosPackages::find(std::string_view name) const {
  if (const auto it = given.find(name); it != given.end()) return it->second;
  for (const std::string& prefix : prefixes) {
    auto share = std::filesystem::path(prefix) / "share" / name;
    std::error_code error;
    if (std::filesystem::is_directory(share, error)) return share;
  }
  return std::nullopt;
}

}  // namespace lockstep::host
