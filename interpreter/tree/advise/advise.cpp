#include "tree/advise/advise.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <functional>
#include <set>
#include <span>

#include "base/core/audience.h"
#include "base/core/pre_order.h"
#include "base/core/suggest.h"
#include "base/core/wording.h"
#include "language/expression/evaluator.h"
#include "language/expression/operator_words.h"
#include "language/expression/reading_uses.h"
#include "tree/types/script_types.h"

namespace lockstep::host {
namespace {

constexpr int kMostTold = 10;  // of a node; the first few show what is meant

class Adviser {
 public:
  Adviser(const Definition& definition, const Reporter& report)
      : definition_(definition), report_(report) {}

  void advise() {
    for (std::uint32_t node = 0; node < definition_.nodes.size(); ++node) {
      const NodeType& type = *at(node).type;
      if (at(node).children > 1) namesakes(node);
      if (definition_.forgets(at(node))) {
        if (conduct_.empty()) conduct_ = conducts();
        type.goes_on_after != Status::Idle ? restarts(node) : restarts_completed(node);
      }
      if (type.is_reactive) {
        if (conduct_.empty()) conduct_ = conducts();
        restarts(node);
      }
      if (!compares_progress(type.synchronization)) continue;
      for (const std::uint32_t child : children_in(definition_.nodes, node)) {
        without_progress(child, node);
      }
    }
    for (const DefinitionGroup& group : definition_.groups) {
      if (!compares_progress(at(group.node).type->synchronization)) continue;
      for (const std::uint32_t member : group.members) without_progress(member, group.node);
    }
    assigning_conditions();
    percents();
    if (!definition_.boards.empty()) return;  // any entry may be made while the tree runs
    unwritten_entries();
    missing_names();
    if (!definition_.shares_entries) useless_values();
  }

 private:
  const DefinitionNode& at(std::uint32_t node) const { return definition_.nodes[node]; }

  void add(MessageCode code, std::uint32_t node, Severity severity, std::string message,
           std::string hint) const {
    report_.at(code, at(node).place, std::move(message), std::move(hint), severity);
  }

  // The properties of a node, or of all children of a node together.
  struct Conduct {
    bool has_action : 1 = false;
    bool can_run : 1 = false;  // return Running
    // Ticking it again after that result does work again.
    bool again_after_success : 1 = false;
    bool again_after_failure : 1 = false;

    bool again_after(Status result) const {
      return result == Status::Success ? again_after_success : again_after_failure;
    }
    void add(Conduct child) {
      has_action |= child.has_action;
      can_run |= child.can_run;
      again_after_success |= child.again_after_success;
      again_after_failure |= child.again_after_failure;
    }
  };

  std::vector<Conduct> conducts() const {
    std::vector<Conduct> all(definition_.nodes.size());  // at first: of the children
    for (auto node = static_cast<std::uint32_t>(all.size()); node-- > 0;) {
      const bool asks = at(node).children > 0 && !all[node + 1].has_action;
      all[node] = conduct(*at(node).type, all[node], asks);
      if (node > 0) all[at(node).parent].add(all[node]);
    }
    return all;
  }

  // `asks`: its first child is, or is made of, conditions.
  static Conduct conduct(const NodeType& type, Conduct children, bool asks) {
    Conduct it = children;
    it.has_action |= type.category == NodeCategory::Action;
    it.can_run |= type.can_run;
    if (type.category == NodeCategory::Action || type.category == NodeCategory::Control) {
      // The children of a control node need not have returned what it has returned.
      it.again_after_success = it.again_after_failure = type.category == NodeCategory::Action ||
                                                        children.again_after_success ||
                                                        children.again_after_failure;
    }
    if (type.goes_on_after == Status::Success) {
      it.again_after_success = children.again_after_success;
      it.again_after_failure &= !asks;
    } else if (type.goes_on_after == Status::Failure) {
      it.again_after_failure = children.again_after_failure;
      it.again_after_success &= !asks;
    }
    if (type.inverts) {
      it.again_after_success = children.again_after_failure;
      it.again_after_failure = children.again_after_success;
    }
    if (type.again != Again::Acts) it.again_after_success = it.again_after_failure = false;
    return it;
  }

