#include "leaves/models.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "base/core/any_value.h"
#include "base/core/parameter_value.h"
#include "base/core/progress.h"
#include "base/core/suggest.h"
#include "base/core/wording.h"
#include "engine/synchronized.h"
#include "language/document/reporter.h"
#include "language/expression/reading_uses.h"
#include "leaves/cuts.h"
#include "leaves/declared.h"

namespace lockstep::host {
namespace {

constexpr std::int64_t kNoEnd = 1'000'000'000;
constexpr std::string_view kProgress = "progress";
constexpr std::uint32_t kUsualParts = 10, kMostParts = 1000;
constexpr std::uint64_t kMostOfInterval = 1'000'000;

bool is_whole(double value) {
  return std::abs(value - std::round(value)) < 1e-6;
}

// The fewest parts, of these, of which each delta is a multiple; 0: too many.
std::uint32_t parts_for(const std::vector<double>& deltas, std::uint32_t first = kUsualParts,
                        std::uint32_t further = 1) {
  for (std::uint32_t parts = first; parts <= kMostParts; parts += further) {
    if (std::ranges::all_of(deltas, [&](double it) { return is_whole(it * parts); })) return parts;
  }
  return 0;
}

class ModelMaker {
 public:
  ModelMaker(const Tree& tree, const LeafFile* file, Diagnostics& diagnostics,
             std::vector<NodeProblem>& problems, const Observed& observed, Declared declared,
             const GivenOutputs& outputs)
      : tree_(tree),
        file_(file),
        diagnostics_(diagnostics),
        problems_(problems),
        observed_(observed),
        declared_(declared),
        outputs_(outputs) {}

  LeafModels make() {
    make_general();
    if (declared_ == Declared::Counts) apply_declared();
    if (file_ != nullptr) {
      models_.rate = file_->rate;
      models_.tree_ends = file_->tree_ends;
      models_.accepted = file_->accepted;
      for (const FactRow& it : file_->facts) {
        models_.facts.push_back({it.name, it.changes, it.starts, {}, it.place});
        if (it.chance) models_.facts.back().chances = {*it.chance, 1 - *it.chance};
      }
      for (const LeafRow& row : file_->leaves) apply(row);
    }
    slow_down();
    models_.entries = entries_of_engine(tree_);
    for (const std::uint32_t slot : observed_.entries) models_.entries[slot] = true;
    add_missing_outputs();
    find_levels();
    list_declared();
    for (std::size_t i = 0; i < models_.leaves.size(); ++i) {
      const LeafModel& model = models_.leaves[i];
      models_.unstated_results += !states_result_[i] && model.fact == kNoFact;
      models_.unstated_steps += !states_step_[i] && model.levels.size() > 1;
      models_.unstated_writes += model.writes == Writes::InAnyTick && !model.outputs.empty();
    }
    return std::move(models_);
  }

 private:
  const NodeType& type_of(std::size_t leaf) const { return *tree_.leaves[leaf].type; }
  const Reporter& report() {
    if (!report_) report_.emplace(file_->sources, diagnostics_);
    return *report_;
  }

  void make_general() {
    ways_.resize(tree_.leaves.size());
    models_.said.resize(tree_.leaves.size());
    said_.resize(tree_.leaves.size());
    states_result_.resize(tree_.leaves.size());
    states_step_.resize(tree_.leaves.size());
    for (std::size_t i = 0; i < tree_.leaves.size(); ++i) {
      const NodeType& type = type_of(i);
      LeafModel& model = models_.leaves.emplace_back();
      model.node = tree_.leaves[i].node;
      model.can_run = type.can_run;
      model.answers_late = type.answers_late && type.can_run;
      model.has_progress = type.has_progress && type.category == NodeCategory::Action;
      model.most_step = kNoEnd;
      if (type.category == NodeCategory::Control || type.category == NodeCategory::Decorator) {
        problems_.push_back({model.node,
                             fmt::format("'{}' is a {} of plugin '{}': what it does with its "
                                         "children is not known",
                                         type.id, to_string(type.category), type.plugin),
                             "use nodes of the language here"});
      }
    }
  }

  // --- what plugins declare ----------------------------------------------------------------------

