#include "cli/load/tree_identity.h"

#include <fmt/format.h>

#include "base/core/version.h"

namespace lockstep::host {

TreeIdentity identity_of(const Loaded& loaded,
                         const std::function<std::string(std::string_view text)>& mark,
                         const std::function<std::string(const std::string& path)>& name) {
  TreeIdentity identity{{"the version of lockstep", kVersion},
                        {"the main tree", std::string(loaded.definition.id)}};
  const auto add = [&](std::string what, std::string value) {
    identity.emplace_back(std::move(what), std::move(value));
  };
  for (const auto& source : loaded.project->sources.all())
    add(fmt::format("the text of '{}'", name(source->path())), mark(source->text()));
  for (const auto& [argument, value] : values_of(loaded.project->arguments))
    add(fmt::format("the argument '{}'", argument), value);
  for (const auto& [entry, value] : loaded.values)
    add(fmt::format("the start value of '{}'", entry), value);
  for (const PluginSet::Info& plugin : loaded.plugins->list())
    add(fmt::format("the version of the plugin '{}'", plugin.name), plugin.version);
  return identity;
}

}  // namespace lockstep::host
