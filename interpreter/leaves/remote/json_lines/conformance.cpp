#include "leaves/remote/json_lines/conformance.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <filesystem>
#include <memory>
#include <span>

#include "base/core/element_types.h"
#include "base/core/parameter_value.h"
#include "base/core/running_time.h"
#include "base/core/wording.h"
#include "leaves/plugin/contract/described_types.h"
#include "leaves/plugin/contract/descriptor.h"
#include "leaves/plugin/contract/host.h"
#include "leaves/plugin/contract/leaf_set.h"
#include "leaves/remote/json_lines/described_element.h"
#include "leaves/remote/json_lines/hello.h"
#include "leaves/remote/json_lines/program_leaf.h"

namespace lockstep::host {
namespace {

constexpr int kTicks = 20;

// A leaf type to try, or one of its elements, with its constants.
struct Tried {
  const NodeType* type;
  ElementTexts constants = {};
};

// A leaf without a tree: its ports are bound to entries that nobody else has.
class Trial {
 public:
  Trial(const Tried& it, std::uint32_t number, Conversation& conversation, Hold hold)
      : name_(fmt::format("{} {}", it.type->id, number)) {
    slot_.type = it.type->leaf;
    caller_.type = it.type;
    caller_.texts.set({.name = std::string(it.type->id)});
    caller_.who = name_.c_str();
    caller_.random = RandomStream(1, 1);
    for (const Parameter& port : it.type->parameters) bind(port, it.constants);
    ports_.give_to(caller_);
    leaf_ = std::make_unique<ProgramLeaf>(caller_, conversation, hold, nullptr);
  }

  ~Trial() { leaf_->end(); }
  Trial(const Trial&) = delete;
  Trial& operator=(const Trial&) = delete;

  ProgramLeaf& leaf() { return *leaf_; }
  const std::string& name() const { return name_; }
  void pass_time() { time_.now += time_.period; }
  // The error that the leaf has been blamed for; "" for none.
  std::string take_error() {
    const char* const error = std::exchange(slot_.error, nullptr);
    return error == nullptr ? "" : error;
  }

 private:
  void bind(const Parameter& port, const ElementTexts& constants) {
    Entry& entry = entries_.emplace_back(Typing::Strict, port.type);
    BoundPort bound{.parameter = &port, .entry = port.name, .type = port.type};
    if (port.direction != Direction::Output) entry.assign(sample_value(port));
    for (const auto& [parameter, text] : constants) {
      if (parameter == port.name) entry.assign(parse_value(port.type, text).value_or(Value()));
    }
    bound.read = &entry.value();
    if (port.direction != Direction::Input) bound.write = &entry;
    ports_.add(std::move(bound));
  }

  const std::string name_;
  LeafSlot slot_;
  LeafTime time_{.period = std::chrono::milliseconds(10)};
  LeafLog log_;
  std::deque<Entry> entries_;
  PortTable ports_;
  CallerRun run_{.log = &log_};
  lockstep_caller caller_{time_, slot_, run_};
  std::unique_ptr<ProgramLeaf> leaf_;
};

// Describes elements before any leaf is made.
class Describer final : public LeafDescriber {
 public:
  Describer(Conversation& conversation, const std::unique_ptr<Hello>& hello)
      : conversation_(conversation), hello_(hello) {}
  tl::expected<const lockstep_leaf_type*, ElementRefusal> describe(
      std::string_view id, std::span<const FixedText> fixed) override {
    const lockstep_leaf_type& base = *hello_->type_named(id);
    auto answer = ask_to_describe(conversation_, describe_request(base, fixed));
    if (!answer) return tl::unexpected(undescribed(id, answer.error()));
    try {
      return read_described(*answer, base, described_.emplace_back());
    } catch (const JsonError& error) {
      conversation_.give_up("was killed, since it answers describe wrongly");
      return tl::unexpected(
          undescribed(id, {fmt::format("answers describe wrongly: {}", error.what()), {}}));
    }
  }

 private:
  Conversation& conversation_;
  const std::unique_ptr<Hello>& hello_;
  std::deque<OwnedDescriptors> described_;
};

class Examiner {
 public:
  Examiner(const std::string& path, const IsolationOptions& options)
      : path_(path), options_(options) {}

