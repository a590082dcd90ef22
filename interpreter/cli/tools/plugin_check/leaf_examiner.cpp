#include "cli/tools/plugin_check/leaf_examiner.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "base/core/behavior.h"
#include "base/core/element_types.h"
#include "base/core/parameter_value.h"
#include "base/core/progress.h"
#include "base/core/random.h"
#include "base/core/wording.h"
#include "engine/cut.h"
#include "engine/leaf_watch.h"
#include "engine/saved_run.h"
#include "leaves/declared.h"
#include "leaves/plugin/contract/described_types.h"
#include "lockstep/leaf.h"
#include "run/loading/load.h"
#include "run/loading/plugins.h"
#include "run/run.h"
#include "trace/progress_text.h"

namespace lockstep::host {
namespace {

constexpr int kTicks = 20;
constexpr std::uint32_t kMostChildren = 2;
constexpr std::size_t kLong = std::size_t{64} << 10;

// The steps of a scenario.
enum class Do : std::uint8_t { Tick, Pause, Halt, Restart, Slow, Full };

struct Exercise {
  const char* name;
  std::vector<Do> steps;
};

const std::vector<Exercise>& exercises() {
  using enum Do;
  static const std::vector<Exercise> kAll{
      {"is halted after its first tick, and begins again", {Tick, Halt, Tick}},
      {"is halted before it began", {Halt, Tick}},
      {"is halted while it is held", {Tick, Pause, Halt, Tick}},
      {"continues after it was held", {Tick, Pause, Tick, Pause, Tick, Halt}},
      {"begins a run again while it runs", {Tick, Restart, Tick, Tick}},
      {"is destroyed while it is held", {Tick, Pause}},
  };
  return kAll;
}

const Exercise& exercise_of_pace() {
  using enum Do;
  static const Exercise kPace{"moves slower, and as before",
                              {Tick, Slow, Tick, Pause, Slow, Tick, Full, Tick, Slow, Halt, Tick}};
  return kPace;
}

// "" or what it takes up against the contract.
std::string tell_pace(const LeafSlot& leaf, double factor) {
  const double taken = leaf.type->set_pace(leaf.self, factor);
  const bool is_good = taken >= factor - kProgressEpsilon && taken <= 1 + kProgressEpsilon;
  return is_good ? ""
                 : fmt::format("accepts a pace of {:g} in response to {:g}, expected {:g} to 1",
                               taken, factor, factor);
}

// Values at the edges of a type; those that the port refuses are left out.
std::vector<Value> edges(const Parameter& port) {
  using Numbers = std::vector<double>;
  using Wholes = std::vector<std::int64_t>;
  using Texts = std::vector<std::string>;
  constexpr auto kMost = std::numeric_limits<std::int64_t>::max();
  constexpr auto kLeast = std::numeric_limits<std::int64_t>::min();
  std::vector<Value> all;
  if (port.type == ValueType::Bool) all = {true, false};
  if (port.type == ValueType::Int) {
    for (const std::int64_t it :
         {std::int64_t{0}, std::int64_t{1}, std::int64_t{-1}, kMost, kLeast})
      all.emplace_back(it);
  }
  if (port.type == ValueType::Double) {
    for (const double it :
         {0., 1., -1., .5, -0., 1e-300, 1e300, -1e300, port.range.min, port.range.max}) {
      if (std::isfinite(it)) all.emplace_back(it);
    }
  }
  if (port.type == ValueType::String) {
    all = {std::string(),
           std::string("a"),
           std::string(kLong, 'x'),
           std::string("é\n\t\"<&"),
           std::string("%s%n;../..\0x", 12),
           std::string("-1")};
    for (const std::string_view word : port.choices) all.emplace_back(std::string(word));
  }
  if (port.type == ValueType::DoubleList) {
    all = {Numbers{}, Numbers{0}, Numbers{1, -1, 1e300}, Numbers(kLong, .5)};
  }
  if (port.type == ValueType::IntList) all = {Wholes{}, Wholes{kLeast, kMost}, Wholes(kLong, 1)};
  if (port.type == ValueType::BoolList) {
    all = {std::vector<Flag>{}, std::vector<Flag>(kLong, Flag{true})};
  }
  if (port.type == ValueType::StringList) all = {Texts{}, Texts{""}, Texts(1000, "a;b\\")};
  std::erase_if(all, [&](const Value& it) { return refuse_value(port, it).has_value(); });
  return all;
}

// The entry of a port, by its number.
std::string key_of(std::size_t port) {
  return fmt::format("port_{}", port);
}

// How a fault begins that is against the contract; others are errors that the leaf has told.
// A host may read either.
bool keeps_another(const LeafSlot& leaf) {
  return leaf.kept_progress != nullptr && leaf.read_progress() != leaf.type->progress(leaf.self);
}

bool is_breach(const std::string& fault) {
  constexpr std::array<std::string_view, 5> kBreaches{
      "returned status ", "is a condition and returned running", "reported a progress that is not ",
      "threw an exception", "could not be created: its create returned NULL"};
  return std::ranges::any_of(kBreaches, [&](auto it) { return fault.starts_with(it); });
}

class Examiner {
 public:
  // `constants` are those of an element of this type.
  Examiner(const NodeType& type, const ElementTexts& constants, std::shared_ptr<PluginSet> plugins,
           const LeafReport& report)
      : type_(type), constants_(to_text(constants)), plugins_(std::move(plugins)), report_(report) {
    for (const Parameter& port : type.parameters) samples_.push_back(sample_value(port));
  }