  void apply_declared() {
    for (std::size_t leaf = 0; leaf < tree_.leaves.size(); ++leaf) {
      said_[leaf] = declared_behavior(type_of(leaf));
      Behavior behavior;
      for (const Statement& it : said_[leaf]) add_statement(it.word, it.value, behavior);
      apply(behavior, {SaidBy::Who::Plugin}, leaf);
    }
  }

  // The statements of the plugin that the row replaces no longer count. A step in other parts than
  // the row's is none.
  void replace_declared(const LeafRow& row, std::size_t leaf) {
    std::vector<Statement>& said = said_[leaf];
    if (said.empty()) return;
    LeafModel& model = models_.leaves[leaf];
    const auto forget = [&](std::string_view word) {
      return std::erase_if(said, [&](const auto& it) { return it.word == word; }) != 0;
    };
    std::erase_if(said, [&](const auto& it) { return host::says(row, it.word); });
    if (row.fact && forget("result")) model.results = {};
    auto& by = models_.said[leaf];
    if (!row.progress) return;
    if (forget("step")) {
      states_step_[leaf] = false;
      model.least_step = 0;
      model.most_step = kNoEnd;
      by[static_cast<std::size_t>(Assumption::Step)] = {};
    }
    if (forget("held")) model.least_drift = model.most_drift = 0;
  }

  void list_declared() {
    std::map<std::string_view, std::string> lines;  // by type
    for (std::size_t leaf = 0; leaf < said_.size(); ++leaf) {
      std::string& line = lines[type_of(leaf).id];
      for (const Statement& it : said_[leaf]) {
        const std::string text = fmt::format(" {}=\"{}\"", it.word, it.value);
        if (line.find(text) == std::string::npos) line += text;
      }
      if (line.empty()) lines.erase(type_of(leaf).id);
    }
    for (const auto& [id, line] : lines) {
      const auto leaf = std::ranges::find(
          tree_.leaves, id, [](const LeafNode& it) { return std::string_view(it.type->id); });
      models_.declared.push_back(
          fmt::format("{} behaves as plugin '{}' declares:{}", id, leaf->type->plugin, line));
    }
  }

  // --- a row of the file -------------------------------------------------------------------------

  void apply(const LeafRow& row) {
    const auto leaves = leaves_of(row);
    if (leaves.empty()) return tell_no_match(row);
    for (const std::size_t leaf : leaves) apply(row, leaf);
  }

  std::vector<std::size_t> leaves_of(const LeafRow& row) const {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < tree_.leaves.size(); ++i) {
      const bool fits = row.path.empty() ? type_of(i).id == row.of
                                         : matches(row.path, tree_.path(tree_.leaves[i].node));
      if (fits) found.push_back(i);
    }
    return found;
  }

  void tell_no_match(const LeafRow& row) {
    std::vector<std::string> names;
    for (const LeafNode& leaf : tree_.leaves) {
      names.push_back(row.path.empty() ? std::string(leaf.type->id) : tree_.path(leaf.node));
    }
    std::ranges::sort(names);
    names.erase(std::unique(names.begin(), names.end()), names.end());
    const std::vector<std::string_view> known(names.begin(), names.end());
    const std::string& given = row.path.empty() ? row.of : row.path;
    report().at_value("unknown-leaf"_code, row.place,
                      row.path.empty()
                          ? fmt::format("the tree has no leaf of type '{}'", brief(given))
                          : fmt::format("no leaf has the path '{}'", brief(given)),
                      suggest_path(given, known, "its leaves"));
  }

  void apply(const LeafRow& row, std::size_t leaf) {
    replace_declared(row, leaf);
    const SaidBy by{SaidBy::Who::Row, row.place};
    apply(row, by, leaf);
    LeafModel& model = models_.leaves[leaf];
    if (row.fact) {
      says(leaf, Assumption::Fact, by);
      model.fact = fact(*row.fact);
      if (!row.results) model.results.chances = {};
    }
    if (model.fact != kNoFact && model.results.has_chances() &&
        told_.insert(row.place.byte).second) {
      report().at("bad-leaf-model"_code, row.place,
                  "the result is a fact, so its chances have no effect",
                  "give them to the fact: <fact name=\"…\" chance=\"0.7\"/>");
    }
    for (const LeafRow::Named& it : row.sets) add_set(model, it, false);
    for (const LeafRow::Named& it : row.sets_on_failure) add_set(model, it, true);
    if (!row.after_cut.empty()) model.after_cut = row.after_cut;
  }

