// The scripts of a tree in one run, over its entries. The text of some is in an entry: they are
// compiled when it has changed.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "engine/blackboard.h"
#include "engine/named_entries.h"
#include "engine/tree.h"
#include "expression/evaluator.h"

namespace lockstep {

class BoundScripts {
 public:
  // All must outlive this, and the entries of `board` stay where they are.
  BoundScripts(const Tree& tree, Blackboard& board, NamedEntries& names);

  // Runs a script of a node. Returns "" or the error. An empty text does nothing.
  std::string evaluate(NodeIndex node, std::uint32_t script);
  // What the last one gave.
  const Value& value() const { return value_; }
  // The same, of one that is a condition.
  std::string test(NodeIndex node, std::uint32_t script, bool& holds);
  // As new, for the next run.
  void reset();

 private:
  struct FromEntry {
    explicit FromEntry(const Entry* from) : entry(from) {}
    const Entry* entry;
    std::string text = {};  // that was compiled
    Expression code = {};
  };
  struct Bound {
    const Expression* code;  // null: there is none now
    std::vector<Entry*> entries = {};
    std::unique_ptr<FromEntry> source = {};
  };
  std::string compile(NodeIndex node, std::uint32_t script);

  const Tree& tree_;
  NamedEntries& names_;
  std::vector<Bound> scripts_;  // of each Tree::scripts
  Evaluator evaluator_;
  Value value_;  // of the last script
};

}  // namespace lockstep