  // Without memory all children up to the one that runs are ticked in every tick.
  void restarts(std::uint32_t node) const {
    int told = 0;
    const NodeType& type = *at(node).type;
    const Status result = type.goes_on_after;
    std::uint32_t earlier = 0;
    for (const std::uint32_t child : children_in(definition_.nodes, node)) {
      if (earlier != 0 && conduct_[child].can_run) {
        if (told++ < kMostTold) add_restart(node, earlier, child);
        earlier = 0;
      }
      // In the other language, an action that ends in its first tick is often a condition.
      const bool matters = !type.is_reactive || conduct_[child].can_run;
      if (conduct_[child].again_after(result) && matters) earlier = child;
    }
  }

  void add_restart(std::uint32_t node, std::uint32_t earlier, std::uint32_t later) const {
    const NodeType& type = *at(node).type;
    const bool is_namesake = at(earlier).name == at(later).name;
    const std::span nodes(definition_.nodes.begin() + earlier, at(earlier).end - earlier);
    const bool is_guess =
        std::ranges::any_of(nodes, [](const DefinitionNode& it) { return it.type->is_guess; });
    const bool tries_others = type.goes_on_after == Status::Failure;
    constexpr auto kDecide = "put a condition before the action that decides whether to try it";
    if (type.is_reactive) {
      return add("restarted"_code, earlier, is_guess ? Severity::Note : Severity::Warning,
                 fmt::format("'{}' is started again in every tick in which {}'{}'{} runs, and "
                             "halts it while it runs itself",
                             brief(at(earlier).name), is_namesake ? "the " : "",
                             brief(at(later).name), is_namesake ? " after it" : ""),
                 is_guess ? "if it is a condition, write <Condition ID=\"…\"/>"
                 : tries_others
                     ? kDecide
                     : "put the action before this node, in a Sequence, or let a condition "
                       "decide");
    }
    add("restarted"_code, earlier, Severity::Warning,
        fmt::format("'{}' is started again in every tick in which {}'{}'{} runs",
                    brief(at(earlier).name), is_namesake ? "the " : "", brief(at(later).name),
                    is_namesake ? " after it" : ""),
        fmt::format("without memory a {} begins with its first child in every tick: give it "
                    "memory=\"true\", or {}",
                    type.id,
                    tries_others
                        ? kDecide
                        : "let the action return Success at once if its goal is already reached"));
  }

  // Without memory a parallel ticks a child that completed again, as long as another one runs.
  void restarts_completed(std::uint32_t node) const {
    int can_run = 0;
    for (const std::uint32_t child : children_in(definition_.nodes, node)) {
      can_run += conduct_[child].can_run;
    }
    int told = 0;
    for (const std::uint32_t child : children_in(definition_.nodes, node)) {
      const Conduct& it = conduct_[child];
      if (!it.has_action || !(it.again_after_success || it.again_after_failure)) continue;
      if (can_run == it.can_run || told++ >= kMostTold) continue;
      add("restarted"_code, child, Severity::Warning,
          fmt::format("'{}' is started again after it has completed, as long as '{}' runs",
                      brief(at(child).name), brief(at(node).name)),
          fmt::format("without memory a {} also ticks children that completed: leave out "
                      "memory=\"false\", or put a RunOnce around the action",
                      at(node).type->id));
    }
  }

  // Names that the tree gives: of a SubTree it may be that of its tree. A node may have thousands
  // of children, so their names are in a table: a place is free, 0, or has the child with its name.
  void namesakes(std::uint32_t node) const {
    std::vector<std::uint32_t> table(std::bit_ceil(2 * std::size_t{at(node).children}));
    for (const std::uint32_t child : children_in(definition_.nodes, node)) {
      const DefinitionNode& it = at(child);
      if (it.name == it.type->id || it.type->category == NodeCategory::SubTree) continue;
      std::size_t place = std::hash<std::string_view>()(it.name) & (table.size() - 1);
      while (table[place] != 0 && at(table[place]).name != it.name) {
        place = (place + 1) & (table.size() - 1);
      }
      if (table[place] != 0) {
        return add(
            "same-name"_code, child, Severity::Note,
            fmt::format("'{}' is also the name of a child before it", brief(it.name)),
            "their paths differ by '#2', which changes with the order: give each its own name");
      }
      table[place] = child;
    }
  }