  void says(std::size_t leaf, Assumption what, const SaidBy& by) {
    models_.said[leaf][static_cast<std::size_t>(what)] = by;
  }

  void apply(const Behavior& row, const SaidBy& by, std::size_t leaf) {
    LeafModel& model = models_.leaves[leaf];
    const auto note = [&](bool is_said, Assumption what) {
      if (is_said) says(leaf, what, by);
    };
    note(row.results.has_value(), Assumption::Result);
    note(row.ticks.has_value(), Assumption::Ticks);
    note(row.step.has_value(), Assumption::Step);
    note(row.finishes_full.has_value(), Assumption::Finish);
    note(row.held.has_value(), Assumption::Held);
    note(row.writes.has_value(), Assumption::Writes);
    note(!row.outputs.empty(), Assumption::Outputs);
    if (row.results) {
      model.results = *row.results;
      states_result_[leaf] = true;
    }
    if (row.ticks) {
      model.least_ticks = row.ticks->least;
      model.most_ticks = row.ticks->most.value_or(0);
    }
    if (row.ends) model.ends = *row.ends;
    if (row.progress) ways_[leaf] = {*row.progress, by.place};
    if (row.step) {
      states_step_[leaf] = true;
      model.least_step = row.step->least;
      model.most_step = row.step->most.value_or(kNoEnd);
    }
    if (row.finishes_full) model.finishes_full = *row.finishes_full;
    if (row.held) {
      model.least_drift = row.held->least;
      model.most_drift = row.held->most.value_or(0);
    }
    if (row.writes) model.writes = *row.writes;
    for (const Behavior::Named& it : row.outputs) add_output(leaf, it);
  }

  std::uint32_t fact(const LeafRow::Named& named) {
    const auto it = std::ranges::find(models_.facts, named.name, &Fact::name);
    if (it != models_.facts.end()) return static_cast<std::uint32_t>(it - models_.facts.begin());
    std::vector<std::string_view> names;
    for (const Fact& known : models_.facts) names.push_back(known.name);
    if (told_.insert(named.place.byte).second) {
      report().at_value(
          "unknown-fact"_code, named.place, fmt::format("unknown fact '{}'", brief(named.name)),
          names.empty() ? fmt::format("declare it: <fact name=\"{}\"/>", brief(named.name))
                        : suggest(named.name, names, "facts"));
    }
    return kNoFact;
  }

  void add_set(LeafModel& model, const LeafRow::Named& named, bool by_failure) {
    const std::uint32_t which = fact(named);
    if (which != kNoFact) model.sets.push_back({which, named.text == "true", by_failure});
  }

  void add_output(std::size_t leaf, const LeafRow::Named& named) {
    const NodeType& type = type_of(leaf);
    std::vector<std::string_view> known;
    for (const Parameter& it : type.parameters) {
      if (it.direction != Direction::Input) known.push_back(it.name);
    }
    const auto parameter = std::ranges::find(type.parameters, named.name, &Parameter::name);
    if (parameter == type.parameters.end() || parameter->direction == Direction::Input) {
      report().at("unknown-port"_code, named.place,
                  fmt::format("'{}' has no output '{}'", type.id, brief(named.name)),
                  suggest(named.name, known, "its outputs"));
      return;
    }
    const auto port = static_cast<std::uint32_t>(parameter - type.parameters.begin());
    const std::uint32_t slot = tree_.ports[tree_.leaves[leaf].first_port + port].slot;
    LeafModel::Output output{port, slot, values_of(*parameter, named)};
    if (slot == PortBinding::kUnbound || output.values.empty()) return;
    std::erase_if(models_.leaves[leaf].outputs, [&](const auto& it) { return it.port == port; });
    models_.leaves[leaf].outputs.push_back(std::move(output));
  }

