#include "verify/certain.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/core/audience.h"
#include "base/core/language.h"
#include "base/core/wording.h"
#include "engine/writers.h"
#include "language/expression/expression.h"

namespace lockstep::host {
namespace {

class Certainties {
 public:
  Certainties(const Tree& tree, std::span<const Place> places, const SearchResult& found,
              Results results, bool deadlocks, std::string why_it_stands)
      : tree_(tree),
        places_(places),
        found_(found),
        results_(results),
        graph_(found.graph_of_cycles()),
        deadlocks_(deadlocks),
        why_it_stands_(std::move(why_it_stands)) {}

  std::vector<Advice> find() {
    look_for_faults();
    look_for_dead_nodes();
    if (std::ranges::none_of(found_.results, [](const auto& it) { return it.has_value(); }) &&
        found_.faults.empty()) {
      add_endless();
    }
    return std::move(certainties_);
  }

 private:
  // A SubTree that is used twice has two nodes at one place of the file. Their faults are reported
  // only if each tick of both is one.
  void look_for_faults() {
    std::set<std::uint32_t> more, told;
    for (NodeIndex node = 0; node < tree_.nodes[0].end; ++node) {
      if (has_ended(node) || found_.coverage.has_been(node, Status::Running))
        more.insert(places_[node].byte);
    }
    for (const auto& [node, fault] : found_.faults) {
      const std::uint32_t place = places_[node].byte;
      if (more.contains(place)) continue;
      faulty_.insert(node);
      if (!told.insert(place).second) continue;
      certainties_.push_back(
          {"always-fault"_code, node, severity(),
           fmt::format("each tick of '{}' is a fault, {}: {}", tree_.labels[node].name,
                       premise("whatever the leaves do"), fault.first),
           hint_of_fault(node, fault.first)});
    }
  }

  void look_for_dead_nodes() {
    std::set<std::uint32_t> alive, told;
    for (NodeIndex node = 0; node < tree_.nodes[0].end; ++node) {
      if (found_.coverage.was_ticked(node)) alive.insert(places_[node].byte);
    }
    for (NodeIndex node = 0; node < tree_.nodes[0].end;) {
      const bool is_dead = !alive.contains(places_[node].byte);
      if (is_dead && !is_kept_by_fault(node) && told.insert(places_[node].byte).second) {
        certainties_.push_back({"dead-node"_code, node, severity(),
                                fmt::format("'{}' can never run, {}", tree_.labels[node].name,
                                            premise("whatever the leaves do")),
                                why_dead(node)});
      }
      node = is_dead ? tree_.nodes[node].end : node + 1;
    }
  }

  // Whether a node around it or before it, whose ticks are all faults, is why it gets no tick. For
  // example, the child of a Sequence whose _while reads an entry without a value.
  bool is_kept_by_fault(NodeIndex node) const {
    const NodeIndex parent = tree_.labels[node].parent;
    if (faulty_.contains(parent)) return true;
    for (NodeIndex at = parent + 1; at < node; at = tree_.nodes[at].end) {
      const auto fault = faulty_.lower_bound(at);
      const bool has_one = fault != faulty_.end() && *fault < tree_.nodes[at].end;
      if (has_one && !has_ended(at)) return true;
    }
    return false;
  }

  bool has_ended(NodeIndex node) const {
    return std::ranges::any_of(kStatuses, [&](const StatusRow& it) {
      return it.status != Status::Idle && it.status != Status::Running &&
             found_.coverage.has_been(node, it.status);
    });
  }

  // The child before it decides.
  std::string why_dead(NodeIndex node) const {
    const NodeIndex parent = tree_.labels[node].parent;
    const Status goes_on = tree_.labels[parent].type->goes_on_after;
    NodeIndex before = 0;
    for (NodeIndex at = parent + 1; at < node; at = tree_.nodes[at].end) before = at;
    if (before == 0 || goes_on == Status::Idle || found_.coverage.has_been(before, goes_on)) {
      return "";
    }
    const std::string why = found_.faults.contains(before) ? why_unset(before) : "";
    return fmt::format("'{}' before it never {}{}{}", tree_.labels[before].name,
                       goes_on == Status::Success ? "succeeds" : "fails", why.empty() ? "" : ": ",
                       why);
  }

  // "its while reads 'k', which has no value yet: 'later' writes it, which comes after"
  std::string why_unset(NodeIndex node) const {
    std::string why;
    for_each_script(node, [&](const Script& script, std::string_view what) {
      for (std::size_t i = 0; i < script.slots.size(); ++i) {
        const Slot& slot = tree_.slots[script.slots[i]];
        const std::vector<NodeIndex>& who = writers_[script.slots[i]];
        const bool is_read = script.code->uses()[i].is_read;
        const bool is_unset = std::holds_alternative<NoValue>(slot.initial) && !who.empty() &&
                              std::ranges::min(who) > node;
        if (!why.empty() || !is_read || !is_unset) continue;
        why =
            fmt::format("{} reads '{}', which has no value yet: '{}' writes it, which comes after",
                        what, brief(slot.name), tree_.labels[std::ranges::min(who)].name);
      }
    });
    return why;
  }

