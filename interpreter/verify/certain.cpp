#include "verify/certain.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <set>

#include "base/core/language.h"
#include "base/core/wording.h"
#include "engine/writers.h"
#include "language/expression/expression.h"
#include "language/expression/program.h"

namespace lockstep::host {
namespace {

// Nodes with a script that reads an entry before anything has written it.
class UnsetReads {
 public:
  explicit UnsetReads(const Tree& tree) : tree_(tree) {}

  // "its while reads 'k', which has no value yet: 'later' writes it, which comes after"; "": none.
  std::string why(NodeIndex node) const {
    const auto read = find(node);
    if (!read) return "";
    return fmt::format("{} reads '{}', which has no value yet: '{}' writes it, which comes after",
                       read->what, brief(tree_.slots[read->slot].name),
                       tree_.labels[std::ranges::min(writers_[read->slot])].name);
  }

  // The node begins with the reading, whatever its scripts find.
  bool begins(NodeIndex node) const {
    const auto read = find(node);
    return read && read->is_first;
  }

 private:
  struct Read {
    std::string what;
    std::uint32_t slot;
    bool is_first;
  };

  std::optional<Read> find(NodeIndex node) const {
    bool is_first = true;
    for (const HookedNode& it : tree_.hooked) {
      if (it.node != node) continue;
      for (const Hook hook : {Hook::FailureIf, Hook::SuccessIf, Hook::SkipIf, Hook::While}) {
        const std::string what = fmt::format("its {}", attribute_of(hook, *tree_.rules));
        if (auto read = find(it.script(hook), node, what, is_first)) return read;
        is_first = is_first && it.script(hook) == HookedNode::kNoScript;
      }
    }
    return find(own_script(node), node, "it", is_first);
  }

  std::optional<Read> find(std::uint32_t number, NodeIndex node, std::string_view what,
                           bool is_first) const {
    if (number >= tree_.scripts.size() || tree_.scripts[number].code == nullptr) return {};
    const Script& script = tree_.scripts[number];
    for (std::uint32_t i = 0; i < script.slots.size(); ++i) {
      const std::uint32_t slot = script.slots[i];
      const std::vector<NodeIndex>& who = writers_[slot];
      const bool is_unset = std::holds_alternative<NoValue>(tree_.slots[slot].initial) &&
                            !who.empty() && std::ranges::min(who) > node;
      if (!script.code->uses()[i].is_read || !is_unset) continue;
      return Read{std::string(what), slot, is_first && is_always_read(*script.code, i)};
    }
    return {};
  }

  // Nothing before it decides whether it is.
  static bool is_always_read(const Expression& script, std::uint32_t name) {
    using enum Operation;
    for (const Instruction& it : script.program().code) {
      const bool loads =
          it.operation == Load || it.operation == LoadCopy || it.operation == LoadToCompare;
      if (loads && it.argument == name) return true;
      if (it.operation == CompareNext || it.operation == JumpIfZero || it.operation == Jump)
        return false;
    }
    return false;
  }

  std::uint32_t own_script(NodeIndex node) const {
    const NodeType& type = *tree_.labels[node].type;
    const auto it = std::ranges::find(type.parameters, true, &Parameter::is_script);
    if (type.leaf != nullptr || type.mock != nullptr || type.reads_ports ||
        it == type.parameters.end()) {
      return HookedNode::kNoScript;
    }
    const auto at = static_cast<std::uint32_t>(it - type.parameters.begin());
    return static_cast<std::uint32_t>(tree_.cells[tree_.nodes[node].params + at].integer);
  }

  const Tree& tree_;
  const std::vector<std::vector<NodeIndex>> writers_ = writers(tree_);
};

class Certainties {
 public:
  Certainties(const Tree& tree, std::span<const Place> places, const SearchResult& found,
              std::string why_it_stands)
      : tree_(tree),
        places_(places),
        found_(found),
        graph_(found.graph_of_cycles()),
        why_it_stands_(std::move(why_it_stands)) {}