  // "0..1024", of whole numbers.
  static bool add_interval(ValueType type, std::string_view text, std::vector<Value>& values) {
    const auto dots = text.find("..");
    if (type != ValueType::Int || dots == std::string_view::npos) return false;
    const auto first = parse_int(text.substr(0, dots)), last = parse_int(text.substr(dots + 2));
    if (!first || !last || *first > *last) return false;
    // The difference may be too large for an int.
    if (static_cast<std::uint64_t>(*last) - static_cast<std::uint64_t>(*first) >= kMostOfInterval) {
      return false;
    }
    for (std::int64_t it = *first; it <= *last; ++it) values.emplace_back(it);
    return true;
  }

  std::vector<Value> values_of(const Parameter& parameter, const LeafRow::Named& named) {
    std::vector<Value> values;
    std::string_view rest = named.text;
    while (true) {
      const std::string_view part = rest.substr(0, rest.find('|'));
      const bool is_interval = add_interval(parameter.type, part, values);
      const std::optional<Value> value =
          is_interval ? std::nullopt
                      : value_from_outside(parameter.is_generic, parameter.type, std::string(part));
      if (!value && !is_interval) {
        report().at_value("bad-value"_code, named.place,
                          fmt::format("'{}' is not a value of '{}'", brief(part), parameter.name),
                          fmt::format("expected {}", expected_text(parameter.type)));
        return {};
      }
      if (!is_interval) values.push_back(*value);
      if (part.size() == rest.size()) return values;
      rest.remove_prefix(part.size() + 1);
    }
  }

  // --- what nothing is said of -------------------------------------------------------------------

  // A model is of full speed. Slowed, a leaf may make less progress in a tick, and take more ticks.
  // Then it may be between the parts of its grid: a third of a step is none of them.
  void slow_down() {
    for (std::size_t leaf = 0; leaf < tree_.leaves.size(); ++leaf) {
      LeafModel& model = models_.leaves[leaf];
      Way& way = ways_[leaf];
      const bool is_bounded = model.least_step > 0 || model.most_ticks > 0 || way.is_grid();
      if (!tree_.leaves[leaf].is_slowed || !is_bounded) continue;
      way.is_left = way.is_grid();
      for (std::int64_t* it : {&model.least_step, &model.least_drift})
        *it = std::min<std::int64_t>(*it, 0);
      for (std::int64_t* it : {&model.most_step, &model.most_drift})
        *it = std::max<std::int64_t>(*it, 0);
      model.most_ticks = 0;
      ++models_.slowed;
    }
  }

  // An output that only leaves read does not matter. A bool may be both.
  void add_missing_outputs() {
    const std::vector<bool>& matters = models_.entries;
    for (std::size_t leaf = 0; leaf < tree_.leaves.size(); ++leaf) {
      const NodeType& type = type_of(leaf);
      LeafModel& model = models_.leaves[leaf];
      for (std::uint32_t port = 0; port < type.parameters.size(); ++port) {
        if (type.parameters[port].direction == Direction::Input) continue;
        const std::uint32_t slot = tree_.ports[tree_.leaves[leaf].first_port + port].slot;
        if (slot == PortBinding::kUnbound) continue;
        if (!matters[slot] && !is_refused(slot, type.parameters[port])) continue;
        if (std::ranges::find(model.outputs, port, &LeafModel::Output::port) !=
            model.outputs.end()) {
          continue;
        }
        if (auto value = given(type, type.parameters[port])) {
          models_.declared.push_back(fmt::format("'{}' writes {} to '{}'", type.id,
                                                 brief(to_text(*value)),
                                                 type.parameters[port].name));
          model.outputs.push_back({port, slot, {*std::move(value)}});
          continue;
        }
        if (type.parameters[port].type == ValueType::Bool) {
          model.outputs.push_back({port, slot, {Value(false), Value(true)}});
          continue;
        }
        if (!matters[slot]) {
          model.outputs.push_back({port, slot, {sample_value(type.parameters[port])}});
          continue;
        }
        problems_.push_back(
            {model.node,
             fmt::format("'{}' writes the entry '{}', which the tree or a property reads, and "
                         "nothing declares which values",
                         type.id, tree_.slots[slot].name),
             fmt::format("declare them in the leaf model: <leaf of=\"{}\" out.{}=\"…|…\"/>",
                         type.id, type.parameters[port].name)});
      }
      std::erase_if(model.outputs, [&](const auto& it) {
        return !matters[it.slot] && !is_refused(it.slot, type.parameters[it.port]);
      });
    }
  }