  void examine() {
    std::vector<std::string> children{""};
    if (type_.arity.max > 0) {
      children = {"<AlwaysSuccess/>", "<AlwaysFailure/>", "<AlwaysRunning/>"};
    }
    for (const std::string& child : children) {
      auto tree = tree_of(child, 1);
      if (!tree) return;
      children_ = child.empty() ? "" : fmt::format(" around {}", child);
      if (!ticks(*tree)) return;
      for (const Exercise& it : exercises()) {
        if (!passes(*tree, it.name, it.steps)) return;
      }
      const Exercise& pace = exercise_of_pace();
      if (type_.leaf->set_pace != nullptr && !passes(*tree, pace.name, pace.steps)) return;
      if (type_.can_be_restored && !continues(*tree)) return;
      if (!survives_values(*tree)) return;
      tree = tree_of(child, 2);
      if (!tree ||
          !passes(*tree, "runs alongside another one", std::vector<Do>(kTicks, Do::Tick))) {
        return;
      }
    }
  }

 private:
  // The result of a scenario.
  struct Finding {
    std::string fault;   // "" for none
    std::string breach;  // of the contract
    Status status = Status::Idle;
    double progress = 0;
    std::size_t ticks = 0;
  };

  std::string text_of_leaf(const std::string& child, std::size_t number) const {
    std::string text = fmt::format("<{} name=\"{}\" {}", type_.id, number, constants_);
    for (std::size_t i = 0; i < type_.parameters.size(); ++i) {
      const Parameter& port = type_.parameters[i];
      if (port.constant) continue;
      const bool is_constant = port.type == ValueType::Number;  // no entry has this type
      if (is_constant && !port.default_text) text += fmt::format(" {}=\"1\"", port.name);
      if (!is_constant) text += fmt::format(" {}=\"{{{}}}\"", port.name, key_of(i));
    }
    if (child.empty()) return text + "/>";
    const auto count = std::clamp(kMostChildren, type_.arity.min, type_.arity.max);
    text += '>';
    for (std::uint32_t i = 0; i < count; ++i) text += child;
    return text + fmt::format("</{}>", type_.id);
  }

  std::optional<Runnable> tree_of(const std::string& child, std::size_t count) {
    std::string text = "<root lockstep=\"1\"><BehaviorTree ID=\"Check\"><Parallel>";
    for (std::size_t i = 1; i <= count; ++i) text += text_of_leaf(child, i);
    text += "</Parallel></BehaviorTree></root>";
    Diagnostics diagnostics;
    auto loaded = load_text("check.xml", std::move(text), {}, diagnostics, plugins_);
    if (loaded) return make_runnable(std::move(*loaded));
    const auto error = std::ranges::find(diagnostics.all(), Severity::Error, &Diagnostic::severity);
    note(false, "cannot be in a tree: " + error->message);
    return std::nullopt;
  }

