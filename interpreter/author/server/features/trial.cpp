#include "author/server/features/trial.h"

#include <algorithm>

#include "run/loading/project_file.h"

namespace lockstep::host {

Trial::Trial(const Question& question, const ProjectTexts& texts)
    : question_(question), texts_(texts) {
  // A tree that has a meaning has no errors.
  if (question.file.analysis->meaning == nullptr) errors_ = errors_after(ProjectEdit(texts.size()));
}

bool Trial::accepts(const ProjectEdit& edit) const {
  return std::ranges::includes(errors_, errors_after(edit));
}

std::optional<std::string> Trial::error_after(const ProjectEdit& edit) const {
  if (question_.file.analysis->meaning == nullptr) return std::nullopt;
  const std::vector<std::string> errors = errors_after(edit);
  return errors.empty() ? std::nullopt : std::optional(errors.front());
}

std::vector<std::string> Trial::errors_after(const ProjectEdit& edit) const {
  Diagnostics of_project_file;  // which the edit does not change
  LoadOptions options = with_project_file(
      question_.file.path, load_options(question_.settings, question_.workspace.texts()),
      of_project_file);
  options.is_advised = false;  // only errors count, and an editor waits for many trials
  const auto changed = [&](std::uint32_t document) {
    return edit[document].apply(texts_.document(document).source()->text());
  };
  for (std::uint32_t i = 1; i < texts_.size(); ++i) {
    if (edit[i].empty()) continue;
    options.unsaved[file_identity(texts_.document(i).source()->path())] =
        std::make_shared<const std::string>(changed(i));
  }
  Diagnostics diagnostics;
  const auto project = load_project_text(question_.file.path, changed(0), options, diagnostics);
  // A plugin that cannot be loaded is no news.
  const LoadedPlugins plugins{question_.file.analysis->plugins};
  static_cast<void>(meaning_of(project.get(), plugins, options, diagnostics));
  std::vector<std::string> errors;
  for (const Diagnostic& it : diagnostics.all())
    if (it.severity == Severity::Error) errors.push_back(it.message);
  std::ranges::sort(errors);
  return errors;
}

}  // namespace lockstep::host