  // Whether the entry takes no value of the port, so that writing it is a fault: in a tree for
  // BehaviorTree.CPP, one that began with a text.
  bool is_refused(std::uint32_t slot, const Parameter& port) const {
    const Slot& entry = tree_.slots[slot];
    const bool has_text = entry.typing != Typing::Any && entry.type == ValueType::String &&
                          std::holds_alternative<std::string>(entry.initial);
    return has_text && !port.is_generic && port.type != ValueType::String &&
           port.type != ValueType::Object;
  }

  std::optional<Value> given(const NodeType& type, const Parameter& port) const {
    auto it = outputs_.find(fmt::format("{}.{}", type.id, port.name));
    if (it == outputs_.end()) it = outputs_.find(port.name);
    if (it == outputs_.end()) return std::nullopt;
    return value_from_outside(port.is_generic, port.type, it->second);
  }

  // --- progress ----------------------------------------------------------------------------------

  // The entries whose values are known: those that only leaves write.
  BarriersOfEntries barriers_of_entries() const {
    BarriersOfEntries known;
    for (const BoundNode& bound : tree_.bound) {
      if (synchronization(tree_.nodes[bound.node]) != Synchronization::Absolute) continue;
      const std::uint32_t slot = tree_.ports[bound.first_port].slot;
      if (slot == PortBinding::kUnbound || is_in_script(slot)) continue;
      std::vector<double>& all = known[slot];
      add(tree_.slots[slot].initial, all);
      for (const auto& [written, value] : observed_.written) {
        if (written == slot) add(value, all);
      }
      for (const LeafModel& model : models_.leaves) {
        for (const auto& output : model.outputs) {
          if (output.slot != slot) continue;
          for (const Value& value : output.values) add(value, all);
        }
      }
    }
    return known;
  }

  static void add(const Value& value, std::vector<double>& all) {
    const auto* list = std::get_if<std::vector<double>>(&value);
    if (list != nullptr) all.insert(all.end(), list->begin(), list->end());
  }

  bool is_in_script(std::uint32_t slot) const {
    return std::ranges::any_of(tree_.scripts, [&](const Script& it) {
      return std::ranges::find(it.slots, slot) != it.slots.end();
    });
  }

  std::vector<Observed::Progress> compared_in_scripts() const {
    std::vector<Observed::Progress> all;
    for (const Script& it : tree_.scripts) {
      if (it.readings.empty()) continue;
      for (const ProgressUse& use : progress_uses(*it.code)) {
        const NodeIndex node = tree_.readings[it.readings[use.reading]].node;
        if (use.constant) all.push_back({node, *use.constant});
      }
    }
    return all;
  }

  void find_levels() {
    const BarriersOfEntries barriers = barriers_of_entries();
    std::vector<Observed::Progress> compared = compared_in_scripts();
    const std::vector<Cuts> cuts = cuts_of(tree_, barriers, compared);
    compared.insert(compared.end(), observed_.progress.begin(), observed_.progress.end());
    const std::vector<Cuts> all_cuts = cuts_of(tree_, barriers, compared);
    for (std::size_t leaf = 0; leaf < models_.leaves.size(); ++leaf) {
      LeafModel& model = models_.leaves[leaf];
      const bool is_on_grid = ways_[leaf].is_grid() && !ways_[leaf].is_left;
      Cuts own = cuts[model.node];
      own.is_unknown = all_cuts[model.node].is_unknown;
      find_levels(leaf, own);
      const std::vector<double> steps = model.levels;
      if (model.has_progress && !is_on_grid) {
        for (const double level : all_cuts[model.node].levels()) add_level(model, level);
      }
      count_steps(model, steps, ways_[leaf].is_left);
    }
  }

