// Checked trees -> Definition: subtrees expanded into the main tree, keys resolved to entries.
#pragma once

#include <map>
#include <string>

#include "language/document/reporter.h"
#include "tree/checked_tree.h"
#include "tree/definition.h"

namespace lockstep::host {

// `--set key=value`.
using StartValues = std::map<std::string, std::string, std::less<>>;

// OfPart: the tree is for others, from which it may get entries, their types and groups.
enum class Expansion : bool { OfMain, OfPart };

// Values of `later` come while the tree runs: they have types only.
// `main` is an ID in `trees`, which can be expanded (check_references). Parts with errors are left
// out, so that the rest is still checked. Moves out of `trees` what the definition keeps.
Definition expand(CheckedTrees& trees, std::string_view main, const StartValues& values,
                  const Reporter& report, Expansion expansion = Expansion::OfMain,
                  const StartValues& later = {});
// What expand() moved out of `trees`, for the next one.
void take_back(CheckedTrees& trees, Definition definition);

}  // namespace lockstep::host
