#include "scenario/bound_scenario.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/core/any_value.h"
#include "base/core/suggest.h"
#include "base/core/wording.h"
#include "judge/measure/measure_spec.h"
#include "judge/measure/measuring.h"
#include "language/document/reporter.h"
#include "run/shape_of.h"

namespace lockstep::host {
namespace {

using Kind = Expectation::Kind;

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n";
  const auto first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

struct LimitText {
  std::string_view measure, relation, number;
};

// "spread < 0.1": a measure, a relation and a number. Nothing if it is none, as a property.
std::optional<LimitText> split_limit(std::string_view text) {
  const std::string_view name = text.substr(0, text.find_first_of(":[<>=! \t\r\n"));
  if (std::ranges::find(all_measures(), name, &Measure::name) == all_measures().end()) {
    return std::nullopt;
  }
  auto at = text.find_first_of("<>!");
  // A measure may have a '=' in its name, without blanks.
  if (at == std::string_view::npos) at = text.find("==");
  if (at == std::string_view::npos) at = text.find("= ");
  if (at == std::string_view::npos) return LimitText{text, {}, {}};
  const std::size_t size = at + 1 < text.size() && text[at + 1] == '=' ? 2 : 1;
  return LimitText{trimmed(text.substr(0, at)), text.substr(at, size),
                   trimmed(text.substr(at + size))};
}

std::optional<Relation> relation_of(std::string_view text) {
  constexpr std::pair<std::string_view, Relation> kRelations[] = {
      {"==", Relation::Equal},     {"!=", Relation::NotEqual}, {"<", Relation::Less},
      {"<=", Relation::LessEqual}, {">", Relation::Greater},   {">=", Relation::GreaterEqual}};
  for (const auto& [sign, relation] : kRelations) {
    if (sign == text) return relation;
  }
  return std::nullopt;
}

bool is_of_one_run(const Expectation& it) {
  if (it.kind == Kind::Text) return split_limit(trimmed(it.texts[0])).has_value();
  if (it.kind == Kind::Ending) return it.ticks || it.time || !it.node.empty();
  return it.kind != Kind::Order;
}

class ScenarioBinder {
 public:
  ScenarioBinder(const Scenario& scenario, const Sources& sources, const Fixture& fixture,
                 MissingLeaves missing, Diagnostics& diagnostics)
      : scenario_(scenario),
        fixture_(fixture),
        tree_(fixture.tree()),
        missing_(missing),
        diagnostics_(diagnostics),
        report_(sources, diagnostics) {}

  BoundScenario bind(const LeafFile* file) {
    bound_.scenario = &scenario_;
    bound_.rate = scenario_.rate;
    if (file != nullptr && file->rate && !scenario_.is_rate_given) bound_.rate = *file->rate;
    bound_.bindings =
        bind_leaves(scenario_, tree_, fixture_.definition(), file != nullptr, missing_, report_);
    bound_.bindings.scripts.rate = bound_.rate;  // leaves with a time count its ticks
    for (const SetEntry& it : scenario_.changes) add_change(it);
    for (const AnswerEvent& it : scenario_.answers) add_answer(it);
    if (file != nullptr) add_models(*file);
    for (const Expectation& it : scenario_.expectations) add_expectation(it);
    return std::move(bound_);
  }

 private:
  void add_models(const LeafFile& file) {
    std::vector<NodeProblem> problems;
    Observed observed;
    for (const PreparedChange& it : bound_.changes)
      observed.written.emplace_back(it.slot, it.value);
    auto models =
        std::make_shared<LeafModels>(make_models(tree_, &file, diagnostics_, problems, observed));
    const auto& without = bound_.bindings.without_row;
    for (const NodeProblem& it : problems) {
      if (std::ranges::find(without, it.node) == without.end()) continue;
      report_.at_value("bad-scenario"_code, scenario_.leaves_place,
                       fmt::format("'{}': {}", tree_.path(it.node), it.message), it.hint);
    }
    bound_.models = std::move(models);
  }

