// A tree text and a leaf file, verified.
#pragma once

#include <string_view>

#include "leaves/leaf_file.h"
#include "support/tree_text.h"
#include "verify/trace.h"
#include "verify/verdict.h"

namespace lockstep::host::test {

struct Verified {
  // `rows`: those of a leaf file. Throws std::invalid_argument for mistakes in either.
  Verified(std::string_view tree, std::string_view rows = "", const SearchLimits& limits = {},
           double rate = 10, std::vector<std::string> properties = {},
           const LanguageRules& rules = kLockstepRules, const ProcessCuts& cuts = {});

  const Finding* finding(std::string_view name) const;
  // "" if nothing is said.
  std::string said(std::string_view name) const;
  // "trap, never-ticked/x".
  std::string findings() const;
  // What the leaves do in the run that shows a finding: "M/a = R0 S\n".
  std::string script(std::string_view finding) const;

  Tree tree;
  std::vector<Property> properties;
  LeafModels models;
  double rate;
  SearchResult found;
  Verdict verdict;
};

// What must be the same, however a search looks.
std::string said_by(const Verified& it);

}  // namespace lockstep::host::test
