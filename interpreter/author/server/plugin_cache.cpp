#include "author/server/plugin_cache.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>

#include "leaves/plugin/open/plugin_path.h"
#include "leaves/remote/json_lines/leaves_file.h"
#include "run/loading/plugin_directories.h"
#include "tree/check/plugin_requests.h"

namespace lockstep::host {
namespace {

// Changes when the file does.
std::string stamp_of(const std::string& path) {
  struct stat it {};
  if (path.empty() || ::stat(path.c_str(), &it) != 0) return path + ":-;";
  return fmt::format("{}:{}:{}.{}:{};", path, it.st_ino, it.st_mtim.tv_sec, it.st_mtim.tv_nsec,
                     it.st_size);
}

std::string stamp_of_program(const std::string& path) {
  return stamp_of(path) + stamp_of(leaves_file_of(path));
}

std::string stamp_of_named(const std::string& name, const std::vector<std::string>& directories) {
  if (is_plugin_file(name)) return stamp_of_program(name);
  const auto file = find_plugin_file(name, directories);
  return file ? stamp_of(*file) : stamp_of_program(program_named(name, directories));
}

// All on which the result of loading depends.
std::string stamp_of(const Project* project, const PluginOptions& options) {
  const auto directories = plugin_directories(options);
  std::string stamp;
  for (const std::string& directory : directories) stamp += directory + ';';
  for (const std::string& plugin : options.plugins) {
    stamp += plugin + '=' + stamp_of_named(plugin, directories);
  }
  if (project == nullptr) return stamp;
  Diagnostics unused;
  for (const PluginRequest& it : requested_plugins(*project, unused)) {
    stamp += fmt::format("{}|{}|{}|{}=", it.name, it.isolate, it.program, it.hold);
    const auto program = find_program_file(it.program, directories);
    stamp += it.program.empty() ? stamp_of_named(it.name, directories)
                                : stamp_of_program(program ? *program : "");
  }
  for (const Diagnostic& it : unused.all()) stamp += to_text(it.location) + it.message;
  return stamp;
}

// Messages have these places, which move with the text.
std::string places_of(const Project* project) {
  std::string places;
  Diagnostics unused;
  if (project == nullptr) return places;
  for (const PluginRequest& it : requested_plugins(*project, unused))
    places += to_text(project->sources.locate_value(it.place)) + ';';
  return places;
}

}  // namespace

const LoadedPlugins& PluginCache::get(const Project* project, const LoadOptions& options) {
  std::string stamp = stamp_of(project, options.plugins);
  std::string places = places_of(project);
  const auto known = std::ranges::find_if(kept_, [&](const Kept& it) {
    return it.stamp == stamp && (it.plugins.messages.all().empty() || it.places == places);
  });
  if (known != kept_.end()) {
    kept_.splice(kept_.begin(), kept_, known);
    return kept_.front().plugins;
  }
  kept_.push_front({std::move(stamp), std::move(places), load_plugins(project, options)});
  if (kept_.size() > kMost) kept_.pop_back();
  return kept_.front().plugins;
}

}  // namespace lockstep::host
