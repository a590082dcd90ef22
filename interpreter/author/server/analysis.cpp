#include "author/server/analysis.h"

#include <algorithm>
#include <utility>

#include "leaves/leaf_file.h"
#include "run/loading/project_file.h"
#include "scenario/scenario_reader.h"
#include "tree/check/plugin_requests.h"
#include "verify/check/advice.h"

namespace lockstep::host {
namespace {

// In place of those that no plugin was asked for.
void note_left_out(const Project& project, Diagnostics& diagnostics, Analysis& result) {
  Diagnostics unused;
  for (const PluginRequest& request : requested_plugins(project, unused)) {
    result.left_plugins_out = true;
    diagnostics.note("plugin-not-loaded"_code, project.sources.locate_value(request.place),
                     "the plugin is not loaded: the workspace is not trusted",
                     "its nodes are not checked until you trust the workspace in your editor");
  }
}

// That no plugin has a node is known of all of them. That it is near to one of the language may
// help.
Diagnostics without_missing_nodes(const Diagnostics& diagnostics) {
  Diagnostics rest;
  for (const Diagnostic& it : diagnostics.all()) {
    const bool is_about_plugins = it.code.text() == "mocked-node";
    if (!is_about_plugins || it.hint.starts_with("did you mean ")) rest.add(it);
  }
  return rest;
}

// The root of a text that is not readable, its includes, arguments and plugins, as far as they are
// written.
std::string declarations_of(std::string_view text) {
  constexpr std::string_view kDeclarations[] = {"arg", "include", "plugin"};
  const TolerantTree tree = read_tolerantly(text);
  std::string declarations;
  for (const TolerantElement& it : tree.elements) {
    const bool is_root = it.parent == TolerantElement::kNone && it.tag == "root";
    const bool is_declaration = it.parent == 0 && it.is_tag_closed &&
                                std::ranges::count(kDeclarations, it.tag) > 0 &&
                                text[it.tag_end - 2] == '/';
    if (is_root && !it.is_tag_closed) return {};
    if (is_root || is_declaration) declarations += text.substr(it.begin, it.tag_end - it.begin);
  }
  return declarations.empty() ? declarations : declarations + "</root>";
}

// Some editors ask about each XML file, as package.xml. In one of another program nothing is wrong.
bool is_of_another_program(std::string_view text) {
  const TolerantTree tree = read_tolerantly(text);
  const bool is_written = !tree.elements.empty() && tree.elements[0].is_tag_closed;
  return is_written && tree.elements[0].tag != "root" &&
         text.find("lockstep=") == std::string_view::npos &&
         text.find("BehaviorTree") == std::string_view::npos;
}

class TreeAnalysis {
 public:
  TreeAnalysis(const AnalysisJob& job, PluginCache& cache, Diagnostics& diagnostics,
               Analysis& result)
      : job_(job),
        cache_(cache),
        diagnostics_(diagnostics),
        result_(result),
        options_(
            with_project_file(job.path, load_options(*job.settings, job.unsaved), diagnostics)) {}

  void run() {
    const std::shared_ptr<Project> project =
        load_project_text(job_.path, *job_.text, options_, diagnostics_);
    if (!job_.settings->trusted && project) note_left_out(*project, diagnostics_, result_);
    const LoadedPlugins loaded = plugins_of(project.get());
    auto meaning = meaning_of(project.get(), loaded, options_, diagnostics_);
    if (!job_.settings->trusted) diagnostics_ = without_missing_nodes(diagnostics_);
    project ? keep(project, loaded) : keep_declarations();
    if (!meaning) return;
    result_.is_whole = false;
    result_.meaning = std::make_shared<const Meaning>(std::move(*meaning));
  }

 private:
  LoadedPlugins plugins_of(const Project* project) {
    if (!job_.settings->trusted) return {std::make_shared<PluginSet>()};
    return cache_.get(project, options_);
  }

  void keep(std::shared_ptr<const Project> project, const LoadedPlugins& loaded) {
    result_.plugins = loaded.plugins;
    result_.catalog = make_catalog(*loaded.plugins, *project->rules);
    result_.texts.assign(project->sources.all().begin(), project->sources.all().end());
    for (std::size_t i = 1; i < result_.texts.size(); ++i)
      result_.included.push_back(read_tolerantly(result_.texts[i]->text()));
    result_.project = std::move(project);
  }

  void keep_declarations() {
    std::string text = declarations_of(*job_.text);
    if (text.empty()) text = "<root lockstep=\"1\"/>";
    Diagnostics unused;
    const std::shared_ptr<const Project> project =
        load_project_text(job_.path, std::move(text), options_, unused);
    if (project == nullptr) return;
    keep(project, plugins_of(project.get()));
    result_.texts.front() = std::make_shared<const Source>(job_.path, *job_.text);
  }

  const AnalysisJob& job_;
  PluginCache& cache_;
  Diagnostics& diagnostics_;
  Analysis& result_;
  const LoadOptions options_;
};

}  // namespace

FileKind kind_of_file(std::string_view path) {
  if (path.ends_with(".test.xml")) return FileKind::Scenarios;
  return path.ends_with(".leaves.xml") ? FileKind::Leaves : FileKind::Tree;
}

LoadOptions load_options(const Settings& settings, UnsavedTexts unsaved) {
  LoadOptions options;
  options.plugins = settings.plugins;
  options.arguments = settings.arguments;
  options.plugins.only_described = true;
  options.unsaved = std::move(unsaved);
  options.may_lack_main = true;
  options.unknown = settings.trusted ? MissingNodes::AreNoted : MissingNodes::AreMocked;
  return options;
}

Analysis analyze(const AnalysisJob& job, PluginCache& cache) {
  Analysis result;
  result.uri = job.uri;
  result.version = job.version;
  result.serial = job.serial;
  Diagnostics diagnostics;
  switch (kind_of_file(job.path)) {
    case FileKind::Tree:
      TreeAnalysis(job, cache, diagnostics, result).run();
      if (is_of_another_program(*job.text)) diagnostics = {};
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
  if (result.plugins == nullptr) {
    result.plugins = std::make_shared<PluginSet>();
    result.catalog = make_catalog(*result.plugins);
  }
  diagnostics.sort();
  result.diagnostics = diagnostics.all();
  return result;
}

void complete(Analysis& analysis, std::function<int()> stop_signal) {
  Diagnostics diagnostics;
  for (Diagnostic& it : analysis.diagnostics) diagnostics.add(std::move(it));
  add_advice(*analysis.project, analysis.meaning->definition, AdviceEffort::Certain, diagnostics,
             std::move(stop_signal));
  diagnostics.sort();
  analysis.diagnostics = diagnostics.all();
  analysis.is_whole = true;
}

}  // namespace lockstep::host