  // What a property compares progress with is seen, but makes no step smaller: a step may end there
  // in place of where it would. Of a leaf between the parts of its grid, a step is as long as that
  // wherever it begins: a level is as far as the part that it lies in.
  static void count_steps(LeafModel& model, const std::vector<double>& steps, bool is_left) {
    const auto steps_to = [&](double level) {
      return static_cast<std::int32_t>(std::ranges::lower_bound(steps, level - kProgressEpsilon) -
                                       steps.begin());
    };
    const auto part_with = [&](double level) {
      return static_cast<std::int32_t>(std::ranges::upper_bound(steps, level + kProgressEpsilon) -
                                       steps.begin()) -
             1;
    };
    model.steps.clear();
    for (const double level : model.levels)
      model.steps.push_back(is_left ? part_with(level) : steps_to(level));
    model.goal = steps_to(1);
    model.last_step = static_cast<std::int32_t>(steps.size()) - 1;
  }

  void find_levels(std::size_t leaf, const Cuts& cuts) {
    LeafModel& model = models_.leaves[leaf];
    auto [way, place, is_left] = ways_[leaf];
    using Kind = ProgressWay::Kind;
    if (way && way->kind == Kind::None) model.has_progress = false;
    if (!model.has_progress) return;
    const bool wants_grid = !cuts.deltas.empty() || cuts.is_unknown;
    if (is_left) return find_levels_between(way->parts, wants_grid, cuts.deltas, model);
    const bool is_declared =
        std::ranges::any_of(said_[leaf], [](const auto& it) { return it.word == kProgress; });
    if (is_declared && wants_grid && way->kind == Kind::Cuts) way.reset();
    if (way && way->kind == Kind::Grid) model.parts = way->parts;
    if (way && way->kind == Kind::Cuts && wants_grid) {
      report().at("inexact-progress"_code, place,
                  "its progress is compared with a distance: no set of cuts is exact",
                  fmt::format("write progress=\"grid:{}\"", parts_for(cuts.deltas)));
    }
    if (!way && wants_grid) model.parts = parts_for(cuts.deltas);
    if (wants_grid && model.parts == 0) model.parts = kUsualParts;
    if (way && way->kind == Kind::Grid) {
      is_declared ? check_declared_parts(model.node, *way, cuts.deltas)
                  : check_parts(*way, place, cuts.deltas);
    }
    for (std::uint32_t part = 1; part <= model.parts; ++part) {
      add_level(model, static_cast<double>(part) / model.parts);
    }
    if (way && way->kind == Kind::Grid) return;
    for (const double level : cuts.levels()) add_level(model, level);
  }

  // Of a leaf that may be between the parts of its grid: a part is a region, from which a step
  // comes to as many regions as it is long. Where a distance counts, no regions are exact: it is at
  // parts of which its own parts and the distance are multiples.
  static void find_levels_between(std::uint32_t own, bool wants_grid,
                                  const std::vector<double>& deltas, LeafModel& model) {
    const std::uint32_t parts = wants_grid ? std::max(own, parts_for(deltas, own, own)) : own;
    if (wants_grid) model.parts = parts;
    for (std::uint32_t part = 1; part <= parts; ++part) {
      add_level(model, static_cast<double>(part) / parts);
    }
    for (std::int64_t* it :
         {&model.least_step, &model.most_step, &model.least_drift, &model.most_drift}) {
      if (std::abs(*it) < kNoEnd) *it *= parts / own;
    }
  }

  static void add_level(LeafModel& model, double value) {
    const auto at = std::ranges::lower_bound(model.levels, value - kProgressEpsilon);
    if (at == model.levels.end() || *at > value + kProgressEpsilon) model.levels.insert(at, value);
  }

  void check_parts(const ProgressWay& way, Place place, const std::vector<double>& deltas) {
    for (const double delta : deltas) {
      if (is_whole(delta * way.parts)) continue;
      report().at("inexact-progress"_code, place,
                  fmt::format("delta {} is not a multiple of 1/{}", delta, way.parts),
                  fmt::format("write progress=\"grid:{}\"", parts_for(deltas)));
    }
  }

