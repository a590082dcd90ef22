// Switch2 to Switch6: an entry chooses the child.
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

#include "dialect/btcpp/nodes/kinds.h"
#include "engine/node_context.h"
#include "engine/node_ports.h"
#include "engine/nodes/fold.h"

namespace lockstep::host::btcpp {
namespace {

constexpr unsigned kVariable = 0;  // case N is parameter N

constexpr Parameter kVariableParameter{
    .name = "variable", .type = ValueType::String, .doc = "What the cases are compared with."};

template <std::size_t... kCases>
constexpr auto parameters_of_switch(std::index_sequence<kCases...>) {
  constexpr std::array<std::string_view, 6> kNames = {"case_1", "case_2", "case_3",
                                                      "case_4", "case_5", "case_6"};
  return std::array<Parameter, sizeof...(kCases) + 1>{
      kVariableParameter, Parameter{.name = kNames[kCases],
                                    .type = ValueType::String,
                                    .doc = "The value that chooses this child.",
                                    .required = true}...};
}

template <std::size_t kCount>
constexpr auto kSwitchParameters = parameters_of_switch(std::make_index_sequence<kCount>());

struct SwitchState {
  NodeIndex current;  // the child that runs
};

// A value as the text that cases are compared with: reals have six decimals.
class TextOf {
 public:
  explicit TextOf(const Value& value) {
    if (const auto* text = std::get_if<std::string>(&value)) text_ = *text;
    if (const auto* flag = std::get_if<bool>(&value)) text_ = *flag ? "1" : "0";
    if (const auto* whole = std::get_if<std::int64_t>(&value)) print(*whole);
    if (const auto* real = std::get_if<double>(&value)) print(*real, std::chars_format::fixed, 6);
  }
  TextOf(const TextOf&) = delete;
  TextOf& operator=(const TextOf&) = delete;
  std::string_view operator*() const { return text_; }

 private:
  template <class... Number>
  void print(Number... number) {
    const auto end = std::to_chars(buffer_.data(), buffer_.data() + buffer_.size(), number...).ptr;
    text_ = {buffer_.data(), static_cast<std::size_t>(end - buffer_.data())};
  }

  std::array<char, 320> buffer_;  // for the greatest real
  std::string_view text_;
};

// A number, or a word that stands for one.
std::optional<double> number_in(std::string_view text, const ScriptEnums* words) {
  if (words != nullptr) {
    const auto word = words->find(text);
    if (word != words->end()) return word->second;
  }
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool is_whole_text = error == std::errc() && end == text.data() + text.size();
  return is_whole_text ? std::optional(number) : std::nullopt;
}

bool are_equal(std::string_view one, std::string_view other, const ScriptEnums* words) {
  if (one == other) return true;
  const auto number = number_in(one, words);
  const auto second = number_in(other, words);
  constexpr double kTolerance = 1.2e-7;
  return number && second && std::fabs(*number - *second) < kTolerance;
}

bool chooses(NodeContext& context, NodeIndex self, const Value& variable, unsigned number) {
  const Value* value = context.ports().value(self, number);
  return value != nullptr && are_equal(*TextOf(variable), *TextOf(*value), context.ports().words());
}

// The child of the first case that fits, else the last.
NodeIndex choose(NodeContext& context, NodeIndex self) {
  const std::uint32_t cases = context.node(self).children - 1;
  const Value* variable = context.ports().value(self, kVariable);
  NodeIndex child = self + 1;
  for (std::uint32_t i = 1; i <= cases; ++i, child = context.end_of(child)) {
    if (variable != nullptr && chooses(context, self, *variable, i)) break;
  }
  return child;
}

Status tick_switch(NodeContext& context, NodeIndex self) {
  SwitchState& state = context.state<SwitchState>(self);
  const NodeIndex child = choose(context, self);
  if (!context.first_tick(self) && state.current != child) context.halt(state.current);
  state.current = child;
  return context.tick(child);
}

double progress_of_switch(NodeContext& context, NodeIndex self) {
  return context.progress(context.state<SwitchState>(self).current);
}

template <std::uint32_t kCases>
constexpr NodeKind kind_of_switch(std::string_view id) {
  return {.type = {.id = id,
                   .category = NodeCategory::Control,
                   .doc = "Ticks the child of the first case that equals the variable, otherwise "
                          "the last child.",
                   .arity = {kCases + 1, kCases + 1},
                   .parameters = kSwitchParameters<kCases>,
                   .reads_ports = true},
          .tick = tick_switch,
          .progress = progress_of_switch,
          .state_size = sizeof(SwitchState),
          .fold = fold::dead_when_idle};
}

}  // namespace

const NodeKind kSwitch2 = kind_of_switch<2>("Switch2");
const NodeKind kSwitch3 = kind_of_switch<3>("Switch3");
const NodeKind kSwitch4 = kind_of_switch<4>("Switch4");
const NodeKind kSwitch5 = kind_of_switch<5>("Switch5");
const NodeKind kSwitch6 = kind_of_switch<6>("Switch6");

}  // namespace lockstep::host::btcpp
