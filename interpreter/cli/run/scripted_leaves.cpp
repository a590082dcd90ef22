#include "cli/run/scripted_leaves.h"

#include <fmt/format.h>

#include "cli/console.h"
#include "document/file.h"

namespace lockstep::host {

bool GivenLeaves::read(RunCommandOptions& options) {
  constexpr std::size_t kMost = std::size_t{64} << 20u;
  auto text = read_file(options.leaves, kMost, FileKinds::RegularOrPipe);
  if (!text) {
    print_error(fmt::format("--leaves: cannot read '{}': {}", printable(options.leaves),
                            text.error().message),
                text.error().hint);
    return false;
  }
  options.load.unknown = MissingNodes::AreMocked;
  if (!is_leaf_file(*text)) return read_scripts(options, *text);
  Diagnostics diagnostics;
  file_ = read_leaf_file(options.leaves, std::move(*text), diagnostics);
  print_diagnostics(diagnostics, Severity::Warning);
  if (file_ == nullptr || diagnostics.has_errors()) return false;
  if (file_->rate && !options.is_rate_given) options.rate = *file_->rate;
  return true;
}

bool GivenLeaves::read_scripts(RunCommandOptions& options, std::string_view text) {
  auto parsed = parse_leaf_scripts(text);
  if (!parsed) {
    print_error(printable(options.leaves) + ':' + parsed.error().message, parsed.error().hint);
    return false;
  }
  scripts_ = std::move(*parsed);
  if (scripts_.rate && !options.is_rate_given) options.rate = *scripts_.rate;
  const bool is_limited = options.max_ticks || options.timeout;
  if (scripts_.ticks && !is_limited) options.max_ticks = *scripts_.ticks;
  return true;
}

bool GivenLeaves::give(const RunCommandOptions& options, const Tree& tree) {
  if (file_ != nullptr) {
    Diagnostics diagnostics;
    std::vector<NodeProblem> problems;
    models_ = make_models(tree, file_.get(), diagnostics, problems);
    print_diagnostics(diagnostics, Severity::Warning);
    for (const NodeProblem& it : problems) {
      print_error(tree.path(it.node) + ": " + it.message, it.hint);
    }
    played_.set_models(tree, models_);
    return !diagnostics.has_errors() && problems.empty();
  }
  if (const auto wrong = PlayedLeaves::check(scripts_, tree)) {
    print_error(printable(options.leaves) + ": " + wrong->message, wrong->hint);
    return false;
  }
  played_.set_scripts(std::move(scripts_));
  return true;
}

}  // namespace lockstep::host
