#include "cli/installed.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "run/loading/plugin_directories.h"

namespace lockstep::host {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kParts = "parts";  // trees that others include

// The packages of Debian have the documents in a package of their own.
fs::path find_folder(std::string_view name) {
  const fs::path program = program_directory({});
  if (program.empty()) return {};
  std::error_code none;
  std::array folders{fs::path(LOCKSTEP_SHARE_FROM_BIN), fs::path(LOCKSTEP_MARKDOWN_FROM_BIN)};
  if (fs::exists(program / "CMakeCache.txt", none)) folders = {"../..", "../.."};
  for (const fs::path& folder : folders) {
    const fs::path found = (program / folder / name).lexically_normal();
    if (fs::is_directory(found, none)) return found;
  }
  return {};
}

}  // namespace

fs::path documents_directory() {
  return find_folder("docs");
}

fs::path examples_directory() {
  return find_folder("trees");
}

std::vector<std::string> example_names() {
  std::vector<std::string> names;
  const fs::path directory = examples_directory();
  std::error_code error;
  if (directory.empty()) return names;
  for (const auto& entry : fs::recursive_directory_iterator(directory, error)) {
    const fs::path path = entry.path().lexically_relative(directory);
    const bool is_tree = path.extension() == ".xml" && !path.stem().has_extension();
    if (is_tree && path.parent_path() != kParts) names.push_back(path.parent_path() / path.stem());
  }
  std::ranges::sort(names);
  return names;
}

fs::path example_file(const std::string& name) {
  return examples_directory() / (name + ".xml");
}

}  // namespace lockstep::host
