#include "verify/failure_table.h"

#include <algorithm>
#include <cmath>

#include "verify/trace.h"
#include "verify/verdict.h"

namespace lockstep::host {
namespace {

// Of a search: they are ticked once more, to see which leaves are halted.
constexpr std::size_t kMostStatesToLookAt = 100'000;

bool is_condition(const Tree& tree, std::uint32_t leaf) {
  return tree.leaves[leaf].type->category == NodeCategory::Condition;
}

bool can_fail_so(const Tree& tree, const LeafModel& model, std::uint32_t leaf, LeafFailure how) {
  if (is_condition(tree, leaf)) return how == LeafFailure::AtOnce || how == LeafFailure::Fault;
  return how != LeafFailure::NoProgress || model.levels.size() > 1;
}

// Where nothing fails.
LeafModels nominal_models(const Tree& tree, const LeafModels& models) {
  LeafModels nominal = models;
  for (std::uint32_t leaf = 0; leaf < nominal.leaves.size(); ++leaf) {
    LeafModel& model = nominal.leaves[leaf];
    if (is_condition(tree, leaf) || model.fact != kNoFact) continue;
    model.results = {.success = true, .failure = false, .skipped = false, .fault = false};
    model.ends = true;
  }
  return nominal;
}

void apply(const FailureCase& it, double rate, LeafModels& models) {
  LeafModel& model = models.leaves[it.leaf];
  const auto seconds = [&](double time) {
    return static_cast<std::int64_t>(std::ceil(time * rate));
  };
  const auto ends_after = [&](std::int64_t ticks) { model.least_ticks = model.most_ticks = ticks; };
  const std::int64_t latest = model.most_ticks != 0 ? model.most_ticks : model.least_ticks;
  model.fact = kNoFact;
  model.results = {.success = false, .failure = false, .skipped = false, .fault = false};
  switch (it.failure) {
    case LeafFailure::AtOnce:
      model.results.failure = true;
      return ends_after(1);
    case LeafFailure::Late:
      model.results.failure = true;
      return ends_after(std::max(latest, seconds(1)));
    case LeafFailure::NeverEnds:
      model.ends = false;
      model.most_ticks = 0;
      return;
    case LeafFailure::Fault:
      model.results.fault = true;
      return ends_after(1);
    case LeafFailure::Slow:
      model.results.success = true;
      return ends_after(latest + seconds(kSlowSeconds));
    case LeafFailure::NoProgress:
      model.results.success = true;
      model.finishes_full = false;
      model.least_step = model.most_step = 0;
  }
}

class FailureTable {
 public:
  FailureTable(const Tree& tree, const LeafModels& models, std::span<const Property> properties,
               const FailureTableOptions& options)
      : tree_(tree),
        nominal_(nominal_models(tree, models)),
        properties_(properties),
        options_(options),
        usual_(search(tree, nominal_, properties, options.rate, limits())) {}

  std::vector<FailureRow> rows() {
    std::vector<FailureCase> singles;
    for (std::uint32_t leaf = 0; leaf < tree_.leaves.size(); ++leaf) {
      for (const auto how : {LeafFailure::AtOnce, LeafFailure::Late, LeafFailure::NeverEnds,
                             LeafFailure::Fault, LeafFailure::Slow, LeafFailure::NoProgress}) {
        if (can_fail_so(tree_, nominal_.leaves[leaf], leaf, how)) singles.push_back({leaf, how});
      }
    }
    std::vector<FailureRow> rows;
    const auto add = [&](std::vector<FailureCase> cases) {
      const auto& stop = options_.limits.stop_signal;
      if (stop == nullptr || stop() == 0) rows.push_back(row(std::move(cases)));
    };
    for (const FailureCase& it : singles) add({it});
    if (!options_.pairs) return rows;
    for (std::size_t i = 0; i < singles.size(); ++i) {
      for (std::size_t j = i + 1; j < singles.size(); ++j)
        if (singles[i].leaf != singles[j].leaf) add({singles[i], singles[j]});
    }
    return rows;
  }

 private:
  SearchLimits limits() const {
    SearchLimits limits = options_.limits;
    limits.symmetry = false;  // each leaf is the one that it is
    return limits;
  }

