#include "leaves/declared.h"

#include "lockstep/leaf.h"

namespace lockstep::host {

std::vector<Statement> declared_behavior(const NodeType& type) {
  std::vector<Statement> statements;
  if (type.leaf == nullptr) return statements;
  for (std::uint32_t i = 0; i < type.leaf->behavior_count; ++i) {
    statements.push_back({type.leaf->behavior[i].word, type.leaf->behavior[i].value});
  }
  return statements;
}

}  // namespace lockstep::host