  void add_answer(const AnswerEvent& answer) {
    const Definition& given = fixture_.definition();
    bool is_there = false;
    for (const NodeIndex node : find_leaves(tree_, "", answer.path)) {
      if (!given.nodes[node].type->asks) continue;
      is_there = true;
      if (!bound_.bindings.real.contains(node)) {
        return report_.at_value(
            "bad-scenario"_code, answer.path_place,
            fmt::format("'{}' has a <leaf> that declares what it does", tree_.path(node)),
            "give it one of both");
      }
      const auto& options =
          std::get<std::vector<std::string>>(*given.constant(given.nodes[node], "options"));
      const auto option = std::ranges::find(options, answer.value);
      if (option == options.end()) {
        const std::vector<std::string_view> known(options.begin(), options.end());
        return report_.at_value(
            "bad-scenario"_code, answer.value_place,
            fmt::format("'{}' is no answer to '{}'", brief(answer.value), tree_.path(node)),
            suggest(answer.value, known, "its answers"));
      }
      bound_.answers.push_back(
          {node, static_cast<std::uint32_t>(option - options.begin()), &answer});
    }
    if (is_there || missing_ == MissingLeaves::AreLeftOut) return;
    report_.at_value("bad-scenario"_code, answer.path_place,
                     fmt::format("no node with the path '{}' asks anything", brief(answer.path)));
  }

  void add_change(const SetEntry& change) {
    const auto slot = std::ranges::find(tree_.slots, change.key, &Slot::name);
    if (slot == tree_.slots.end()) {
      std::vector<std::string_view> known;
      for (const Slot& it : tree_.slots) known.emplace_back(it.name);
      return report_.at_value("unknown-entry"_code, change.key_place,
                              fmt::format("the tree has no entry '{}'", brief(change.key)),
                              suggest(change.key, known, "its entries"));
    }
    std::optional<Value> value =
        value_from_outside(slot->typing == Typing::Any, slot->type, change.value);
    if (!value) {
      return report_.at_value(
          "bad-value"_code, change.value_place,
          fmt::format("'{}' is not a value of '{}'", brief(change.value), change.key),
          fmt::format("expected {}", expected_text(slot->type)));
    }
    const auto place = static_cast<std::uint32_t>(slot - tree_.slots.begin());
    bound_.changes.push_back(
        {place, std::move(*value), change.tick, change.time, change.value_place});
  }

  void add_expectation(const Expectation& it) {
    if (scenario_.is_verified && is_of_one_run(it)) {
      if (it.is_for_all) return;
      return report_.at_value("bad-scenario"_code, it.place,
                              "this is about one run, not about all behaviors",
                              "with verify=\"yes\", expect a result or a property");
    }
    if (it.kind == Kind::Text) {
      if (const auto limit = split_limit(trimmed(it.texts[0]))) {
        add_limit(it, *limit);
      } else if (it.path.empty()) {
        add_property(it, it.texts[0]);
      } else {
        report_.at_value("bad-scenario"_code, it.place,
                         "'path' names the node of a measure, not of a property",
                         "write path=\"both\" with a measure such as spread &lt; 0.1");
      }
    }
    if (it.kind == Kind::Order) add_order(it);
    if (it.kind == Kind::Inputs) add_inputs(it);
    if (it.kind == Kind::Ending && !it.node.empty()) check_node(it);
  }

  void add_property(const Expectation& of, std::string_view text) {
    auto property = Property::parse(text, fixture_.names());
    if (!property) {
      const PropertyError& error = property.error();
      if (of.kind == Kind::Text) {
        report_.in_value("bad-property"_code, of.place, error.offset, error.message, error.hint);
      } else {
        report_.at_value("bad-property"_code, of.place, error.message, error.hint);
      }
      return;
    }
    bound_.properties.push_back({std::move(*property), &of});
  }

  // Each only after the one before it, and the last one at all.
  void add_order(const Expectation& it) {
    for (std::size_t i = 0; i < it.texts.size(); ++i) {
      const std::string_view event = trimmed(it.texts[i]);
      if (i + 1 == it.texts.size()) add_property(it, fmt::format("sometimes ({})", event));
      if (i == 0) continue;
      add_property(it, fmt::format("({}) only after ({})", event, trimmed(it.texts[i - 1])));
    }
  }

