// A run of a program as Groot2 sees it. Only within embedding/.
#pragma once

#include <memory>
#include <string>

#include "base/core/problem.h"

namespace lockstep::host {

struct Definition;
struct GrootTree;
class Observer;
struct Tree;

namespace embedding {

// The picture that Groot2 gets of a tree. Null where this lockstep, or Groot2, cannot show the
// tree.
std::shared_ptr<const GrootTree> groot_of(const Definition& definition);
// Begins to answer. `address` is that of --groot2.
Result<std::unique_ptr<Observer>> show_groot(const Tree& tree, const GrootTree& shown,
                                             const std::string& address);

}  // namespace embedding
}  // namespace lockstep::host