  // A decorator or SubTree has its child's progress.
  void without_progress(std::uint32_t child, std::uint32_t keeper) const {
    std::uint32_t source = child;
    while (at(source).children == 1 && at(source).type->category != NodeCategory::Control) ++source;
    const NodeType& type = *at(source).type;
    if (type.category != NodeCategory::Action || type.has_progress) return;
    add("no-progress"_code, source, Severity::Note,
        fmt::format("'{}' reports no progress: for '{}' it is at 0 until it succeeds",
                    brief(at(source).name), brief(at(keeper).name)),
        "the others wait for it at the first barrier, or within delta of 0");
  }

  void unwritten_entries() const {
    std::vector<bool> valued(definition_.entries.size());  // has a value at some time
    for (std::size_t i = 0; i < valued.size(); ++i) {
      const BlackboardEntry& it = definition_.entries[i];
      valued[i] = it.is_set_later || !std::holds_alternative<NoValue>(it.initial);
    }
    for_each_port([&](const Parameter& parameter, std::uint32_t entry) {
      if (parameter.writes() && !parameter.own_only) valued[entry] = true;
    });
    for_each_name([&](const BoundScript& script, std::size_t name) {
      if (script.code->uses()[name].is_assigned) valued[script.entries[name]] = true;
    });
    std::vector<bool> told = valued;  // one warning an entry
    // A script fails without a value; a port may have a default.
    if (definition_.rules->strict_types) unwritten_in_scripts(valued, told);
    for_each_port([&](const Parameter& parameter, std::uint32_t entry) {
      const std::string& name = definition_.entries[entry].name;
      if (told[entry] || may_be_empty(parameter, name)) return;
      told[entry] = true;
      if (report_.counted_only(Severity::Warning)) return;
      report_.at_value("unwritten-entry"_code, definition_.entries[entry].first_use,
                       fmt::format("nothing writes '{{{}}}'", brief(name)),
                       unwritten_hint(&parameter, name, definition_.entries[entry].typing, valued),
                       Severity::Warning);
    });
  }

  // The entry of a port of any type, which the tree leaves out: it looks whether there is a value.
  static bool may_be_empty(const Parameter& parameter, std::string_view entry) {
    const std::string_view key = parameter.default_key;
    return parameter.is_generic && !key.empty() && entry.substr(entry.rfind('/') + 1) == key;
  }

  // Entries that a script reads.
  void unwritten_in_scripts(const std::vector<bool>& valued, std::vector<bool>& told) const {
    for_each_name([&](const BoundScript& script, std::size_t use) {
      const std::uint32_t entry = script.entries[use];
      if (told[entry]) return;
      told[entry] = true;
      if (report_.counted_only(Severity::Warning)) return;
      const std::string& name = definition_.entries[entry].name;
      report_.in_value("unwritten-entry"_code, script.place, script.code->uses()[use].offset,
                       fmt::format("nothing writes '{}'", brief(name)),
                       unwritten_hint(nullptr, name, Typing::Strict, valued), Severity::Warning);
    });
  }

  // Scripts that fail for start values that stay as they are: `_skipIf="!wanted"` with
  // wanted="maybe", or with wanted="2".
  void useless_values() const {
    std::vector<bool> changes(definition_.entries.size());
    for_each_port([&](const Parameter& parameter, std::uint32_t entry) {
      if (parameter.writes() && !parameter.own_only) changes[entry] = true;
    });
    for_each_name([&](const BoundScript& script, std::size_t name) {
      if (script.code->uses()[name].is_assigned) changes[script.entries[name]] = true;
    });
    const std::vector<bool> conditions = definition_.conditions();
    std::set<std::pair<std::uint32_t, std::size_t>> told;  // where: a tree may have several places
    for (std::size_t i = 0; i < conditions.size(); ++i) {
      const BoundScript& script = definition_.scripts[i];
      if (script.code == nullptr) continue;
      std::string values;
      const auto wrong = [&](std::size_t offset, std::string message) {
        if (!told.emplace(script.place.byte, offset).second) return;
        report_.in_value("useless-value"_code, script.place, offset, std::move(message), values,
                         Severity::Warning);
      };
      std::vector<Entry> entries;  // those that stay
      for (std::size_t name = 0; name < script.entries.size(); ++name) {
        const BlackboardEntry& it = definition_.entries[script.entries[name]];
        if (changes[script.entries[name]] || std::holds_alternative<NoValue>(it.initial)) continue;
        entries.emplace_back(it.typing, it.type, it.object).assign(it.initial);
        values += fmt::format("{}'{}' is {}", values.empty() ? "" : ", ",
                              script.code->names()[name], Operand::of(it.initial).shown());
      }
      if (fails_by_type(script, changes, conditions[i], wrong)) continue;
      const bool reads_the_run = !script.code->readings().empty();
      if (entries.size() == script.entries.size() && !reads_the_run)
        fails(script, entries, conditions[i], wrong);
    }
  }