  // Each run may be given the value that is missing: --set, a start value.
  std::string hint_of_fault(NodeIndex node, std::string_view fault) const {
    const std::string why = why_unset(node);
    const Slot* const slot = missing_in(node, fault);
    if (slot == nullptr) return why;
    return fmt::format("{}{}{}", why, why.empty() ? "" : "; or ", how_to_give(slot->name));
  }

  // An entry of the main tree that the node reads and the fault names, and that has no value then;
  // null: none.
  const Slot* missing_in(NodeIndex node, std::string_view fault) const {
    const Slot* missing = nullptr;
    const auto look_at = [&](std::uint32_t number, std::string_view quoted) {
      if (missing == nullptr && is_never_written(number, node) && fault.find(quoted) != fault.npos)
        missing = &tree_.slots[number];
    };
    for (const std::uint32_t number : scripts_of(node)) {
      const Script& script = tree_.scripts[number];
      for (std::size_t i = 0; script.code != nullptr && i < script.slots.size(); ++i) {
        if (script.code->uses()[i].is_read)
          look_at(script.slots[i], fmt::format("'{}'", script.code->names()[i]));
      }
    }
    for (const BoundNode& it : tree_.bound) {
      if (it.node != node) continue;
      for (std::size_t i = 0; i < it.kind->type.parameters.size(); ++i) {
        const std::uint32_t slot = tree_.ports[it.first_port + i].slot;
        if (slot != PortBinding::kUnbound)
          look_at(slot, fmt::format("'{{{}}}'", tree_.slots[slot].name));
      }
    }
    return missing;
  }

  // Whether an entry that a person may give a value has none before the node has written one.
  bool is_never_written(std::uint32_t number, NodeIndex node) const {
    const Slot& slot = tree_.slots[number];
    const bool is_inner = slot.name.find('/') != std::string::npos;
    return !is_inner && std::holds_alternative<NoValue>(slot.initial) &&
           std::ranges::none_of(writers_[number], [&](NodeIndex writer) {
             return writer != node && found_.coverage.was_ticked(writer);
           });
  }

  std::vector<std::uint32_t> scripts_of(NodeIndex node) const {
    std::vector<std::uint32_t> all{own_script(node)};
    for (const HookedNode& it : tree_.hooked) {
      if (it.node == node) all.insert(all.end(), std::begin(it.scripts), std::end(it.scripts));
    }
    std::erase_if(all, [&](std::uint32_t it) { return it >= tree_.scripts.size(); });
    return all;
  }

  // Calls use(script, "its while") for those that decide before its tick.
  template <class Use>
  void for_each_script(NodeIndex node, const Use& use) const {
    const auto look_at = [&](std::uint32_t number, std::string_view what) {
      if (number < tree_.scripts.size() && tree_.scripts[number].code != nullptr) {
        use(tree_.scripts[number], what);
      }
    };
    look_at(own_script(node), "it");
    for (const HookedNode& it : tree_.hooked) {
      if (it.node != node) continue;
      for (const Hook hook : {Hook::FailureIf, Hook::SuccessIf, Hook::SkipIf, Hook::While}) {
        look_at(it.script(hook), fmt::format("its {}", attribute_of(hook, *tree_.rules)));
      }
    }
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

  Severity severity() const {
    return results_ == Results::All ? Severity::Warning : Severity::Note;
  }

  std::string_view premise(std::string_view none) const {
    return results_ == Results::All ? none : "unless a leaf returns Skipped";
  }

  void add_endless() {
    const bool goes_on = recurs(
        graph_, [&](const Edge& edge) { return graph_.has(edge, graph_.shape.begun_bit()); });
    if (goes_on || !deadlocks_) {
      certainties_.push_back(
          {"endless-tree"_code, 0, Severity::Note,
           fmt::format("this tree never ends, {}", premise("whatever its leaves do")),
           goes_on ? "" : std::move(why_it_stands_)});
      return;
    }
    certainties_.push_back({"deadlock"_code, 0, severity(),
                            fmt::format("this tree can never end: {}, it deadlocks",
                                        premise("whatever its leaves do")),
                            std::move(why_it_stands_)});
  }

  const Tree& tree_;
  const std::span<const Place> places_;
  const SearchResult& found_;
  const Results results_;
  const Graph& graph_;
  const std::vector<std::vector<NodeIndex>> writers_ = writers(tree_);
  const bool deadlocks_;
  std::string why_it_stands_;
  std::set<NodeIndex> faulty_;  // each of whose ticks is a fault
  std::vector<Advice> certainties_;
};

}  // namespace

std::vector<Advice> certainties(const Tree& tree, std::span<const Place> places,
                                const SearchResult& found, Results results, bool deadlocks,
                                std::string why_it_stands) {
  return Certainties(tree, places, found, results, deadlocks, std::move(why_it_stands)).find();
}

}  // namespace lockstep::host
