#include "author/scaffold/new_files.h"

#include <fmt/format.h>

#include <system_error>

#include "base/system/replace_text.h"

namespace lockstep::host {
namespace {

namespace fs = std::filesystem;

Result<void> make_folder(const fs::path& folder) {
  std::error_code error;
  if (!folder.empty()) fs::create_directories(folder, error);
  if (!error) return {};
  return problem(fmt::format("cannot make the folder '{}': {}", folder.string(), error.message()));
}

}  // namespace

Result<void> check_free(const NewFiles& files) {
  for (const NewFile& file : files) {
    std::error_code error;
    if (fs::symlink_status(file.path, error).type() == fs::file_type::not_found) continue;
    return problem(fmt::format("'{}' is there already", file.path.string()),
                   "nothing was written; take another name, or move it away");
  }
  return {};
}

Result<void> write_new(const NewFiles& files) {
  if (const auto free = check_free(files); !free) return free;
  for (std::size_t i = 0; i < files.size(); ++i) {
    auto done = make_folder(files[i].path.parent_path());
    if (done)
      done =
          create_text(files[i].path.string(), files[i].text, files[i].is_executable ? 0777 : 0666);
    if (done) continue;
    std::error_code ignored;
    for (std::size_t made = 0; made < i; ++made) fs::remove(files[made].path, ignored);
    return done;
  }
  return {};
}

}  // namespace lockstep::host