  void check_declared_parts(NodeIndex node, const ProgressWay& way,
                            const std::vector<double>& deltas) {
    for (const double delta : deltas) {
      if (is_whole(delta * way.parts)) continue;
      problems_.push_back(
          {node,
           fmt::format("its plugin declares progress in parts of 1/{}, of which the delta {} is "
                       "not a multiple",
                       way.parts, delta),
           fmt::format("write in the leaf model: progress=\"grid:{}\"", parts_for(deltas))});
    }
  }

  struct Way {
    std::optional<ProgressWay> way;
    Place place = {};
    bool is_left = false;  // the leaf may be between the parts of the grid

    bool is_grid() const { return way && way->kind == ProgressWay::Kind::Grid; }
  };

  const Tree& tree_;
  const LeafFile* const file_;
  Diagnostics& diagnostics_;
  std::vector<NodeProblem>& problems_;
  const Observed& observed_;
  const Declared declared_;
  const GivenOutputs& outputs_;
  std::vector<std::vector<Statement>> said_;  // of each leaf, by its plugin, what counts
  std::optional<Reporter> report_;
  std::vector<Way> ways_;                          // of each leaf
  std::vector<bool> states_result_, states_step_;  // of each leaf: the leaf model or its plugin
  std::set<std::uint32_t> told_;
  LeafModels models_;
};

}  // namespace

std::size_t LeafModel::level_of(double progress) const {
  const auto behind = std::ranges::upper_bound(levels, progress + kProgressEpsilon);
  return behind == levels.begin() ? 0 : static_cast<std::size_t>(behind - levels.begin()) - 1;
}

bool matches(std::string_view pattern, std::string_view path) {
  const auto star = pattern.find('*');
  if (star == std::string_view::npos) return pattern == path;
  if (!path.starts_with(pattern.substr(0, star))) return false;
  path.remove_prefix(star);
  pattern.remove_prefix(star + 1);
  if (pattern.find('*') == std::string_view::npos) return path.ends_with(pattern);
  for (std::size_t at = 0; at <= path.size(); ++at) {
    if (matches(pattern, path.substr(at))) return true;
  }
  return false;
}

std::vector<bool> entries_of_engine(const Tree& tree) {
  std::vector<bool> used(tree.slots.size());
  const auto add_ports = [&](std::uint32_t first, const NodeType& type) {
    for (const Parameter& parameter : type.parameters) {
      const std::uint32_t slot = tree.ports[first++].slot;
      const bool is_read = parameter.direction != Direction::Output;
      if (is_read && slot != PortBinding::kUnbound) used[slot] = true;
    }
  };
  for (const Script& script : tree.scripts) {
    for (const std::uint32_t slot : script.slots) used[slot] = true;
  }
  for (const BoundNode& bound : tree.bound) {
    add_ports(bound.first_port, bound.kind->type);
  }
  for (NodeIndex node = 0; node < tree.nodes.size(); ++node) {
    const NodeType& type = *tree.labels[node].type;
    if (type.reads_ports && type.leaf == nullptr && type.mock == nullptr) {
      add_ports(tree.nodes[node].params, type);
    }
  }
  return used;
}

void allow_cuts(const ProcessCuts& cuts, const Tree& tree, LeafModels& models) {
  models.cuts = cuts;
  if (cuts.most == 0) {
    for (LeafModel& it : models.leaves) it.after_cut.clear();  // leaves may be equal without it
    return;
  }
  for (std::size_t i = 0; i < models.leaves.size(); ++i) {
    std::vector<AfterCut>& may = models.leaves[i].after_cut;
    if (!may.empty()) continue;
    const AfterCut otherwise = tree.leaves[i].at_cut.unasked(cuts.otherwise);
    if (!tree.leaves[i].type->can_be_restored) {
      may = {otherwise};
      continue;
    }
    may = {AfterCut::StartsAgain, AfterCut::Continues, AfterCut::Failure};
    if (otherwise == AfterCut::Success) may.push_back(otherwise);
  }
}

LeafModels make_models(const Tree& tree, const LeafFile* file, Diagnostics& diagnostics,
                       std::vector<NodeProblem>& problems, const Observed& observed,
                       Declared declared, const GivenOutputs& outputs) {
  return ModelMaker(tree, file, diagnostics, problems, observed, declared, outputs).make();
}

}  // namespace lockstep::host