  Conformance examine(ConformancePart part) {
    if (!begin()) return std::move(result_);
    if (part == ConformancePart::All) {
      for (const Tried& it : what_to_try()) {
        if (!examine_leaf(it)) return std::move(result_);
      }
    }
    if (!conversation_.is_gone()) end();
    return std::move(result_);
  }

 private:
  bool note(bool is_good, std::string text) {
    result_.steps.push_back({is_good, std::move(text)});
    return is_good;
  }
  bool refuse(std::string_view what, const Problem& problem) {
    return note(false, fmt::format("{}{}{}{}", what, problem.message,
                                   problem.hint.empty() ? "" : "; ", problem.hint));
  }

  bool begin() {
    const Nanoseconds started = monotonic_now();
    auto line = conversation_.start(path_);
    result_.has_started = conversation_.process().has_started();
    if (!line) return refuse("it ", line.error());
    const Nanoseconds took = monotonic_now() - started;
    result_.first_line = *line;
    auto hello = Hello::read(*line, plugin_name(), Hold::AsItSays);
    if (!hello) return refuse("it ", hello.error());
    hello_ = std::move(*hello);
    if (const auto refusal = read_descriptors(hello_->plugin(), 0, descriptors_)) {
      return refuse("it ", *refusal);
    }
    descriptors_.plugin.describer = &describer_;
    conversation_.begin(run_);
    std::vector<std::string_view> ids;
    for (const auto& leaf : descriptors_.leaves) ids.push_back(leaf->type.id);
    return note(!ids.empty(),
                fmt::format("reports after {} ms that it has {}", took.count() / 1'000'000,
                            ids.empty() ? "no leaves" : listed(ids)));
  }

  // The one that `run --plugin` gives to the file.
  std::string plugin_name() const {
    std::string name = std::filesystem::path(path_).stem().string();
    return is_plugin_name(name) ? name : "program";
  }

  // Notes that a leaf has done something, if it was not blamed.
  bool passed(Trial& trial, std::string_view what) {
    const std::string error = trial.take_error();
    if (error.empty()) return note(true, fmt::format("'{}' {}", trial.name(), what));
    // An error is an answer, too: to values that make no sense, perhaps.
    return note(!conversation_.is_gone(), fmt::format("'{}' {}: {}", trial.name(), what, error));
  }

  std::vector<Tried> what_to_try() {
    std::vector<Tried> all;
    for (const auto& leaf : descriptors_.leaves) {
      if (leaf->element_types != nullptr) {
        describe_elements(leaf->node_type, all);
      } else {
        all.push_back({&leaf->node_type});
      }
    }
    return all;
  }

  void describe_elements(const NodeType& type, std::vector<Tried>& all) {
    bool has_elements = false;
    for (const ElementTexts& constants : sample_elements(type)) {
      const auto described = type.element_types->type_of(fixed_texts(constants));
      const std::string who = fmt::format("'{}' with {} ", type.id, to_text(constants));
      has_elements |= described.has_value();
      if (!described) {
        const bool is_wrong = is_breach(described.error()) || conversation_.is_gone();
        const std::string again =
            is_wrong ? "" : type.element_types->asked_again(fixed_texts(constants));
        has_elements |= is_wrong || !again.empty();  // that is told
        note(!is_wrong && again.empty(),
             who + (again.empty() ? "is not tried: " + described.error().why.message : again));
        continue;
      }
      all.push_back({*described, constants});
      const std::string wrong = breach_of(type, **described, constants);
      note(wrong.empty() && !conversation_.is_gone(),
           who +
               (wrong.empty() ? "has " + counted((*described)->parameters.size(), "port") : wrong));
    }
    if (!has_elements && declares_samples(type)) note(false, describes_nothing(type));
  }

  // What is wrong with the ports that an element was described with; "": nothing.
  std::string breach_of(const NodeType& type, const NodeType& described,
                        const ElementTexts& constants) {
    if (const auto port = port_without_pattern(type, described); !port.empty())
      return fmt::format("has the port '{}', which no pattern of more_ports allows", port);
    return type.element_types->asked_again(fixed_texts(constants));
  }

