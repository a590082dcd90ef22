#include "scenario/leaf_bindings.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>

#include "base/core/suggest.h"
#include "base/core/wording.h"
#include "leaves/play/played_leaves.h"
#include "leaves/plugin/open/plugin_path.h"
#include "scenario/binding_reader.h"
#include "scenario/recorded_words.h"

namespace lockstep::host {
namespace {

bool is_condition(const NodeType& type) {
  return type.category == NodeCategory::Condition;
}

bool is_leaf(const NodeType& type) {
  return is_condition(type) || type.category == NodeCategory::Action;
}

// The leaves of a type, or those that a path is about: the leaf that has it as its complete path,
// else each leaf that matches it, or an end of whose path does. So M/arm is not M/M/arm where both
// are there, and M/* is the leaf that is named '*'.
class Chosen {
 public:
  Chosen(const std::string& of, const std::string& path, const Tree& tree)
      : of_(of), path_(path), tree_(tree) {
    is_complete_ = std::ranges::any_of(tree.leaves, [&](const LeafNode& leaf) {
      return is_leaf(*leaf.type) && tree.path(leaf.node) == path;
    });
  }

  bool has(const LeafNode& leaf) const {
    if (!is_leaf(*leaf.type)) return false;
    if (path_.empty()) return of_ == leaf.type->id;
    const std::string it = tree_.path(leaf.node);
    if (is_complete_) return path_ == it;
    return matches(path_, it) || matches("*/" + path_, it);
  }

 private:
  const std::string& of_;
  const std::string& path_;
  const Tree& tree_;
  bool is_complete_ = false;
};

class CastMaker {
 public:
  CastMaker(const Scenario& scenario, const Tree& tree, const Definition& given,
            MissingLeaves missing, const Reporter& report)
      : scenario_(scenario), tree_(tree), given_(given), missing_(missing), report_(report) {}

  LeafBindings make(bool has_models) {
    std::vector<const BindingRow*> rows(tree_.leaves.size());
    for (const BindingRow& row : scenario_.bindings) choose(row, rows);
    for (std::size_t leaf = 0; leaf < rows.size(); ++leaf) {
      const LeafNode& it = tree_.leaves[leaf];
      if (!is_leaf(*it.type)) continue;
      if (rows[leaf] != nullptr) {
        give(*rows[leaf], it);
      } else if (given_.nodes[it.node].type->asks) {
        reader_.real.insert(it.node);  // <answer> is for it
      } else {
        reader_.without_row.push_back(it.node);
        if (!has_models) {
          reader_.scripts.leaves[tree_.path(it.node)] = {LeafWord{.status = Status::Success}};
        }
      }
    }
    return std::move(reader_);
  }

 private:
  // Later rows win.
  void choose(const BindingRow& row, std::vector<const BindingRow*>& rows) const {
    bool is_there = false;
    const Chosen chosen(row.of, row.path, tree_);
    for (std::size_t leaf = 0; leaf < rows.size(); ++leaf) {
      if (!chosen.has(tree_.leaves[leaf])) continue;
      rows[leaf] = &row;
      is_there = true;
    }
    if (!is_there && !row.may_lack && missing_ == MissingLeaves::AreErrors) tell_no_match(row);
  }

  void tell_no_match(const BindingRow& row) const {
    const Problem problem = no_such_leaf(tree_, row.of, row.path);
    report_.at_value("bad-scenario"_code, row.place, problem.message, problem.hint);
  }

  void give(const BindingRow& row, const LeafNode& leaf) {
    if (row.from == BindingRow::From::Plugin) {
      if (given_.nodes[leaf.node].type->leaf == nullptr) {
        return report_.at_value("unknown-node"_code, row.source,
                                fmt::format("no plugin has '{}'", leaf.type->id),
                                add_directory("its plugin"));
      }
      reader_.real.insert(leaf.node);
      return;
    }
    const std::string path = tree_.path(leaf.node);
    std::vector<LeafWord> words = row.from == BindingRow::From::Recording
                                      ? words_of_recording(row, leaf)
                                      : words_for(row, *leaf.type);
    if (words.empty()) return;
    check(row, leaf, path, words);
    if (row.restarts) reader_.scripts.restarting.insert(path);
    if (row.seconds && !answers_at_once(row, *leaf.type)) {
      reader_.scripts.times[path] = from_seconds(*row.seconds);
    }
    reader_.scripts.leaves[path] = std::move(words);
  }