  // Whether a part of it takes no text, and gets one that is neither a yes nor a no.
  using Wrong = std::function<void(std::size_t offset, std::string message)>;
  bool fails_by_type(const BoundScript& script, const std::vector<bool>& changes, bool is_condition,
                     const Wrong& wrong) const {
    std::vector<StaticType> types;
    bool has_text = false, fails = false;
    for (const std::uint32_t entry : script.entries) {
      const auto* text = std::get_if<std::string>(&definition_.entries[entry].initial);
      const bool is_text = text != nullptr && !changes[entry] && !parse_flag(*text);
      types.push_back(is_text ? StaticType{ValueType::String} : StaticType{});
      has_text |= is_text;
    }
    if (!has_text) return false;
    const auto also = [&](std::size_t offset, std::string message) {
      fails = true;
      wrong(offset, std::move(message));
    };
    const StaticType value =
        infer_types(*script.code, types, {.assigned = [](auto&&...) {}, .wrong = also});
    if (is_condition && !may_be_yes_or_no(value)) {
      also(0, fmt::format("a condition is {}, not a text", kCondition));
    }
    return fails;
  }

  // A script all of whose entries stay as they are, so it assigns none.
  static void fails(const BoundScript& script, std::vector<Entry>& entries, bool is_condition,
                    const Wrong& wrong) {
    std::vector<Entry*> all;
    for (Entry& entry : entries) all.push_back(&entry);
    Evaluator evaluator;
    const bool works = is_condition ? evaluator.test(*script.code, all) != Truth::Error
                                    : evaluator.execute(*script.code, all);
    if (!works) wrong(0, evaluator.error());
  }

  // '=' where '==' was meant: the value of the condition is that of an assignment.
  void assigning_conditions() const {
    const std::vector<bool> conditions = definition_.conditions();
    for (std::size_t i = 0; i < conditions.size(); ++i) {
      const BoundScript& script = definition_.scripts[i];
      if (!conditions[i] || script.code == nullptr) continue;
      const auto& code = script.code->program().code;
      const std::size_t last = code.size() - 2;  // before the end
      if (code[last].operation != Operation::Store) continue;
      if (script.code->uses()[code[last].argument].is_made) continue;
      if (report_.counted_only(Severity::Warning)) return;
      report_.in_value("assigning-condition"_code, script.place, script.code->offsets()[last],
                       "'=' assigns, and the condition is what was assigned", "'==' compares",
                       Severity::Warning);
    }
  }

  // Progress that is taken for percent: progress(arm) >= 50.
  void percents() const {
    std::set<std::pair<std::uint32_t, std::size_t>> told;  // where: a tree may have several places
    for (const BoundScript& script : definition_.scripts) {
      if (script.code == nullptr || script.code->readings().empty()) continue;
      for (const ProgressUse& use : progress_uses(*script.code)) {
        const Reading& reading = script.code->readings()[use.reading];
        if (!use.constant || *use.constant <= 1) continue;
        if (!told.emplace(script.place.byte, reading.offset).second) continue;
        report_.in_value("progress-range"_code, script.place, reading.offset,
                         fmt::format("{} is compared with {}", shown(reading), *use.constant),
                         "progress is a number from 0 to 1: half of the motion is 0.5",
                         Severity::Warning);
      }
    }
  }