  bool examine_leaf(const Tried& tried) {
    const Hold hold = hello_->hold_of(tried.type->id);
    trials_.push_back(std::make_unique<Trial>(tried, 1, conversation_, hold));
    trials_.push_back(std::make_unique<Trial>(tried, 2, conversation_, hold));
    Trial& one = *trials_[trials_.size() - 2];
    Trial& two = *trials_.back();
    for (Trial* it : {&one, &two}) {
      it->leaf().create();
      if (!passed(*it, "answers create")) return false;
    }
    const bool is_told = hold == Hold::Message || hold == Hold::Answered;
    if (!run(one) || (is_told && !hold_and_go_on(one))) return false;
    one.leaf().start();
    two.leaf().start();
    for (Trial* it : {&one, &two}) {
      it->leaf().tick();
      if (!passed(*it, "answers a tick alongside the other")) return false;
    }
    for (Trial* it : {&one, &two}) {
      it->leaf().halt();
      if (!passed(*it, "answers halt")) return false;
    }
    return true;
  }

  // One activation, which may be cut short.
  bool run(Trial& trial) {
    trial.leaf().start();
    lockstep_status status = LOCKSTEP_RUNNING;
    std::vector<Nanoseconds> times;
    std::optional<double> wrong;  // the first progress that is none
    while (status == LOCKSTEP_RUNNING && times.size() < kTicks) {
      const Nanoseconds asked = monotonic_now();
      trial.pass_time();
      status = trial.leaf().tick();
      times.push_back(monotonic_now() - asked);
      if (std::string error = trial.take_error(); !error.empty()) {
        const bool is_good = !conversation_.is_gone() && error != ProgramLeaf::kRunningCondition;
        note(is_good, fmt::format("'{}' answers tick {} with an error: {}", trial.name(),
                                  times.size(), error));
        if (conversation_.is_gone()) return false;
        trial.leaf().halt();
        return passed(trial, "answers halt");
      }
      const double progress = trial.leaf().progress();
      if (!wrong && !(progress >= 0 && progress <= 1)) wrong = progress;
    }
    std::ranges::sort(times);
    const bool is_running = status == LOCKSTEP_RUNNING;
    note(true, fmt::format("'{}' answers {} (median {} us); it is {}, progress {:g}", trial.name(),
                           counted(times.size(), "tick"), times[times.size() / 2].count() / 1000,
                           is_running ? "running" : "done", trial.leaf().progress()));
    if (wrong) note(false, fmt::format("'{}' reported the progress {:g}", trial.name(), *wrong));
    if (is_running) trial.leaf().halt();
    return !is_running || passed(trial, "answers halt");
  }

  bool hold_and_go_on(Trial& trial) {
    trial.leaf().start();
    trial.leaf().tick();
    trial.leaf().pause();
    trial.leaf().resume();
    trial.leaf().tick();
    trial.leaf().halt();
    return passed(trial, "continues after pause and resume");
  }

  void end() {
    trials_.clear();
    conversation_.begin_end();
    const auto limit = options_.halt_limit;
    RunningClock clock;
    conversation_.await_end(clock, limit ? std::optional(clock.now() + *limit) : std::nullopt);
    conversation_.hurry_end();
    const std::string what = conversation_.end();
    if (!what.empty()) {
      note(false, "it " + what);
    } else {
      note(true, "ends when its input is closed");
    }
  }

  const std::string& path_;
  const IsolationOptions& options_;
  Conformance result_;
  std::unique_ptr<Hello> hello_;
  Descriptors descriptors_;
  LeafSlot slot_;
  LeafTime time_;
  LeafLog log_;
  CallerRun shared_{.log = &log_};
  lockstep_caller run_{time_, slot_, shared_};
  Conversation conversation_{options_};
  Describer describer_{conversation_, hello_};
  std::vector<std::unique_ptr<Trial>> trials_;
};

}  // namespace

Conformance check_conformance(const std::string& path, const IsolationOptions& options,
                              ConformancePart part) {
  return Examiner(path, options).examine(part);
}

}  // namespace lockstep::host
