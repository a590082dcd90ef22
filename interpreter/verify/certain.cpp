#include "verify/certain.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "expression/expression.h"
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

// The entries that the tree itself writes, or its leaves.
std::vector<bool> written_entries(const Tree& tree) {
  std::vector<bool> written(tree.slots.size());
  for (const Script& script : tree.scripts) {
    if (script.code == nullptr) continue;
    for (std::size_t i = 0; i < script.slots.size(); ++i) {
      if (script.code->uses()[i].is_assigned) written[script.slots[i]] = true;
    }
  }
  for (const LeafNode& leaf : tree.leaves) {
    for (std::size_t i = 0; i < leaf.type->parameters.size(); ++i) {
      const std::uint32_t slot = tree.ports[leaf.first_port + i].slot;
      const bool is_output = leaf.type->parameters[i].direction != Direction::Input;
      if (is_output && slot != PortBinding::kUnbound) written[slot] = true;
    }
  }
  return written;
}

// Whoever starts the tree may give it other start values.
bool has_start_values(const Tree& tree, const LeafModels& models) {
  const std::vector<bool> written = written_entries(tree);
  for (std::size_t slot = 0; slot < tree.slots.size(); ++slot) {
    const bool has_value = !std::holds_alternative<NoValue>(tree.slots[slot].initial);
    if (models.entries[slot] && (has_value || !written[slot])) return true;
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

  // The child before it decides, or keeps all behind it from their ticks.
  std::string why_dead(NodeIndex node) const {
    const NodeIndex parent = tree_.labels[node].parent;
    const Status goes_on = tree_.labels[parent].type->goes_on_after;
    NodeIndex before = 0;
    for (NodeIndex at = parent + 1; at < node; at = tree_.nodes[at].end) before = at;
    if (before == 0 || goes_on == Status::Idle || found_.coverage.has_been(before, goes_on)) {
      return "";
    }
    return fmt::format("'{}' before it never {}", tree_.labels[before].name,
                       goes_on == Status::Success ? "succeeds" : "fails");
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
