#include "run/loading/load.h"

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <sstream>

#include "base/core/pre_order.h"
#include "engine/compile.h"
#include "run/loading/tree_properties.h"
#include "team/team_run.h"
#include "tree/resolve.h"

namespace lockstep::host {
namespace {

// An error in the options has no place in a file.
std::optional<LoadFailure> failure_of(const Project* project, const Diagnostics& diagnostics) {
  const bool in_file = std::ranges::any_of(diagnostics.all(), [](const Diagnostic& it) {
    return it.severity == Severity::Error && !it.location.file.empty();
  });
  if (in_file) return project == nullptr ? LoadFailure::Unreadable : LoadFailure::Invalid;
  return diagnostics.has_errors() ? std::optional(LoadFailure::Options) : std::nullopt;
}

RosPackages ros_packages(const LoadOptions& options) {
  RosPackages packages{.given = options.ros_packages, .prefixes = {}};
  if (const char* path = secure_getenv("AMENT_PREFIX_PATH")) {
    std::istringstream list(path);
    for (std::string prefix; std::getline(list, prefix, ':');) {
      if (!prefix.empty()) packages.prefixes.push_back(prefix);
    }
  }
  return packages;
}

bool has_team(const Project& project) {
  for (const auto& document : project.documents) {
    const auto elements = document->elements();
    for (const std::uint32_t child : children_in(elements, 0)) {
      if (elements[child].tag == "team") return true;
    }
  }
  return false;
}

// Several trees may share a set.
bool add_team_plugin(PluginSet& plugins, Diagnostics& diagnostics) {
  constexpr const char* kOrigin = "lockstep";
  const auto there = plugins.list();
  if (std::ranges::find(there, kOrigin, &PluginSet::Info::path) != there.end()) return true;
  return plugins.add(team_plugin(), kOrigin, diagnostics);
}

ResolveOptions resolve_options(const LoadOptions& options) {
  return {options.main_tree,     options.values,       options.later,         options.unknown,
          options.mocks,         options.mock_outputs, options.opens_entries, options.has_outside,
          options.may_lack_main, options.is_part,      options.elsewhere,     options.is_advised};
}

tl::expected<Loaded, LoadFailure> load(std::unique_ptr<Project> project, const LoadOptions& options,
                                       Diagnostics& diagnostics,
                                       std::shared_ptr<PluginSet> plugins) {
  LoadedPlugins loaded = load_plugins(project.get(), options, std::move(plugins));
  auto meaning = meaning_of(project.get(), loaded, options, diagnostics);
  if (!meaning) return tl::unexpected(meaning.error());
  return Loaded{std::move(loaded.plugins), std::move(project), std::move(meaning->definition),
                std::move(meaning->properties), options.values};
}

}  // namespace

tl::expected<Loaded, LoadFailure> load(const std::string& path, const LoadOptions& options,
                                       Diagnostics& diagnostics,
                                       std::shared_ptr<PluginSet> plugins) {
  return load(load_project(path, options.arguments, diagnostics, options.main_file,
                           ros_packages(options), options.library.get()),
              options, diagnostics, std::move(plugins));
}

tl::expected<Loaded, LoadFailure> load_text(const std::string& path, std::string text,
                                            const LoadOptions& options, Diagnostics& diagnostics,
                                            std::shared_ptr<PluginSet> plugins) {
  return load(load_project_text(path, std::move(text), options, diagnostics), options, diagnostics,
              std::move(plugins));
}

std::unique_ptr<Project> load_project_text(const std::string& path, std::string text,
                                           const LoadOptions& options, Diagnostics& diagnostics) {
  return load_project_text(path, std::move(text), options.arguments, diagnostics,
                           ros_packages(options), options.unsaved, options.library.get());
}

LoadedPlugins load_plugins(const Project* project, const LoadOptions& options,
                           std::shared_ptr<PluginSet> plugins) {
  LoadedPlugins loaded{std::move(plugins)};
  loaded.are_all = load_given_plugins(options.plugins, *loaded.plugins, loaded.messages);
  if (project == nullptr) return loaded;
  if (has_team(*project)) loaded.are_all &= add_team_plugin(*loaded.plugins, loaded.messages);
  const bool may_lack = options.unknown == MissingNodes::AreMocked;
  loaded.are_all &=
      load_requested_plugins(options.plugins, *project, *loaded.plugins, loaded.messages,
                             may_lack ? MissingPlugins::AreTold : MissingPlugins::AreErrors);
  return loaded;
}

tl::expected<Meaning, LoadFailure> meaning_of(const Project* project, const LoadedPlugins& plugins,
                                              const LoadOptions& options,
                                              Diagnostics& diagnostics) {
  const auto failed = failure_of(project, diagnostics);
  for (const Diagnostic& diagnostic : plugins.messages.all()) diagnostics.add(diagnostic);
  // Without its leaves, most of the tree would be called unknown.
  if (!plugins.are_all) return tl::unexpected(failed.value_or(LoadFailure::PluginRefused));
  std::optional<Definition> definition;
  if (project != nullptr) {
    warn_of_shadowed(*plugins.plugins, *project->rules, diagnostics);
    definition = resolve(*project, make_catalog(*plugins.plugins, *project->rules),
                         resolve_options(options), diagnostics);
  }
  if (const auto wrong = failure_of(project, diagnostics)) return tl::unexpected(*wrong);
  if (!definition) return tl::unexpected(LoadFailure::NothingToRun);
  auto properties = tree_properties(*definition, Reporter(project->sources, diagnostics));
  if (const auto wrong = failure_of(project, diagnostics)) return tl::unexpected(*wrong);
  return Meaning{std::move(definition).value(), std::move(properties)};
}

tl::expected<LoadedTrees, LoadFailure> load_trees(const std::string& path,
                                                  const std::optional<std::string>& text,
                                                  const LoadOptions& options,
                                                  Diagnostics& diagnostics,
                                                  std::shared_ptr<PluginSet> plugins) {
  auto project = text ? load_project_text(path, *text, options, diagnostics)
                      : load_project(path, options.arguments, diagnostics, options.main_file,
                                     ros_packages(options), options.library.get());
  LoadedPlugins loaded = load_plugins(project.get(), options, std::move(plugins));
  const auto failed = failure_of(project.get(), diagnostics);
  for (const Diagnostic& it : loaded.messages.all()) diagnostics.add(it);
  if (!loaded.are_all) return tl::unexpected(failed.value_or(LoadFailure::PluginRefused));
  if (failed) return tl::unexpected(*failed);
  auto trees =
      std::make_unique<TreesOfProject>(*project, make_catalog(*loaded.plugins, *project->rules),
                                       resolve_options(options), diagnostics);
  if (const auto wrong = failure_of(project.get(), diagnostics)) return tl::unexpected(*wrong);
  return LoadedTrees{std::move(loaded.plugins), std::move(project), std::move(trees)};
}

Runnable make_runnable(Loaded loaded) {
  Runnable runnable{std::move(loaded.plugins), std::move(loaded.project->arguments),
                    compile(loaded.definition), std::move(loaded.properties),
                    std::move(loaded.values)};
  loaded.definition = {};
  loaded.project.reset();
  return runnable;
}

}  // namespace lockstep::host
