#include "verify/verified.h"

#include <algorithm>
#include <stdexcept>

#include "verify/property_watch.h"
#include "verify/verifiable.h"

namespace lockstep::host::test {
namespace {

std::unique_ptr<LeafFile> file_of(std::string_view rows, Diagnostics& diagnostics) {
  const std::string text = "<leaves lockstep=\"1\">" + std::string(rows) + "</leaves>";
  return read_leaf_file("t.leaves.xml", text, diagnostics);
}

std::vector<Property> properties_of(const Tree& tree, std::string_view rows,
                                    const std::vector<std::string>& texts) {
  Diagnostics diagnostics;
  const auto file = file_of(rows, diagnostics);
  const auto facts = file == nullptr ? std::vector<FactRow>() : file->facts;
  std::vector<Property> properties;
  for (const std::string& text : texts) {
    auto property = Property::parse(text, names_with_facts(tree, facts));
    if (!property) throw std::invalid_argument(property.error().message);
    properties.push_back(std::move(*property));
  }
  return properties;
}

LeafModels models_of(const Tree& tree, std::string_view rows,
                     const std::vector<Property>& properties, const ProcessCuts& cuts) {
  Diagnostics diagnostics;
  std::vector<NodeProblem> problems;
  const auto file = file_of(rows, diagnostics);
  LeafModels models =
      make_models(tree, file.get(), diagnostics, problems, observed_by(tree, properties, problems));
  if (diagnostics.has_errors()) throw std::invalid_argument(diagnostics.all()[0].message);
  if (!problems.empty()) throw std::invalid_argument(problems[0].message);
  allow_cuts(cuts, tree, models);
  return models;
}

}  // namespace

Verified::Verified(std::string_view text, std::string_view rows, const SearchLimits& limits,
                   double of_rate, std::vector<std::string> texts, const LanguageRules& rules,
                   const ProcessCuts& cuts)
    : tree(tree_from_text(text, rules)),
      properties(properties_of(tree, rows, texts)),
      models(models_of(tree, rows, properties, cuts)),
      rate(of_rate),
      found(search(tree, models, properties, rate, limits)),
      verdict(make_verdict(tree, models, properties, found, {.rate = rate})) {}

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
  Tracer tracer(tree, models, properties, rate, found);
  LeafScripts scripts = tracer.scripts(finding(name)->run);
  scripts.ticks.reset();
  return to_text(scripts);
}

std::string said_by(const Verified& it) {
  std::string said = it.findings() + '\n';
  for (const VerdictLine& line : it.verdict.facts) {
    if (line.name != "alike") said += line.name + ": " + line.text + '\n';
  }
  return said;
}

}  // namespace lockstep::host::test