  std::vector<LeafWord> words_for(const BindingRow& row, const NodeType& type) const {
    BindingRow made = row;
    if (row.seconds) add_even_words(made, 1);  // LeafScripts::times has the time until it
    if (answers_at_once(row, type)) made.words.erase(made.words.begin(), made.words.end() - 1);
    return std::move(made.words);
  }

  // Whatever the time that the row gives to actions, a condition answers at once.
  static bool answers_at_once(const BindingRow& row, const NodeType& type) {
    return row.has_result && is_condition(type) && !type.can_run;
  }

  std::vector<LeafWord> words_of_recording(const BindingRow& row, const LeafNode& leaf) {
    auto& recording = recordings_[row.recording];
    if (recording == nullptr) {
      recording = std::make_unique<RecordedWords>(read_recorded_words(row.recording, tree_));
      const std::string& error = recording->outcome.error;
      if (!error.empty()) report_.at_value("bad-scenario"_code, row.source, error);
    }
    const auto words = recording->leaves.find(tree_.path(leaf.node));
    // One that the recording never ticks.
    return words == recording->leaves.end() ? std::vector<LeafWord>{LeafWord()} : words->second;
  }

  void check(const BindingRow& row, const LeafNode& leaf, const std::string& path,
             const std::vector<LeafWord>& words) const {
    LeafScripts one;
    const bool writes =
        std::ranges::any_of(words, [](const LeafWord& it) { return !it.written.empty(); });
    if (writes) {
      one.leaves[path] = words;
      if (const auto wrong = PlayedLeaves::check(one, tree_)) {
        return report_.at_value("bad-scenario"_code, row.source, wrong->message, wrong->hint);
      }
    }
    if (!is_condition(*leaf.type) || leaf.type->can_run) return;
    const bool runs = std::ranges::any_of(words, [](const LeafWord& it) {
      return it.kind == LeafWord::Kind::Tick && it.status == Status::Running;
    });
    if (runs && row.from == BindingRow::From::Words) {
      report_.at_value("bad-scenario"_code, row.source,
                       fmt::format("'{}' is a condition, which is never running", leaf.type->id),
                       "write S or F for each tick");
    }
  }

  const Scenario& scenario_;
  const Tree& tree_;
  const Definition& given_;
  const MissingLeaves missing_;
  const Reporter& report_;
  LeafBindings reader_;
  std::map<std::string, std::unique_ptr<RecordedWords>> recordings_;
};

}  // namespace

std::vector<NodeIndex> find_leaves(const Tree& tree, const std::string& of,
                                   const std::string& path) {
  std::vector<NodeIndex> found;
  const Chosen chosen(of, path, tree);
  for (const LeafNode& it : tree.leaves) {
    if (chosen.has(it)) found.push_back(it.node);
  }
  std::ranges::sort(found);
  return found;
}

Problem no_such_leaf(const Tree& tree, const std::string& of, const std::string& path) {
  std::set<std::string> names;
  for (const LeafNode& it : tree.leaves) {
    if (!is_leaf(*it.type)) continue;
    names.insert(path.empty() ? std::string(it.type->id) : tree.path(it.node));
    if (!path.empty()) names.insert(std::string(tree.labels[it.node].name));
  }
  const std::vector<std::string_view> known(names.begin(), names.end());
  return {path.empty() ? fmt::format("the tree has no leaf of type '{}'", brief(of))
                       : fmt::format("the tree has no leaf '{}'", brief(path)),
          suggest_path(path.empty() ? of : path, known, "its leaves")};
}

LeafBindings bind_leaves(const Scenario& scenario, const Tree& tree, const Definition& given,
                         bool has_models, MissingLeaves missing, const Reporter& report) {
  return CastMaker(scenario, tree, given, missing, report).make(has_models);
}

}  // namespace lockstep::host
