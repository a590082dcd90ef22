// A compiled tree from a whole document, checked as the program checks it. Its leaves are scripted:
// <Scripted name="a"/>, <ScriptedCondition name="b"/> and <Bare name="c"/>.
#pragma once

#include <optional>
#include <string>

#include "engine/tree.h"

namespace lockstep::host::test {

struct LoadedDocument {
  std::optional<Tree> tree;
  std::string errors;  // a line each; "" if there is a tree
};

LoadedDocument tree_from_document(const std::string& xml);

}  // namespace lockstep::host::test
