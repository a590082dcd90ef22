#include "cli/run/assumed_leaves.h"

#include <fmt/format.h>

#include "cli/console.h"
#include "language/document/file.h"
#include "verify/property_watch.h"
#include "verify/verifiable.h"

namespace lockstep::host {

bool AssumedLeaves::read(RunCommandOptions& options) {
  is_given_ = options.proved_leaves.has_value() || !options.watched_leaves.empty();
  if (!is_given_) return true;
  proved_properties_ = options.proved_properties;
  Diagnostics diagnostics;
  if (!options.proved_leaves) {
    file_ = load_leaf_file(options.watched_leaves, diagnostics);
  } else if (!options.proved_leaves->empty()) {
    file_ =
        read_leaf_file("the leaf model of " + options.ticket, *options.proved_leaves, diagnostics);
  }
  print_diagnostics(diagnostics, Severity::Warning);
  if (diagnostics.has_errors()) return false;
  if (file_ == nullptr || !file_->rate || options.proved_leaves) return true;
  if (!options.is_rate_given) options.rate = *file_->rate;
  if (options.rate == *file_->rate) return true;
  print_error(
      fmt::format(
          "--watch-leaves: the leaf model counts ticks at {} per second, and the run has {}",
          *file_->rate, options.rate),
      "leave out --rate, or write a leaf model for this rate");
  return false;
}

bool AssumedLeaves::watch(const Tree& tree, std::span<const Property> properties) {
  if (!is_given_) return true;
  Diagnostics diagnostics;
  std::vector<NodeProblem> unknown;  // nothing is assumed there
  std::vector<Property> all(properties.begin(), properties.end());
  const PropertyNames names =
      names_with_facts(tree, file_ != nullptr ? file_->facts : std::vector<FactRow>());
  for (const std::string& text : proved_properties_) {
    if (auto property = Property::parse(text, names)) all.push_back(std::move(*property));
  }
  const Observed observed = observed_by(tree, all, unknown);
  models_ = make_models(tree, file_.get(), diagnostics, unknown, observed);
  print_diagnostics(diagnostics, Severity::Warning);
  if (diagnostics.has_errors()) return false;
  watched_.emplace(tree, models_, file_ != nullptr ? &file_->sources : nullptr);
  return true;
}

}  // namespace lockstep::host
