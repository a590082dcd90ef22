#include "verify/costs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/core/wording.h"
#include "engine/synchronized.h"
#include "leaves/model_leaf.h"

namespace lockstep::host {
namespace {

constexpr std::size_t kMostCosts = 3, kMostCostNames = 3;
constexpr std::int64_t kFew = 4;  // no cost yet

class CostFinder {
 public:
  CostFinder(const Tree& tree, const LeafModels& models, double rate)
      : tree_(tree), models_(models), rate_(rate) {}

  std::vector<SearchCost> find() {
    add_steps();
    add_running();
    add_times();
    add_counted_ticks();
    add_outputs();
    std::ranges::stable_sort(costs_, std::ranges::greater(), &SearchCost::weight);
    if (costs_.size() > kMostCosts) costs_.resize(kMostCosts);
    return std::move(costs_);
  }

 private:
  std::string names(const std::vector<NodeIndex>& nodes) const {
    return some_of(nodes, kMostCostNames, [&](NodeIndex node) { return tree_.path(node); });
  }

  void add(double weight, std::string what, std::string remedy) {
    costs_.push_back({std::move(what), std::move(remedy), weight});
  }

  static std::string leaves(std::size_t count) {
    return count == 1 ? "1 leaf" : fmt::format("{} leaves", count);
  }

  void add_steps() {
    std::map<std::int32_t, std::vector<NodeIndex>> by_count;
    for (const LeafModel& model : models_.leaves) {
      std::int32_t most = 0;
      for (const LevelReach& it : reaches_in_a_tick(model))
        most = std::max(most, it.last - it.first + 1);
      if (model.can_run && most > kFew) by_count[most].push_back(model.node);
    }
    for (const auto& [count, nodes] : by_count) {
      add(static_cast<double>(nodes.size()) * std::log(count),
          fmt::format("{} may take any of {} steps of progress in a tick: {}", leaves(nodes.size()),
                      count, names(nodes)),
          "step=\"0..1\" in the leaf model, if a tick takes them no farther; or a larger delta, or "
          "fewer barriers");
    }
  }

  // So many of the leaves below a node run at the same time, at most; in the order of the tree.
  std::vector<NodeIndex> running(NodeIndex node) const {
    const NodeType& type = *tree_.labels[node].type;
    if (type.leaf != nullptr || type.mock != nullptr) {
      const auto it = std::ranges::lower_bound(models_.leaves, node, {}, &LeafModel::node);
      const bool can_run = it != models_.leaves.end() && it->node == node && it->can_run;
      return can_run ? std::vector{node} : std::vector<NodeIndex>();
    }
    const bool is_parallel =
        type.latches || synchronization(tree_.nodes[node]) != Synchronization::None;
    std::vector<NodeIndex> all;
    for_each_child(tree_, node, [&](NodeIndex child) {
      std::vector<NodeIndex> of_child = running(child);
      if (is_parallel) {
        all.insert(all.end(), of_child.begin(), of_child.end());
      } else if (of_child.size() > all.size()) {
        all = std::move(of_child);
      }
    });
    return all;
  }

  void add_running() {
    const std::vector<NodeIndex> nodes = running(0);
    if (nodes.size() < 3) return;
    double weight = 0;
    for (const LeafModel& model : models_.leaves) {
      if (!std::ranges::binary_search(nodes, model.node)) continue;
      const ResultSet& may = model.results;
      weight += std::log(1 + may.success + may.failure + may.skipped + may.fault);
    }
    constexpr double kMostShown = 30;  // as a number: about 10^13
    add(weight,
        fmt::format("{} run at the same time, with {} combinations of results in a tick: {}",
                    leaves(nodes.size()),
                    weight < kMostShown ? fmt::format("{:.3g}", std::exp(weight))
                                        : fmt::format("10^{:.0f}", weight / std::log(10)),
                    names(nodes)),
        "the results and ticks that they have in the leaf model, such as result=\"success\" "
        "ticks=\"20..inf\"");
  }

  // Of nodes that count time: a constant that the tree gives them.
  void add_times() {
    for (NodeIndex node = 0; node < tree_.nodes[0].end; ++node) {
      const NodeType& type = *tree_.labels[node].type;
      if (type.leaf != nullptr || type.mock != nullptr || type.reads_ports) continue;
      if (std::ranges::find(tree_.bound, node, &BoundNode::node) != tree_.bound.end()) continue;
      for (std::size_t i = 0; i < type.parameters.size(); ++i) {
        const Parameter& parameter = type.parameters[i];
        if (parameter.unit != "s" || parameter.type != ValueType::Double) continue;
        const double seconds = tree_.cells[tree_.nodes[node].params + i].number;
        const double ticks = std::ceil(seconds * rate_ - 1e-9);
        if (!(ticks > 10 * kFew) || ticks > 1e12) continue;
        add(std::log(ticks),
            fmt::format("'{}' counts {:.0f} ticks: {:g} s at {:g} Hz", tree_.path(node), ticks,
                        seconds, rate_),
            fmt::format("--rate {:.3g}, if a lower rate is exact enough, or a shorter time",
                        std::max(0.001, 10 / seconds)));
      }
    }
  }

  void add_counted_ticks() {
    std::map<std::int64_t, std::vector<NodeIndex>> by_count;
    for (const LeafModel& model : models_.leaves) {
      const std::int64_t count = std::max(model.least_ticks, model.most_ticks);
      if (count > 10 * kFew) by_count[count].push_back(model.node);
    }
    for (const auto& [count, nodes] : by_count) {
      add(static_cast<double>(nodes.size()) * std::log(static_cast<double>(count)),
          fmt::format("{} in the leaf model may take up to {} ticks, which are counted: {}",
                      leaves(nodes.size()), count, names(nodes)),
          "a lower rate with fewer ticks; or ticks=\"1..inf\", which counts none");
    }
  }

  void add_outputs() {
    for (const LeafModel& model : models_.leaves) {
      for (const LeafModel::Output& it : model.outputs) {
        if (it.values.size() <= 10 * kFew) continue;
        add(std::log(static_cast<double>(it.values.size())),
            fmt::format("'{}' writes any of {} values to '{}'", tree_.path(model.node),
                        it.values.size(), tree_.slots[it.slot].name),
            "fewer values in the leaf model: one on each side of each number that the tree "
            "compares it with");
      }
    }
  }

  const Tree& tree_;
  const LeafModels& models_;
  const double rate_;
  std::vector<SearchCost> costs_;
};

}  // namespace

std::vector<SearchCost> search_costs(const Tree& tree, const LeafModels& models, double rate) {
  return CostFinder(tree, models, rate).find();
}

}  // namespace lockstep::host
