// Tries an edit before it is offered: what `lockstep check` would say of the changed texts.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "author/edit/project_texts.h"
#include "author/server/features/feature.h"

namespace lockstep::host {

class Trial {
 public:
  // Both must outlive it.
  Trial(const Question& question, const ProjectTexts& texts);

  // Whether the changed texts have no error that these do not have.
  bool accepts(const ProjectEdit& edit) const;
  // An error of the changed texts, if these have none. A rename would change the errors that there
  // are.
  std::optional<std::string> error_after(const ProjectEdit& edit) const;

 private:
  std::vector<std::string> errors_after(const ProjectEdit& edit) const;

  const Question& question_;
  const ProjectTexts& texts_;
  std::vector<std::string> errors_;  // sorted
};

}  // namespace lockstep::host
