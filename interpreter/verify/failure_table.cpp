#include "verify/failure_table.h"

#include <algorithm>
#include <cmath>

#include "verify/trace.h"
#include "verify/verdict.h"

namespace lockstep::host {
namespace {

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
        cases_(all_cases()),
        usual_(search(tree, nominal_, properties, options.rate, limits(end_of_share(0)))) {}

  std::vector<FailureRow> rows() {
    std::vector<FailureRow> rows;
    for (const auto& it : cases_) {
      const auto& stop = options_.limits.stop_signal;
      if (stop == nullptr || stop() == 0) rows.push_back(row(it, end_of_share(rows.size() + 1)));
    }
    return rows;
  }

 private:
  std::vector<std::vector<FailureCase>> all_cases() const {
    std::vector<std::vector<FailureCase>> all;
    for (std::uint32_t leaf = 0; leaf < tree_.leaves.size(); ++leaf) {
      for (const auto how : {LeafFailure::AtOnce, LeafFailure::Late, LeafFailure::NeverEnds,
                             LeafFailure::Fault, LeafFailure::Slow, LeafFailure::NoProgress}) {
        if (can_fail_so(tree_, nominal_.leaves[leaf], leaf, how)) all.push_back({{leaf, how}});
      }
    }
    if (!options_.pairs) return all;
    const std::size_t singles = all.size();
    for (std::size_t i = 0; i < singles; ++i) {
      for (std::size_t j = i + 1; j < singles; ++j) {
        const FailureCase one = all[i].front(), other = all[j].front();
        if (one.leaf != other.leaf) all.push_back({one, other});
      }
    }
    return all;
  }

  // The time that is left is in equal parts of what is left to do: a search without a failure, and
  // one for each row. What one does not need is for those behind it.
  std::optional<Nanoseconds> end_of_share(std::size_t done) const {
    if (!options_.until) return std::nullopt;
    const Nanoseconds now = monotonic_now();
    return now + std::max(Nanoseconds(0), *options_.until - now) /
                     static_cast<std::int64_t>(cases_.size() + 1 - done);
  }

  // The rest of a part is for what looks at the states.
  SearchLimits limits(std::optional<Nanoseconds> until) const {
    constexpr int kOfSearch = 3, kParts = 5;
    SearchLimits limits = options_.limits;
    limits.symmetry = false;  // each leaf is the one that it is
    if (until)
      limits.time = std::max(Nanoseconds(0), *until - monotonic_now()) * kOfSearch / kParts;
    return limits;
  }

  FailureRow row(std::vector<FailureCase> cases, std::optional<Nanoseconds> until) const {
    LeafModels models = nominal_;
    for (const FailureCase& it : cases) apply(it, options_.rate, models);
    models.accepted.clear();
    const SearchResult found = search(tree_, models, properties_, options_.rate, limits(until));
    const Verdict verdict =
        make_verdict(tree_, models, properties_, found, {.rate = options_.rate, .until = until});
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
    row.is_complete &= look_for_halted(models, found, until, row.halted);
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

  // In any tick, or at the end that a fault is. False: there was no time to look at all ticks.
  bool look_for_halted(const LeafModels& models, const SearchResult& found,
                       std::optional<Nanoseconds> until, std::vector<NodeIndex>& halted) const {
    std::vector<bool> is_halted(tree_.leaves.size());
    const auto look = [&](const Stepper& stepper) {
      const auto marks = stepper.leaves().marks();
      const bool ends = stepper.ticker().faulted();
      for (std::uint32_t leaf = 0; leaf < marks.size(); ++leaf) {
        const LeafMark& it = marks[leaf];
        const bool has_result = it.ticked && it.result != Status::Running;
        const bool was_halted = it.touched && it.ended && !has_result;
        const bool runs =
            ends && stepper.ticker().status(tree_.leaves[leaf].node) == Status::Running;
        if ((was_halted || runs) && !it.faulted) is_halted[leaf] = true;
      }
      return true;
    };
    Tracer tracer(tree_, models, properties_, options_.rate, found);
    StateId state = 0;
    const auto gives_up = [&] { return is_over(until); };
    while (state < found.store.size() && tracer.for_each_tick(state, gives_up, look)) ++state;
    for (std::uint32_t leaf = 0; leaf < is_halted.size(); ++leaf)
      if (is_halted[leaf]) halted.push_back(tree_.leaves[leaf].node);
    return state == found.store.size();
  }

  bool is_over(std::optional<Nanoseconds> until) const {
    const auto& stop = options_.limits.stop_signal;
    return (stop != nullptr && stop() != 0) || (until && monotonic_now() >= *until);
  }

  const Tree& tree_;
  const LeafModels nominal_;
  const std::span<const Property> properties_;
  const FailureTableOptions& options_;
  const std::vector<std::vector<FailureCase>> cases_;  // of each row
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
