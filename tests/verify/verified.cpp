#include "verify/verified.h"

#include <algorithm>
#include <stdexcept>

namespace lockstep::host::test {
namespace {

LeafModels models_of(const Tree& tree, std::string_view rows) {
  Diagnostics diagnostics;
  std::vector<NodeProblem> problems;
  const std::string text = "<leaves lockstep=\"1\">" + std::string(rows) + "</leaves>";
  const auto file = read_leaf_file("t.leaves.xml", text, diagnostics);
  LeafModels models = make_models(tree, file.get(), diagnostics, problems);
  if (diagnostics.has_errors()) throw std::invalid_argument(diagnostics.all()[0].message);
  if (!problems.empty()) throw std::invalid_argument(problems[0].message);
  return models;
}

}  // namespace

Verified::Verified(std::string_view text, std::string_view rows, const SearchLimits& limits,
                   double of_rate)
    : tree(tree_from_text(text)),
      models(models_of(tree, rows)),
      rate(of_rate),
      found(search(tree, models, {}, from_seconds(1 / rate), limits)),
      verdict(make_verdict(tree, models, {}, found, {.rate = rate})) {}

const Finding* Verified::finding(std::string_view name) const {
  const auto it = std::ranges::find(verdict.findings, name, &Finding::name);
  return it == verdict.findings.end() ? nullptr : &*it;
}

std::string Verified::said(std::string_view name) const {
  const auto it = std::ranges::find(verdict.facts, name, &VerdictLine::name);
  return it == verdict.facts.end() ? "" : it->text;
}

std::string Verified::findings() const {
  std::string names;
  for (const Finding& it : verdict.findings) names += (names.empty() ? "" : ", ") + it.name;
  return names;
}

std::string Verified::script(std::string_view name) const {
  Tracer tracer(tree, models, {}, from_seconds(1 / rate), found);
  LeafScripts scripts = tracer.scripts(finding(name)->run);
  scripts.ticks.reset();
  return to_text(scripts);
}

}  // namespace lockstep::host::test