  // Names in scripts that no port declares and nothing makes: each script that needs one fails.
  void missing_names() const {
    std::vector<bool> there(definition_.entries.size());
    for (std::size_t i = 0; i < there.size(); ++i) there[i] = definition_.entries[i].is_present;
    for_each_port([&](const Parameter& parameter, std::uint32_t entry) {
      if (parameter.is_key && !parameter.own_only) there[entry] = true;
    });
    for_each_name([&](const BoundScript& script, std::size_t name) {
      if (script.code->uses()[name].is_made) there[script.entries[name]] = true;
    });
    std::vector<bool> told = there;  // one warning an entry
    for_each_name([&](const BoundScript& script, std::size_t name) {
      const std::uint32_t entry = script.entries[name];
      if (told[entry]) return;
      told[entry] = true;
      if (report_.counted_only(Severity::Warning)) return;
      const std::string& key = definition_.entries[entry].name;
      const std::string_view scope = std::string_view(key).substr(0, key.rfind('/') + 1);
      std::string hint =
          did_you_mean(std::string_view(key).substr(scope.size()), keys_in(scope, there));
      if (hint.empty())
        hint = fmt::format("'{} := …' makes it; so does a port that names it{}",
                           script.code->names()[name],
                           scope.empty() ? "; or " + how_to_give(key) : "");
      report_.in_value("missing-entry"_code, script.place, script.code->uses()[name].offset,
                       fmt::format("nothing makes the entry '{}'", brief(key)), std::move(hint),
                       Severity::Warning);
    });
  }

  // Visits the names in each script whose text is in the tree.
  template <class Visit>
  void for_each_name(Visit visit) const {
    for (const BoundScript& script : definition_.scripts) {
      if (script.code == nullptr) continue;
      for (std::size_t name = 0; name < script.entries.size(); ++name) visit(script, name);
    }
  }

  // The keys of entries in `scope` that have a value at some time.
  std::vector<std::string_view> keys_in(std::string_view scope,
                                        const std::vector<bool>& valued) const {
    std::vector<std::string_view> keys;
    for (std::size_t i = 0; i < valued.size(); ++i) {
      const std::string_view name = definition_.entries[i].name;
      const bool is_inside = name.substr(0, name.rfind('/') + 1) == scope;
      if (valued[i] && is_inside) keys.push_back(name.substr(scope.size()));
    }
    return keys;
  }

  // `parameter`: what reads it; null: a script.
  std::string unwritten_hint(const Parameter* parameter, std::string_view name, Typing typing,
                             const std::vector<bool>& valued) const {
    const std::string_view scope = name.substr(0, name.rfind('/') + 1);
    std::string hint = did_you_mean(name.substr(scope.size()), keys_in(scope, valued));
    if (!hint.empty()) return hint;
    if (name.find_first_of("\":") != name.npos) {
      return fmt::format(
          "what is in braces is the name of an entry; a constant in JSON is written "
          "json:{{{}}}",
          brief(name.substr(scope.size())));
    }
    if (parameter != nullptr && parameter->default_text && typing == Typing::Strict) {
      hint = fmt::format("it stays '{}', the default of '{}'; ", *parameter->default_text,
                         parameter->name);
    }
    if (!scope.empty()) return hint + "give it a value by an attribute of the SubTree";
    return hint + how_to_give(name);
  }

  template <class Visit>
  void for_each_port(Visit visit) const {
    if (definition_.entries.empty()) return;
    for (std::uint32_t node = 0; node < definition_.nodes.size(); ++node) {
      const NodeType& type = *at(node).type;
      for (std::uint32_t i = 0; i < type.parameters.size(); ++i) {
        const Port& port = definition_.ports[at(node).first + i];
        if (port.entry != Port::kNone) visit(type.parameters[i], port.entry);
      }
    }
  }

  const Definition& definition_;
  const Reporter& report_;
  std::vector<Conduct> conduct_;  // of each node; empty: no node was asked for it yet
};

}  // namespace

void advise(const Definition& definition, const Reporter& report) {
  Adviser(definition, report).advise();
}

}  // namespace lockstep::host
