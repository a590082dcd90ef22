// The scripts of a tree in one run, over its entries. The text of some is in an entry: they are
// compiled when it has changed.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/blackboard.h"
#include "engine/named_entries.h"
#include "engine/readings.h"
#include "engine/tree.h"
#include "language/expression/change.h"
#include "language/expression/evaluator.h"
#include "language/expression/relation.h"

namespace lockstep::host {

class BoundScripts {
 public:
  // All must outlive this, and the entries of `board` stay where they are.
  BoundScripts(const Tree& tree, Blackboard& board, NamedEntries& names, Readings& readings);

  // Runs a script of a node. False after an error. An empty text does nothing.
  bool run(NodeIndex node, std::uint32_t script) {
    const Bound& it = scripts_[script];
    return (it.change && apply(*it.change, *it.entries.front())) || run_all(node, script);
  }
  // The same, with its value.
  bool evaluate(NodeIndex node, std::uint32_t script) {
    const Bound& it = scripts_[script];
    if (it.source != nullptr) [[unlikely]]
      return evaluate_entry(node, script);
    return evaluator_.evaluate(*it.code, it.entries, value_);
  }
  // The value of the last evaluation.
  const Value& value() const { return value_; }
  // The same, of one that is a condition.
  Truth test(NodeIndex node, std::uint32_t script) {
    const Bound& it = scripts_[script];
    double number = 0;
    if (it.comparison == nullptr || !take(*it.compared, number)) {
      return test_all(node, script);
    }
    return are_related(number, it.comparison->relation, it.comparison->real) ? Truth::Yes
                                                                             : Truth::No;
  }
  // The error of the last script that failed.
  const std::string& error() const { return evaluator_.error(); }
  // As new, for the next run.
  void reset();

 private:
  struct FromEntry {
    explicit FromEntry(const Entry* from) : entry(from) {}
    const Entry* entry;
    std::string text = {};  // that was compiled
    Expression code = {};
    std::vector<Entry*> entries = {};
  };
  struct Bound {
    const Expression* code;  // null: there is none now
    std::span<Entry* const> entries = {};
    const Instruction* comparison = nullptr;  // set while nothing else is needed
    const Value* compared = nullptr;          // with a number; of the first entry
    std::optional<Change> change = {};        // set while nothing else is needed
    std::unique_ptr<FromEntry> source = {};
  };
  bool evaluate_entry(NodeIndex node, std::uint32_t script);
  bool compile(NodeIndex node, std::uint32_t script);
  bool run_all(NodeIndex node, std::uint32_t script);
  Truth test_all(NodeIndex node, std::uint32_t script);

  const Tree& tree_;
  NamedEntries& names_;
  std::vector<Bound> scripts_;   // of each Tree::scripts
  std::vector<Entry*> entries_;  // and readings, theirs, one after another
  Evaluator evaluator_;
  Value value_;  // of the last script
};

}  // namespace lockstep::host
