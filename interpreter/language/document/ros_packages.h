// Where the files of ROS packages are, for <include ros_pkg="…"/>.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lockstep::host {

struct RosPackages {
  std::map<std::string, std::string, std::less<>> given;  // --ros-package NAME=DIR
  std::vector<std::string> prefixes;                      // of AMENT_PREFIX_PATH

  // The share directory of a package; nothing if there is none.
  std::optional<std::filesystem::path> find(std::string_view name) const;
};

}  // namespace lockstep::host