  void fill(Run& run, const Tree& tree, std::span<const Value> values) const {
    for (std::size_t i = 0; i < values.size(); ++i) {
      const auto slot = std::ranges::find(tree.slots, key_of(i), &Slot::name);
      if (slot == tree.slots.end()) continue;
      Entry& entry = run.blackboard().entries[static_cast<std::size_t>(slot - tree.slots.begin())];
      if (type_.parameters[i].direction != Direction::Output) entry.assign(values[i]);
    }
  }

  Finding play(const Runnable& it, std::span<const Do> steps, std::span<const Value> values) const {
    Finding found;
    LeafWatch watch({.budget = std::nullopt,
                     .looks_after_each_call = true,
                     .on_float_mode = [&](std::optional<NodeIndex>, PluginFunction function) {
                       found.breach =
                           fmt::format("changes the rounding mode in {}", name_of(function));
                     }});
    Run run(it.tree, {.seed = 1, .exactly_once = true, .virtual_time = true, .watch = &watch});
    fill(run, it.tree, values);
    Nanoseconds now{0};
    for (const Do step : steps) {
      if (run.fault() != nullptr) break;
      const bool is_running = run.ticker().status(0) == Status::Running;
      if (step == Do::Pause && is_running) run.ticker().pause(0);
      const bool tells = step == Do::Slow || step == Do::Full;
      if (tells && is_running && !run.ticker().held(1)) {
        found.breach = tell_pace(run.ticker().leaf(1), step == Do::Slow ? 0.5 : 1.0);
        if (!found.breach.empty()) break;
      }
      if (step == Do::Halt) run.halt();
      if (step == Do::Restart) run.restart(2);
      if (step == Do::Restart) fill(run, it.tree, values);
      if (step != Do::Tick) continue;
      ++found.ticks;
      found.status = run.tick(now);
      now += run.period();
      const bool goes_on = found.status == Status::Running && run.fault() == nullptr;
      if (!goes_on) continue;
      found.progress = run.ticker().progress(1);
      if (keeps_another(run.ticker().leaf(1))) {
        found.breach = "keeps another progress (LOCKSTEP_KEPT_PROGRESS) than its function returns";
      }
    }
    if (run.fault() == nullptr) run.halt();
    if (run.fault() != nullptr) found.fault = run.fault()->message;
    if (is_breach(found.fault)) found.breach = found.fault;
    const auto out = run.ticker().out_of_range();
    if (!out.empty()) found.breach = out_of_range_text(out.front().reported);
    return found;
  }

  bool note(bool is_good, const std::string& text) const {
    const std::string which = constants_.empty() ? "" : " with " + constants_;
    report_.note(is_good, fmt::format("'{}'{}{} {}", type_.id, which, children_, text));
    return is_good;
  }

  bool ticks(const Runnable& tree) const {
    report_.about_to("is ticked");
    Finding found;
    std::size_t ticks = 1;
    for (; ticks <= kTicks; ++ticks) {
      found = play(tree, std::vector<Do>(ticks, Do::Tick), samples_);
      if (found.status != Status::Running || !found.fault.empty()) break;
    }
    if (!found.breach.empty()) return note(false, found.breach);
    if (!found.fault.empty()) {
      return note(true, fmt::format("answers tick {} with an error: {}", found.ticks, found.fault));
    }
    const std::string denied = denied_statement(found);
    if (!denied.empty()) return note(false, denied);
    const bool is_running = found.status == Status::Running;
    return note(true, fmt::format("answers {}; it is {}{}", counted(found.ticks, "tick"),
                                  is_running ? "running, progress " : to_string(found.status),
                                  is_running ? fmt::format("{:g}", found.progress) : ""));
  }