  void add_limit(const Expectation& it, const LimitText& text) {
    auto measure = parse_measure(it.path.empty() ? std::string(text.measure)
                                                 : fmt::format("{}:{}", text.measure, it.path));
    const auto relation = relation_of(text.relation);
    const auto number = parse_double(text.number);
    if (!measure) {
      return report_.at_value("bad-scenario"_code, it.place, measure.error().message,
                              measure.error().hint);
    }
    if (!relation || !number) {
      return report_.at_value(
          "bad-scenario"_code, it.place,
          fmt::format("expected a limit of the measure '{}'", text.measure),
          fmt::format("write {} &lt; 0.1; the relations are &lt; &lt;= == != > >=", text.measure));
    }
    const MeasureSpec specs[] = {*measure};
    const Measuring measuring(shape_of(tree_), specs);
    if (!measuring.error().empty())
      return report_.at_value("bad-scenario"_code, it.place, measuring.error());
    if (measuring.columns().empty() && !it.is_for_all) {
      return report_.at_value(
          "bad-scenario"_code, it.place,
          fmt::format("the tree has nothing of which '{}' is a measure", text.measure),
          "expect it of a tree with a parallel");
    }
    bound_.limits.push_back(
        {std::move(*measure), *relation, *number, std::string(trimmed(it.texts[0])), &it});
  }

  void add_inputs(const Expectation& it) {
    const auto leaves = find_leaves(tree_, it.of, it.path);
    if (leaves.empty() && missing_ == MissingLeaves::AreLeftOut) return;
    if (leaves.empty()) {
      const Problem problem = no_such_leaf(tree_, it.of, it.path);
      return report_.at_value("bad-scenario"_code, it.place, problem.message, problem.hint);
    }
    for (const NodeIndex leaf : leaves) {
      if (!bound_.bindings.real.contains(leaf)) continue;
      return report_.at_value(
          "bad-scenario"_code, it.place,
          fmt::format("what '{}' gets is not seen", tree_.path(leaf)),
          "leaves with from=\"plugin\" read their inputs themselves; give it words");
    }
    for (const NamedText& input : it.inputs) add_input(it, input, leaves);
  }

  void add_input(const Expectation& of, const NamedText& input,
                 const std::vector<NodeIndex>& leaves) {
    std::string text = input.text;
    for (const NodeIndex leaf : leaves) {
      const NodeType& type = *tree_.labels[leaf].type;
      const auto port = std::ranges::find(type.parameters, input.name, &Parameter::name);
      if (port == type.parameters.end() || port->direction == Direction::Output) {
        std::vector<std::string_view> known;
        for (const Parameter& it : type.parameters) {
          if (it.direction != Direction::Output) known.push_back(it.name);
        }
        return report_.at("unknown-port"_code, input.place,
                          fmt::format("'{}' has no input '{}'", type.id, brief(input.name)),
                          suggest(input.name, known, "its inputs"));
      }
      if (port->type == ValueType::Object) continue;
      const auto value = parse_value(port->type, input.text);
      if (!value) {
        return report_.at_value(
            "bad-value"_code, input.place,
            fmt::format("'{}' is not a value of the port '{}'", brief(input.text), input.name),
            fmt::format("expected {}", expected_text(port->type)));
      }
      text = to_text(*value);
    }
    bound_.inputs.push_back({leaves, input.name, std::move(text), input.place, &of});
  }

  void check_node(const Expectation& it) const {
    const auto found = find_path(fixture_.names().paths, it.node);
    if (!found)
      report_.at_value("bad-scenario"_code, it.place, found.error().message, found.error().hint);
  }

  const Scenario& scenario_;
  const Fixture& fixture_;
  const Tree& tree_;
  const MissingLeaves missing_;
  Diagnostics& diagnostics_;
  const Reporter report_;
  BoundScenario bound_;
};

}  // namespace

BoundScenario bind_scenario(const Scenario& scenario, const Sources& sources,
                            const Fixture& fixture, const LeafFile* file, MissingLeaves missing,
                            Diagnostics& diagnostics) {
  return ScenarioBinder(scenario, sources, fixture, missing, diagnostics).bind(file);
}

}  // namespace lockstep::host
