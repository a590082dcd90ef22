#include "authoring/server/analysis.h"

#include <algorithm>

#include "authoring/check/certainties.h"
#include "definition/check/plugin_requests.h"
#include "leaves/leaf_file.h"
#include "scenario/scenario_reader.h"

namespace lockstep::host {
namespace {

LoadOptions options_of(const AnalysisJob& job) {
  LoadOptions options;
  options.plugins = job.settings->plugins;
  options.arguments = job.settings->arguments;
  options.plugins.only_described = true;
  options.unsaved = job.unsaved;
  options.unknown = job.settings->trusted ? MissingNodes::AreNoted : MissingNodes::AreMocked;
  return options;
}

// In place of those that no plugin was asked for.
void note_left_out(const Project& project, Diagnostics& diagnostics, Analysis& result) {
  Diagnostics unused;
  for (const PluginRequest& request : requested_plugins(project, unused)) {
    result.left_plugins_out = true;
    diagnostics.note(project.sources.locate_value(request.place),
                     "the plugin is not loaded: the workspace is not trusted",
                     "its nodes are not checked until you trust the workspace in your editor");
  }
}

void analyze_tree(const AnalysisJob& job, PluginCache& cache, Diagnostics& diagnostics,
                  Analysis& result) {
  const LoadOptions options = options_of(job);
  const std::shared_ptr<Project> project =
      load_project_text(job.path, *job.text, options, diagnostics);
  LoadedPlugins none{std::make_shared<PluginSet>()};
  const LoadedPlugins& loaded = job.settings->trusted ? cache.get(project.get(), options) : none;
  if (!job.settings->trusted && project) note_left_out(*project, diagnostics, result);
  const LanguageRules& rules = project ? *project->rules : kLockstepRules;
  result.project = project;
  result.plugins = loaded.plugins;
  result.catalog = make_catalog(*loaded.plugins, rules);
  auto meaning = meaning_of(project.get(), loaded, options, diagnostics);
  if (project) {
    result.texts.assign(project->sources.all().begin(), project->sources.all().end());
  }
  if (!meaning) return;
  add_certainties(*project, meaning->definition, diagnostics);
  result.meaning = std::make_shared<const Meaning>(std::move(*meaning));
}

}  // namespace

FileKind kind_of_file(std::string_view path) {
  if (path.ends_with(".test.xml")) return FileKind::Scenarios;
  return path.ends_with(".leaves.xml") ? FileKind::Leaves : FileKind::Tree;
}

Analysis analyze(const AnalysisJob& job, PluginCache& cache) {
  Analysis result;
  result.uri = job.uri;
  result.version = job.version;
  Diagnostics diagnostics;
  switch (kind_of_file(job.path)) {
    case FileKind::Tree:
      analyze_tree(job, cache, diagnostics, result);
      break;
    case FileKind::Scenarios:
      read_scenarios(job.path, *job.text, diagnostics);
      break;
    case FileKind::Leaves:
      read_leaf_file(job.path, *job.text, diagnostics);
      break;
  }
  if (result.texts.empty()) {
    result.texts.push_back(std::make_shared<const Source>(job.path, *job.text));
  }
  diagnostics.sort();
  result.diagnostics = diagnostics.all();
  return result;
}

}  // namespace lockstep::host
