#include <algorithm>
#include <string>

#include "base/blackboard/entry.h"
#include "base/core/wording.h"
#include "engine/node_ports.h"
#include "engine/node_scripts.h"
#include "engine/nodes/kinds.h"
#include "engine/nodes/timed.h"

namespace lockstep::host {
namespace {

constexpr unsigned kText = 1, kOptions = 2, kDefault = 3, kAnswer = 5;
constexpr std::string_view kSeverities[] = {"info", "warning", "critical"};

constexpr Parameter kAskParameters[] = {
    timed::kLongestWait,
    {.name = "text",
     .type = ValueType::String,
     .doc = "The question, such as Take the {part} to {place}?",
     .required = true,
     .is_script = true,
     .is_template = true},
    {.name = "options",
     .type = ValueType::StringList,
     .doc = "The answers that a person may choose.",
     .default_text = "yes;no",
     .constant = true},
    {.name = "default",
     .type = ValueType::String,
     .doc = "The answer when the time is over. When absent, that is Failure.",
     .constant = true},
    {.name = "severity",
     .type = ValueType::String,
     .doc = "How much it matters, for whoever shows the question.",
     .default_text = "info",
     .choices = kSeverities,
     .constant = true},
    {.name = "answer",
     .type = ValueType::String,
     .doc = "The answer. Without it, the first option is Success and each other one is Failure.",
     .direction = Direction::Output},
};

std::optional<RuleBreak> rule_of_ask(const ParameterValues& given) {
  const auto* options = std::get_if<std::vector<std::string>>(&given.values[kOptions]);
  if (options == nullptr) return std::nullopt;
  if (options->empty()) return RuleBreak{static_cast<int>(kOptions), "there is no option", ""};
  for (auto it = options->begin(); it != options->end(); ++it) {
    if (it->empty() || it->find('|') != std::string::npos) {
      return RuleBreak{static_cast<int>(kOptions), "the option '" + brief(*it) + "' cannot be",
                       "an option has at least a letter, and no '|', which is between the values "
                       "in a leaf model"};
    }
    if (std::find(options->begin(), it, *it) == it) continue;
    return RuleBreak{static_cast<int>(kOptions), "the option '" + brief(*it) + "' is given twice",
                     ""};
  }
  const auto* chosen = std::get_if<std::string>(&given.values[kDefault]);
  if (chosen == nullptr) return std::nullopt;
  if (std::ranges::find(*options, *chosen) == options->end()) {
    return RuleBreak{static_cast<int>(kDefault), "'" + brief(*chosen) + "' is not an option",
                     "write one of the options"};
  }
  if (given.is_given(timed::kSeconds)) return std::nullopt;
  return RuleBreak{static_cast<int>(kDefault), "'default' is for when the time is over",
                   "write timeout=\"…\", in seconds"};
}

struct AskState {
  timed::State times;
  std::uint32_t answer;  // the place of the option that was chosen, and 1; 0: none yet
  std::uint32_t since;   // the number of the first tick
};

void say(NodeContext& context, NodeIndex self, std::string_view text) {
  std::uint32_t place = 0;  // differs from run to run, so it is no state
  context.say(self, place, text);
}

Status give(NodeContext& context, NodeIndex self, std::uint32_t option, std::string reason) {
  const std::string& chosen = context.parameters().texts(self, kOptions)[option];
  say(context, self, reason.append("'" + chosen + "'"));
  // Only with `answer` is the node one whose parameters may be entries.
  Entry* const entry = context.parameters().are_constant(self)
                           ? nullptr
                           : context.ports().entry_of_bound(self, kAnswer);
  if (entry == nullptr) return option == 0 ? Status::Success : Status::Failure;
  if (write_entry(*entry, ValueType::String, nullptr, chosen)) return Status::Success;
  context.set_fault(self, "sets an output that its entry does not take");
  return Status::Failure;
}

Status end_time(NodeContext& context, NodeIndex self) {
  const std::string* const chosen = context.parameters().text(self, kDefault);
  if (chosen == nullptr) {
    say(context, self, "no answer in time");
    return Status::Failure;
  }
  const auto options = context.parameters().texts(self, kOptions);
  const auto option = std::ranges::find(options, *chosen) - options.begin();
  return give(context, self, static_cast<std::uint32_t>(option), "no answer in time: ");
}

Status ask(NodeContext& context, NodeIndex self) {
  const Value* const text = context.scripts().value_of(self, kText);
  if (text == nullptr) return Status::Failure;
  say(context, self, std::get<std::string>(*text));
  return Status::Running;
}

Status tick_ask(NodeContext& context, NodeIndex self) {
  timed::count(context, self);
  auto& state = context.state<AskState>(self);
  if (context.first_tick(self)) {
    state.answer = 0;
    state.since = context.tick_number();
    return ask(context, self);
  }
  if (state.answer != 0) return give(context, self, state.answer - 1, "answered ");
  if (timed::has_waited(context, self)) return end_time(context, self);
  std::uint32_t place = 0;
  return context.say_again(self, place) ? Status::Running : ask(context, self);
}

bool answer_ask(NodeContext& context, NodeIndex self, std::uint32_t option, std::uint32_t seen) {
  auto& state = context.state<AskState>(self);
  const bool asks =
      context.status(self) == Status::Running && state.answer == 0 && state.since <= seen;
  if (asks) state.answer = option + 1;
  return asks;
}

void fold_ask(NodeContext& context, NodeIndex self) {
  timed::fold(context, self);
  context.state<AskState>(self).since = 0;
}

}  // namespace

const NodeKind kAsk{.type = {.id = "Ask",
                             .category = NodeCategory::Action,
                             .doc = "Asks a person, and is Running until there is an answer.",
                             .arity = {0, 0},
                             .parameters = kAskParameters,
                             .rule = rule_of_ask,
                             .can_run = true,
                             .asks = true},
                    .tick = tick_ask,
                    .progress = [](NodeContext&, NodeIndex) { return 0.0; },
                    .state_size = sizeof(AskState),
                    .pause = timed::pause,
                    .fold = fold_ask,
                    .reads_own_hold = true,
                    .answer = answer_ask};

}  // namespace lockstep::host
