#include "verify/certain.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/core/language.h"
#include "base/core/wording.h"
#include "engine/writers.h"
#include "language/expression/expression.h"
#include "verify/chance_runs.h"
#include "verify/verifiable.h"

namespace lockstep::host {
namespace {

// The same on every machine, and some hundredths of a second.
constexpr std::size_t kMostNodes = 10'000;

SearchLimits bound(const Tree& tree) {
  return {.states = 20'000,
          .transitions = std::min<std::uint64_t>(50'000, 10'000'000 / tree.nodes.size()),
          .memory = std::numeric_limits<std::size_t>::max()};
}

// The rate decides what comes first.
bool has_clocks(const Tree& tree) {
  return std::ranges::any_of(tree.labels, [](const NodeLabel& label) {
    return label.type->leaf == nullptr && label.type->mock == nullptr &&
           std::ranges::any_of(label.type->parameters,
                               [](const Parameter& it) { return !it.unit.empty(); });
  });
}

// Whoever starts the tree may give it other start values.
bool has_start_values(const Tree& tree, const LeafModels& models) {
  const auto written = writers(tree);  // by the tree itself, or by its leaves
  for (std::size_t slot = 0; slot < tree.slots.size(); ++slot) {
    const bool has_value = !std::holds_alternative<NoValue>(tree.slots[slot].initial);
    if (models.entries[slot] && (has_value || written[slot].empty())) return true;
  }
  return false;
}

class Certainties {
 public:
  Certainties(const Tree& tree, std::span<const Place> places, const SearchResult& found)
      : tree_(tree), places_(places), found_(found), graph_(found.graph_of_cycles()) {}

  std::vector<Certainty> find() {
    look_for_dead_nodes();
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

  // The child before it decides, or keeps all behind it from their ticks, as one does that reads
  // what is not there yet.
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

  // "its while reads 'k', which has no value yet: 'later' writes it, which comes after it"
  std::string why_unset(NodeIndex node) const {
    std::string why = why_unset(own_script(node), node, "it");
    for (const HookedNode& it : tree_.hooked) {
      if (it.node != node) continue;
      for (const Hook hook : {Hook::FailureIf, Hook::SuccessIf, Hook::SkipIf, Hook::While}) {
        if (!why.empty()) return why;
        why = why_unset(it.script(hook), node,
                        fmt::format("its {}", attribute_of(hook, *tree_.rules)));
      }
    }
    return why;
  }

  std::string why_unset(std::uint32_t number, NodeIndex node, std::string_view what) const {
    if (number >= tree_.scripts.size() || tree_.scripts[number].code == nullptr) return "";
    const Script& script = tree_.scripts[number];
    for (std::size_t i = 0; i < script.slots.size(); ++i) {
      const Slot& slot = tree_.slots[script.slots[i]];
      const std::vector<NodeIndex>& who = writers_[script.slots[i]];
      const bool is_read = script.code->uses()[i].is_read;
      const bool is_unset = std::holds_alternative<NoValue>(slot.initial) && !who.empty() &&
                            std::ranges::min(who) > node;
      if (!is_read || !is_unset) continue;
      return fmt::format("{} reads '{}', which has no value yet: '{}' writes it, which comes after",
                         what, brief(slot.name), tree_.labels[std::ranges::min(who)].name);
    }
    return "";
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
                            "`lockstep verify` shows how"});
  }

  const Tree& tree_;
  const std::span<const Place> places_;
  const SearchResult& found_;
  const Graph& graph_;
  const std::vector<std::vector<NodeIndex>> writers_ = writers(tree_);
  std::vector<Certainty> certainties_;
};

}  // namespace

std::vector<Certainty> certainties_of(const Tree& tree, std::span<const Place> places,
                                      std::function<int()> stop_signal) {
  Diagnostics diagnostics;
  if (tree.nodes.size() > kMostNodes || has_clocks(tree) || !not_verifiable(tree).empty())
    return {};
  std::vector<NodeProblem> problems;
  const LeafModels models =
      make_models(tree, nullptr, diagnostics, problems, {}, Declared::Ignored);
  if (!problems.empty() || has_start_values(tree, models)) return {};
  SearchLimits limits = bound(tree);
  limits.stop_signal = std::move(stop_signal);
  const SearchResult found = search(tree, models, {}, from_seconds(1 / kModelRate), limits);
  if (!found.is_complete()) return {};
  std::vector<Certainty> certainties = Certainties(tree, places, found).find();
  // A few are enough to say nothing false; their number is the same on every machine.
  const ChanceLimits few{.runs = std::clamp<std::uint64_t>(10'000 / tree.nodes.size(), 2, 30),
                         .time = Nanoseconds::max()};
  const bool is_wrong =
      !certainties.empty() &&
      find_contradiction(tree, models, {}, from_seconds(1 / kModelRate), found, few);
  return is_wrong ? std::vector<Certainty>() : certainties;
}

}  // namespace lockstep::host