  FailureRow row(std::vector<FailureCase> cases) const {
    LeafModels models = nominal_;
    for (const FailureCase& it : cases) apply(it, options_.rate, models);
    models.accepted.clear();
    const SearchResult found = search(tree_, models, properties_, options_.rate, limits());
    const Verdict verdict =
        make_verdict(tree_, models, properties_, found, {.rate = options_.rate});
    FailureRow row{std::move(cases)};
    row.is_complete = found.is_complete();
    row.faults = !found.faults.empty();
    row.may_not_end = std::ranges::any_of(verdict.facts, [](const VerdictLine& it) {
      return !it.is_good && (it.name == "can always end" || it.name == "always ends");
    });
    for (const StatusRow& it : kStatuses)
      if (const auto& first = found.results[index_of(it.status)])
        row.results[index_of(it.status)] = first->ticks;
    for (std::size_t i = 0; i < properties_.size(); ++i) {
      if (std::ranges::count(verdict.findings, name_of_finding(properties_[i]), &Finding::name) > 0)
        row.violated.push_back(i);
    }
    row.halted = halted(models, found);
    if (!row.is_complete) return row;  // what a node never does is not known
    row.handled_by = handler(row.cases.front(), found.coverage);
    for (const LeafNode& leaf : tree_.leaves) {
      if (usual_.coverage.was_ticked(leaf.node) && !found.coverage.was_ticked(leaf.node))
        row.not_tried.push_back(leaf.node);
    }
    return row;
  }

  // The lowest node that never fails above one that does.
  std::optional<NodeIndex> handler(const FailureCase& it, const SearchCoverage& coverage) const {
    NodeIndex node = tree_.leaves[it.leaf].node;
    bool is_failed = coverage.has_been(node, Status::Failure);
    while (node != 0) {
      node = tree_.labels[node].parent;
      const bool fails = coverage.has_been(node, Status::Failure);
      if (is_failed && !fails && coverage.has_been(node, Status::Success)) return node;
      is_failed |= fails;
    }
    return std::nullopt;
  }

  // In any tick.
  std::vector<NodeIndex> halted(const LeafModels& models, const SearchResult& found) const {
    std::vector<bool> is_halted(tree_.leaves.size());
    const auto look = [&](const Stepper& stepper) {
      const auto marks = stepper.leaves().marks();
      for (std::uint32_t leaf = 0; leaf < marks.size(); ++leaf) {
        const LeafMark& it = marks[leaf];
        const bool has_result = it.ticked && it.result != Status::Running;
        if (it.touched && it.ended && !it.faulted && !has_result) is_halted[leaf] = true;
      }
      return true;
    };
    Tracer tracer(tree_, models, properties_, options_.rate, found);
    const auto count = std::min<std::size_t>(found.store.size(), kMostStatesToLookAt);
    for (std::size_t state = 0; state < count; ++state)
      tracer.for_each_tick(static_cast<StateId>(state), look);
    std::vector<NodeIndex> all;
    for (std::uint32_t leaf = 0; leaf < is_halted.size(); ++leaf)
      if (is_halted[leaf]) all.push_back(tree_.leaves[leaf].node);
    return all;
  }

  const Tree& tree_;
  const LeafModels nominal_;
  const std::span<const Property> properties_;
  const FailureTableOptions& options_;
  const SearchResult usual_;
};

}  // namespace

std::string_view to_string(LeafFailure failure) {
  switch (failure) {
    case LeafFailure::AtOnce:
      return "fails at once";
    case LeafFailure::Late:
      return "fails late";
    case LeafFailure::NeverEnds:
      return "never ends";
    case LeafFailure::Fault:
      return "fault";
    case LeafFailure::Slow:
      return "5 s late";
    case LeafFailure::NoProgress:
      return "no progress";
  }
  return "";
}

std::vector<FailureRow> failure_table(const Tree& tree, const LeafModels& models,
                                      std::span<const Property> properties,
                                      const FailureTableOptions& options) {
  return FailureTable(tree, models, properties, options).rows();
}

}  // namespace lockstep::host