  // How an activation was not as the plugin says; "" if it was.
  std::string denied_statement(const Finding& found) const {
    Behavior said;
    for (const Statement& it : declared_behavior(type_)) add_statement(it.word, it.value, said);
    const auto ticks = static_cast<std::int64_t>(found.ticks);
    const std::string after = counted(found.ticks, "tick");
    if (found.status == Status::Running) {
      const bool is_late = said.ticks && said.ticks->most && ticks >= *said.ticks->most;
      return is_late ? fmt::format("runs after {}, but its 'ticks' end before", after) : "";
    }
    if (said.ticks && ticks < said.ticks->least) {
      return fmt::format("ends after {}, but its 'ticks' begin at {}", after, said.ticks->least);
    }
    const ResultSet results = said.results.value_or(ResultSet{true, true, true, true});
    const bool may_be = found.status == Status::Success   ? results.success
                        : found.status == Status::Failure ? results.failure
                                                          : results.skipped;
    return may_be ? ""
                  : fmt::format("is {}, which its 'result' does not have", to_string(found.status));
  }

  bool passes(const Runnable& tree, const char* what, std::span<const Do> steps) const {
    report_.about_to(what);
    const Finding found = play(tree, steps, samples_);
    if (!found.breach.empty()) return note(false, fmt::format("{}: {}", what, found.breach));
    return note(true, found.fault.empty() ? what : fmt::format("{}: {}", what, found.fault));
  }

  // Another object continues where this one was after some ticks, or says that it cannot.
  bool continues(const Runnable& it) const {
    constexpr const char* kWhat = "continues after a cut";
    using enum Do;
    report_.about_to(kWhat);
    for (const std::vector<Do>& before :
         {std::vector{Tick}, std::vector{Tick, Tick, Tick, Tick, Tick}, std::vector{Tick, Pause}}) {
      const RunOptions options{.seed = 1, .exactly_once = true, .virtual_time = true};
      Run run(it.tree, options), again(it.tree, options);
      fill(run, it.tree, samples_);
      Nanoseconds now{0};
      for (const Do step : before) {
        if (step == Pause) {
          run.ticker().pause(0);
        } else {
          run.tick(now);
          now += run.period();
        }
      }
      if (run.fault() != nullptr || run.ticker().status(1) != Status::Running) break;
      const bool has_begun = continue_in(again, run, now);
      const std::string when = before.back() == Pause
                                   ? "while it is held"
                                   : fmt::format("after {}", counted(before.size(), "tick"));
      if (again.fault() != nullptr) {
        return note(false, fmt::format("{}: cut {}, {}", kWhat, when, again.fault()->message));
      }
      if (!has_begun) continue;
      for (int tick = 1; tick <= kTicks; ++tick) {
        const std::string one = told_tick(run, now), other = told_tick(again, now);
        if (one != other) {
          return note(
              false,
              fmt::format("{}: cut {}, it is {} in tick {} behind that, and without the cut {}",
                          kWhat, when, other, tick, one));
        }
        now += run.period();
      }
      run.halt();
      again.halt();
    }
    return note(true, kWhat);
  }

  // False: the leaf starts again, or cannot continue.
  static bool continue_in(Run& again, Run& run, Nanoseconds now) {
    LeafBytes kept;
    run.ticker().save_leaves(kept);
    SavedRun saved;
    run.ticker().save(saved);
    again.set_now(now);
    again.ticker().restore(saved);
    std::vector<CutLeaf> cut = again.ticker().cut_leaves();
    for (CutLeaf& leaf : cut) {
      if (!kept[leaf.place].empty()) again.ticker().ask_after_cut(leaf, kept[leaf.place], {});
    }
    again.ticker().go_on_after_cut(cut);
    return std::ranges::all_of(
        cut, [](const CutLeaf& leaf) { return leaf.does == AfterCut::Continues; });
  }

  // "running at 0.2"
  static std::string told_tick(Run& run, Nanoseconds now) {
    run.tick(now);
    const Status status = run.ticker().status(1);
    return fmt::format("{} at {:g}", to_string(status), run.ticker().progress(1));
  }

