#include "cli/outputs.h"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>

#include "base/system/output_file.h"
#include "cli/console.h"
#include "leaves/remote/json_lines/leaves_file.h"
#include "run/loading/project_file.h"

namespace lockstep::host {
namespace {

std::string path_of(int descriptor) {
  return fmt::format("/proc/self/fd/{}", descriptor);
}

}  // namespace

NamedFile named_file(const std::string& path) {
  return path == "-" ? NamedFile{"stdin", path_of(STDIN_FILENO)} : NamedFile{path, path};
}

std::vector<NamedFile> inputs_of(std::span<const std::string> documents, const PluginSet& plugins) {
  std::vector<NamedFile> inputs;
  for (const std::string& path : documents) inputs.push_back(named_file(path));
  for (const auto& plugin : plugins.list()) {
    inputs.push_back(named_file(plugin.path));
    inputs.push_back(named_file(leaves_file_of(plugin.path)));
  }
  return inputs;
}

std::vector<NamedFile> inputs_of(const Loaded& loaded, std::vector<std::string> others) {
  std::erase(others, "");
  for (const auto& source : loaded.project->sources.all()) others.push_back(source->path());
  return inputs_of(others, *loaded.plugins);
}

std::vector<NamedFile> standard_outputs() {
  return {{"stdout", path_of(results_file())}, {"stderr", path_of(STDERR_FILENO)}};
}

bool would_overwrite(std::string_view option, const std::string& output,
                     std::span<const NamedFile> used) {
  std::error_code none;
  const std::filesystem::path path(output);
  if (std::filesystem::is_character_file(path, none)) return false;
  if (path.filename() == kProjectFile && std::filesystem::exists(path, none)) {
    print_error(fmt::format("{} {}: it is a project file", option, printable(output)),
                "name another file");
    return true;
  }
  for (const NamedFile& file : used) {
    if (!is_same_file(output, file.path)) continue;
    print_error(fmt::format("{} {}: it is the same file as {}", option, printable(output),
                            printable(file.name)),
                "name another file");
    return true;
  }
  return false;
}

}  // namespace lockstep::host
