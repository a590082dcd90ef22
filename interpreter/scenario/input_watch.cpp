#include "scenario/input_watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/blackboard/conversion.h"
#include "base/core/progress.h"
#include "base/core/wording.h"
#include "leaves/plugin/contract/host.h"

namespace lockstep::host {
namespace {

// As the leaf would read it.
Value read_input(const BoundPort& port) {
  const Value& value = *port.ordinary();
  if (port.is_generic || holds(value, port.type)) return value;
  auto converted = convert_value(value, port.type, port.object());
  if (converted) return std::move(*converted);
  return value;
}

bool are_same(const Value& value, const PreparedInput& input) {
  const auto* const number = std::get_if<double>(&value);
  const auto expected = number != nullptr ? parse_double(input.text) : std::nullopt;
  if (expected) return std::abs(*number - *expected) <= kProgressEpsilon;
  return to_text(value) == input.text;
}

std::string value_text(const Value& value) {
  return std::holds_alternative<NoValue>(value) ? "no value" : brief(to_text(value));
}

}  // namespace

InputWatch::InputWatch(const BoundScenario& bound, const Tree& tree)
    : bound_(bound),
      tree_(tree),
      has_begun_(bound.inputs.size()),
      is_violated_(bound.inputs.size()) {}

void InputWatch::begins(const lockstep_caller& caller) {
  for (std::size_t i = 0; i < bound_.inputs.size(); ++i) {
    if (std::ranges::binary_search(bound_.inputs[i].leaves, caller.node)) compare(i, caller);
  }
}

void InputWatch::compare(std::size_t number, const lockstep_caller& caller) {
  const PreparedInput& input = bound_.inputs[number];
  has_begun_[number] = true;
  const auto port = std::ranges::find(caller.ports, input.port, &BoundPort::name);
  if (is_violated_[number] || port == caller.ports.end()) return;
  const Value value = read_input(**port);
  if (are_same(value, input)) return;
  is_violated_[number] = true;
  surprises_.push_back(
      {input.place,
       fmt::format("expected {} {}, came {}", input.port, brief(input.text), value_text(value)),
       {fmt::format("in tick {}: {} begins", tick_, tree_.path(caller.node))}});
}

std::vector<Surprise> InputWatch::verdict() {
  for (std::size_t i = 0; i < has_begun_.size(); ++i) {
    const PreparedInput& input = bound_.inputs[i];
    if (has_begun_[i] || input.of->is_for_all) continue;
    surprises_.push_back(
        {input.place,
         fmt::format("expected {} {}, the leaf never begins", input.port, brief(input.text)),
         {tree_.path(input.leaves.front())}});
  }
  return std::move(surprises_);
}

}  // namespace lockstep::host