  // Each edge of each port, then many at once, and no value at all.
  std::vector<std::vector<Value>> values_to_try() const {
    constexpr int kMixes = 50;
    std::vector<std::vector<Value>> all{std::vector<Value>(samples_.size())};
    std::vector<std::vector<Value>> of_port;
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      of_port.push_back(edges(type_.parameters[i]));
      for (const Value& edge : of_port.back()) {
        all.push_back(samples_);
        all.back()[i] = edge;
      }
    }
    RandomStream random(1, 0);
    for (int mix = 0; mix < kMixes && samples_.size() > 1; ++mix) {
      all.push_back(samples_);
      for (std::size_t i = 0; i < samples_.size(); ++i) {
        if (!of_port[i].empty()) all.back()[i] = of_port[i][random.next() % of_port[i].size()];
      }
    }
    return all;
  }

  bool survives_values(const Runnable& tree) const {
    constexpr std::array kSteps{Do::Tick, Do::Tick, Do::Pause, Do::Tick, Do::Halt};
    if (samples_.empty()) return true;
    std::size_t errors = 0;
    const auto all = values_to_try();
    for (const auto& values : all) {
      report_.about_to(with(values));
      const Finding found = play(tree, kSteps, values);
      if (!found.breach.empty()) {
        return note(false, fmt::format("{} {}", with(values), found.breach));
      }
      errors += !found.fault.empty();
    }
    return note(true,
                fmt::format("takes {} of its ports{}", counted(all.size(), "set") + " of values",
                            errors == 0 ? "" : fmt::format(", {} with an error", errors)));
  }

  std::string with(std::span<const Value> values) const {
    constexpr std::size_t kMost = 40;
    std::string text = "with";
    for (std::size_t i = 0; i < values.size(); ++i) {
      const bool has_value = !std::holds_alternative<NoValue>(values[i]);
      std::string value = has_value ? to_text(values[i]) : "no value";
      if (value.size() > kMost) value = value.substr(0, kMost) + "…";
      text += fmt::format(" {}={}", type_.parameters[i].name, value);
    }
    return text;
  }

  const NodeType& type_;
  const std::string constants_;
  const std::shared_ptr<PluginSet> plugins_;
  const LeafReport& report_;
  std::vector<Value> samples_;
  std::string children_;
};

}  // namespace

void examine_leaf(const NodeType& type, const std::shared_ptr<PluginSet>& plugins,
                  const LeafReport& report) {
  const auto note = [&](std::string_view text) {
    report.note(true, fmt::format("'{}' is not examined: {}", type.id, text));
  };
  if (make_catalog(*plugins).find(type.id) != &type) {
    return note("lockstep's language has a node of that name");
  }
  if (type.element_types == nullptr) return Examiner(type, {}, plugins, report).examine();
  bool has_elements = false;
  for (const ElementTexts& constants : sample_elements(type)) {
    const auto described = type.element_types->type_of(fixed_texts(constants));
    const bool is_wrong = !described && is_breach(described.error());
    has_elements |= described || is_wrong;
    if (const std::string again =
            is_wrong ? "" : type.element_types->asked_again(fixed_texts(constants));
        !again.empty()) {
      has_elements = true;  // that is told
      report.note(false, fmt::format("'{}' with {} {}", type.id, to_text(constants), again));
    } else if (described) {
      if (const auto port = port_without_pattern(type, **described); !port.empty())
        report.note(false,
                    fmt::format("'{}' with {}: has the port '{}', which no pattern of more_ports "
                                "allows",
                                type.id, to_text(constants), port));
      Examiner(**described, constants, plugins, report).examine();
    } else if (is_wrong) {
      const Problem& why = described.error().why;
      report.note(false, fmt::format("'{}' with {}: {}{}{}", type.id, to_text(constants),
                                     why.message, why.hint.empty() ? "" : "; ", why.hint));
    } else {
      note(fmt::format("no element has {}: {}", to_text(constants), described.error().why.message));
    }
  }
  if (!has_elements && declares_samples(type)) report.note(false, describes_nothing(type));
}

}  // namespace lockstep::host