  std::vector<Advice> find() {
    look_for_dead_nodes();
    for (const auto& [node, fault] : found_.faults) {
      if (!told_.contains(node) && unset_.begins(node) && !does_anything(node))
        add_unset_read(node);
    }
    if (std::ranges::none_of(found_.results, [](const auto& it) { return it.has_value(); }) &&
        found_.faults.empty()) {
      add_endless();
    }
    return std::move(certainties_);
  }

 private:
  // A node of a SubTree that is used twice is dead only if it is in both.
  void look_for_dead_nodes() {
    std::set<std::uint32_t> alive, told;
    for (NodeIndex node = 0; node < tree_.nodes[0].end; ++node) {
      if (found_.coverage.was_ticked(node)) alive.insert(places_[node].byte);
    }
    for (NodeIndex node = 0; node < tree_.nodes[0].end;) {
      const bool is_dead = !alive.contains(places_[node].byte);
      if (is_dead && told.insert(places_[node].byte).second) {
        certainties_.push_back(
            {node, Severity::Warning,
             fmt::format("'{}' can never run, whatever the leaves do", tree_.labels[node].name),
             why_dead(node)});
      }
      node = is_dead ? tree_.nodes[node].end : node + 1;
    }
  }

  // But fail, as a fault is counted.
  bool does_anything(NodeIndex node) const {
    return std::ranges::any_of(std::array{Status::Running, Status::Success, Status::Skipped},
                               [&](Status it) { return found_.coverage.has_been(node, it); });
  }

  void add_unset_read(NodeIndex node) {
    const std::string why = unset_.why(node);
    if (why.empty()) return;
    certainties_.push_back({node, Severity::Warning,
                            fmt::format("'{}' faults in its first tick", tree_.labels[node].name),
                            why});
  }

  // The child before it decides, or keeps all behind it from their ticks, as one does that reads
  // what is not there yet.
  std::string why_dead(NodeIndex node) {
    const NodeIndex parent = tree_.labels[node].parent;
    const Status goes_on = tree_.labels[parent].type->goes_on_after;
    NodeIndex before = 0;
    for (NodeIndex at = parent + 1; at < node; at = tree_.nodes[at].end) before = at;
    if (before == 0 || goes_on == Status::Idle || found_.coverage.has_been(before, goes_on)) {
      return "";
    }
    const std::string why = found_.faults.contains(before) ? unset_.why(before) : "";
    if (!why.empty()) told_.insert(before);
    return fmt::format("'{}' before it never {}{}{}", tree_.labels[before].name,
                       goes_on == Status::Success ? "succeeds" : "fails", why.empty() ? "" : ": ",
                       why);
  }

  void add_endless() {
    const LabelShape& shape = graph_.shape;
    const bool goes_on =
        recurs(graph_, [&](const Edge& edge) { return graph_.has(edge, shape.begun_bit()); });
    const bool holds = recurs(graph_, [&](const Edge& edge) {
      for (std::size_t i = 0; i < shape.held; ++i) {
        if (graph_.has(edge, shape.held_bit(i))) return true;
      }
      return false;
    });
    if (goes_on || !holds) {
      certainties_.push_back(
          {0, Severity::Note, "this tree never ends, whatever its leaves do", ""});
      return;
    }
    certainties_.push_back({0, Severity::Warning,
                            "this tree can never end: whatever its leaves do, it stands still",
                            std::move(why_it_stands_)});
  }

  const Tree& tree_;
  const std::span<const Place> places_;
  const SearchResult& found_;
  const Graph& graph_;
  const UnsetReads unset_{tree_};
  std::set<NodeIndex> told_;  // that they read what is unset
  std::string why_it_stands_;
  std::vector<Advice> certainties_;
};

}  // namespace

std::vector<Advice> certainties(const Tree& tree, std::span<const Place> places,
                                const SearchResult& found, std::string why_it_stands) {
  return Certainties(tree, places, found, std::move(why_it_stands)).find();
}

}  // namespace lockstep::host
