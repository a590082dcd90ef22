#include "run/loading/tree_identity.h"

#include <fmt/format.h>

#include <filesystem>

#include "base/core/version.h"

namespace lockstep::host {

namespace {

namespace fs = std::filesystem;

std::string file_name(const std::string& path, const fs::path& directory, const std::string& main) {
  if (path == main) return "the main file";
  const fs::path inside = fs::absolute(path).lexically_normal().lexically_relative(directory);
  return inside.empty() ? path : inside.string();
}

}  // namespace

TreeIdentity identity_of(const Loaded& loaded,
                         const std::function<std::string(std::string_view text)>& mark) {
  const std::string& main = loaded.project->sources.all().front()->path();
  const fs::path directory = fs::absolute(main).lexically_normal().parent_path();
  TreeIdentity identity{{"the version of lockstep", kVersion},
                        {"the main tree", std::string(loaded.definition.id)}};
  const auto add = [&](std::string what, std::string value) {
    identity.emplace_back(std::move(what), std::move(value));
  };
  for (const auto& source : loaded.project->sources.all())
    add(fmt::format("the text of '{}'", file_name(source->path(), directory, main)),
        mark(source->text()));
  for (const auto& [argument, value] : values_of(loaded.project->arguments))
    add(fmt::format("the argument '{}'", argument), value);
  for (const auto& [entry, value] : loaded.values)
    add(fmt::format("the start value of '{}'", entry), value);
  for (const PluginSet::Info& plugin : loaded.plugins->list())
    add(fmt::format("the version of the plugin '{}'", plugin.name), plugin.version);
  return identity;
}

}  // namespace lockstep::host
