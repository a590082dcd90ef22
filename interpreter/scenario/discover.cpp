#include "scenario/discover.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "language/document/document.h"
#include "language/document/file.h"

namespace lockstep::host {
namespace {

namespace fs = std::filesystem;

bool has_scenarios(const fs::path& file) {
  const std::string name = file.filename().string();
  if (name.ends_with(".test.xml")) return true;
  if (!name.ends_with(".xml")) return false;
  const auto text = read_file(file.string(), Document::kMaxBytes);
  return text && text->find("<scenario ") != std::string::npos;
}

// In the order of their names.
void add_folder(const fs::path& folder, std::vector<std::string>& files) {
  std::vector<fs::directory_entry> entries;
  std::error_code error;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    if (!it->path().filename().string().starts_with('.')) entries.push_back(*it);
  }
  std::ranges::sort(entries, {}, [](const auto& it) { return it.path(); });
  for (const fs::directory_entry& it : entries) {
    if (it.is_directory(error) && !it.is_symlink(error)) {
      add_folder(it.path(), files);
    } else if (it.is_regular_file(error) && has_scenarios(it.path())) {
      files.push_back(it.path().lexically_normal().string());
    }
  }
}

}  // namespace

Result<std::vector<std::string>> find_scenario_files(const std::vector<std::string>& paths) {
  std::vector<std::string> files;
  for (const std::string& path : paths) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (!fs::exists(status)) {
      return problem(fmt::format("'{}' is not there", path), "name files or folders");
    }
    if (fs::is_directory(status)) {
      add_folder(path, files);
    } else {
      files.push_back(path);
    }
  }
  std::set<std::string> seen;
  std::erase_if(files, [&](const std::string& it) { return !seen.insert(it).second; });
  return files;
}

}  // namespace lockstep::host
