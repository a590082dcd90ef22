#include "verify/fixed_conditions.h"

#include <fmt/format.h>

#include <map>
#include <set>

#include "base/core/language.h"
#include "base/core/wording.h"
#include "engine/blackboard.h"

namespace lockstep::host {
namespace {

constexpr std::uint64_t kMostTicksFromTrap = 50'000;
constexpr std::size_t kMostConditions = 6;

// What a node decides by. It does so for ever if no other status comes.
struct Decider {
  NodeIndex node;
  Status fixed;
  std::string how;  // "always false: {}"
  std::set<std::uint32_t> slots = {};
  std::string fact = {};
  std::vector<std::string> readings = {};
  bool is_ticked = false, has_other = false;
};

class FixedConditions {
 public:
  FixedConditions(const Tree& tree, const LeafModels& models) : tree_(tree) {
    for (NodeIndex node = 0; node < tree.nodes[0].end; ++node) {
      const NodeType& type = *tree.labels[node].type;
      if (type.category == NodeCategory::Condition) add_condition(node, models);
      if (type.category == NodeCategory::Action && type.can_run) add_waiting(node);
    }
    for (const HookedNode& it : tree.hooked) {
      for (const Hook hook : {Hook::SkipIf, Hook::While}) add_hook(it, hook);
    }
  }
  bool empty() const { return deciders_.empty(); }

  void look_at(const Ticker& ticker) {
    for (Decider& it : deciders_) {
      if (!ticker.ticked(it.node)) continue;
      it.is_ticked = true;
      it.has_other = it.has_other || ticker.status(it.node) != it.fixed;
    }
    for (auto& [slot, text] : values_) {
      const Value& value = ticker.blackboard().entries[slot].value();
      const std::string now = std::holds_alternative<NoValue>(value) ? "no value" : to_text(value);
      if (text.empty()) text = now;
      if (text != now) text = kOthers;
    }
  }

  std::vector<std::string> lines(const std::function<std::string(NodeIndex)>& at) const {
    std::vector<std::string> lines;
    for (const Decider& it : deciders_) {
      if (!it.is_ticked || it.has_other || lines.size() == kMostConditions) continue;
      lines.push_back(fmt::format(fmt::runtime(it.how), at(it.node)) + what_it_reads(it));
    }
    return lines;
  }

 private:
  static constexpr const char* kOthers = "\n";  // no text of a value

  void add_condition(NodeIndex node, const LeafModels& models) {
    Decider it{node, Status::Failure, "always false: {}"};
    const NodeType& type = *tree_.labels[node].type;
    if (type.leaf != nullptr) {
      const std::uint32_t leaf = tree_.nodes[node].params;
      const LeafModel& model = models.leaves[leaf];
      if (model.fact != kNoFact) it.fact = models.facts[model.fact].name;
      const std::uint32_t first = tree_.leaves[leaf].first_port;
      for (std::uint32_t i = 0; i < type.parameters.size(); ++i) {
        const std::uint32_t slot = tree_.ports[first + i].slot;
        const bool is_read = type.parameters[i].direction != Direction::Output;
        if (is_read && slot != PortBinding::kUnbound) it.slots.insert(slot);
      }
    } else {
      add_scripts_of(node, it);
    }
    add(std::move(it));
  }

  // An action that runs until its script is true.
  void add_waiting(NodeIndex node) {
    Decider it{node, Status::Running, "waits indefinitely: {}"};
    if (add_scripts_of(node, it)) add(std::move(it));
  }

  // Those that are parameters of a built-in node. False: there are none.
  bool add_scripts_of(NodeIndex node, Decider& it) const {
    const NodeType& type = *tree_.labels[node].type;
    if (type.leaf != nullptr || type.mock != nullptr || type.reads_ports) return false;
    bool has_any = false;
    for (std::uint32_t i = 0; i < type.parameters.size(); ++i) {
      if (!type.parameters[i].is_script) continue;
      const std::int64_t script = tree_.cells[tree_.nodes[node].params + i].integer;
      add_script(static_cast<std::uint32_t>(script), it);
      has_any = true;
    }
    return has_any;
  }

  void add_hook(const HookedNode& hooked, Hook hook) {
    if (hooked.script(hook) == HookedNode::kNoScript) return;
    Decider it{hooked.node, Status::Skipped,
               fmt::format("always skipped: {{}}, by its {}", attribute_of(hook, *tree_.rules))};
    add_script(hooked.script(hook), it);
    add(std::move(it));
  }

  void add_script(std::uint32_t number, Decider& it) const {
    if (number >= tree_.scripts.size() || tree_.scripts[number].code == nullptr) return;
    const Script& script = tree_.scripts[number];
    for (std::size_t i = 0; i < script.slots.size(); ++i) {
      if (script.code->uses()[i].is_read) it.slots.insert(script.slots[i]);
    }
    for (const Reading& reading : script.code->readings()) it.readings.push_back(shown(reading));
  }

  void add(Decider it) {
    for (const std::uint32_t slot : it.slots) values_[slot];
    deciders_.push_back(std::move(it));
  }

  // ", which reads {posed} (false)"
  std::string what_it_reads(const Decider& it) const {
    std::vector<std::string> names = it.readings;
    if (!it.fact.empty()) names.push_back(fmt::format("the fact '{}'", it.fact));
    for (const std::uint32_t slot : it.slots) {
      const std::string& value = values_.at(slot);
      const std::string name = "{" + tree_.slots[slot].name + "}";
      names.push_back(value == kOthers ? name : fmt::format("{} ({})", name, brief(value)));
    }
    return names.empty() ? "" : ", which reads " + joined(names, ", ");
  }

  const Tree& tree_;
  std::vector<Decider> deciders_;
  std::map<std::uint32_t, std::string> values_;  // of slots; "": not seen yet
};

}  // namespace

std::vector<std::string> false_for_ever(const Tree& tree, const LeafModels& models, Tracer& tracer,
                                        const std::vector<bool>& reached,
                                        const std::function<std::string(NodeIndex)>& at,
                                        const std::optional<Nanoseconds>& until) {
  FixedConditions conditions(tree, models);
  if (conditions.empty()) return {};
  std::uint64_t ticks = 0;
  for (StateId state = 0; state < reached.size(); ++state) {
    if (!reached[state]) continue;
    const auto is_over = [&] { return until && monotonic_now() > *until; };
    const bool is_done = tracer.for_each_tick(state, is_over, [&](const Stepper& stepper) {
      conditions.look_at(stepper.ticker());
      return (ticks += stepper.root_ticks()) <= kMostTicksFromTrap;
    });
    if (!is_done) return {};
  }
  return conditions.lines(at);
}

}  // namespace lockstep::host
