// Barriers and pools, which are declared in `root` beside the trees. In both languages.
#pragma once

#include <map>
#include <string_view>

#include "language/document/document.h"
#include "language/document/project.h"
#include "language/document/reporter.h"
#include "tree/check/attribute_layout.h"
#include "tree/checked_tree.h"

namespace lockstep::host {

class DeclaredGroups {
 public:
  // All must outlive this. Groups without a mistake are added to `trees`.
  DeclaredGroups(const Project& project, const Reporter& report, CheckedTrees& trees)
      : project_(project), report_(report), trees_(trees) {}

  // Of a document of the project.
  void check(std::uint32_t document, std::uint32_t element, const NodeType& type);

 private:
  void enter(CheckedNode& group, std::string_view prefix, Place name);

  const Project& project_;
  const Reporter& report_;
  CheckedTrees& trees_;
  AttributeLayouts layouts_;
  std::map<std::string_view, Place> places_;
};

}  // namespace lockstep::host
