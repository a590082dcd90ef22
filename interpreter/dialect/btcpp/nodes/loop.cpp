// LoopInt, LoopBool, LoopDouble and LoopString: tick the child once for each item of a list.
#include <algorithm>
#include <array>
#include <string_view>

#include "base/blackboard/conversion.h"
#include "dialect/btcpp/nodes/kinds.h"
#include "dialect/btcpp/nodes/results.h"
#include "engine/node_ports.h"
#include "engine/nodes/fold.h"

namespace lockstep::host::btcpp {
namespace {

constexpr unsigned kQueue = 0, kValue = 1, kIfEmpty = 2;

constexpr std::array<Parameter, 3> parameters_of_loop(ValueType list, ValueType item) {
  return {Parameter{.name = "queue",
                    .type = list,
                    .doc = "The items; an entry is copied when the node begins.",
                    .required = true,
                    .direction = Direction::InOut},
          Parameter{.name = "value",
                    .type = item,
                    .doc = "The entry that gets the item.",
                    .direction = Direction::Output},
          Parameter{.name = "if_empty",
                    .type = ValueType::String,
                    .doc = "The result when no item is left.",
                    .default_text = "SUCCESS",
                    .choices = kResults}};
}

template <ValueType kList, ValueType kItem>
constexpr auto kLoopParameters = parameters_of_loop(kList, kItem);

struct LoopState {
  std::uint32_t next;  // item
};

template <class T>
std::optional<Value> item_of(const Value& list, std::size_t index) {
  const auto* items = std::get_if<std::vector<T>>(&list);
  if (items == nullptr || index >= items->size()) return std::nullopt;
  if constexpr (std::is_same_v<T, Flag>) {
    return Value((*items)[index].is_set);
  } else {
    return Value((*items)[index]);
  }
}

// False: there is no list, which is a fault.
template <ValueType kList>
bool begin_loop(NodeContext& context, NodeIndex self) {
  context.state<LoopState>(self).next = 0;
  const Value* queue = context.ports().value(self, kQueue);
  auto list = queue == nullptr ? std::nullopt : convert_value(*queue, kList, nullptr);
  if (list) {
    context.kept_values()[self] = std::move(*list);
    return true;
  }
  context.set_fault(self, queue == nullptr ? "its queue has no value"
                                           : "its queue holds no " + std::string(to_string(kList)));
  return false;
}

Status if_empty(NodeContext& context, NodeIndex self) {
  const Value* word = context.ports().value(self, kIfEmpty);
  const auto* text = word == nullptr ? nullptr : std::get_if<std::string>(word);
  const auto* const it = text == nullptr ? std::end(kResults) : std::ranges::find(kResults, *text);
  if (it != std::end(kResults)) return static_cast<Status>(it - std::begin(kResults) + 1);
  context.set_fault(self, "'if_empty' is not one of RUNNING, SUCCESS, FAILURE, SKIPPED");
  return Status::Failure;
}

template <class T, ValueType kList, ValueType kItem>
Status tick_loop(NodeContext& context, NodeIndex self) {
  if (context.first_tick(self) && !begin_loop<kList>(context, self)) return Status::Failure;
  if (context.status(self + 1) != Status::Running) {
    LoopState& state = context.state<LoopState>(self);
    auto item = item_of<T>(context.kept_values()[self], state.next);
    if (!item) return if_empty(context, self);
    ++state.next;
    Entry* const entry = context.ports().entry(self, kValue);
    if (entry != nullptr && !write_entry(*entry, kItem, nullptr, *std::move(item))) {
      context.set_fault(self, "the item does not fit the entry of 'value'");
      return Status::Failure;
    }
  }
  return context.tick(self + 1) == Status::Failure ? Status::Failure : Status::Running;
}

template <class T>
std::size_t count_of(const Value& list) {
  const auto* items = std::get_if<std::vector<T>>(&list);
  return items == nullptr ? 0 : items->size();
}

template <class T>
double progress_of_loop(NodeContext& context, NodeIndex self) {
  const auto all = static_cast<double>(count_of<T>(context.kept_values()[self]));
  if (all == 0) return 0.0;
  const bool runs = context.status(self + 1) == Status::Running;
  const double done = context.state<LoopState>(self).next - (runs ? 1.0 : 0.0);
  return (done + (runs ? context.progress(self + 1) : 0.0)) / all;
}

// One that has completed goes on if it is ticked without a reset.
inline void fold_loop(NodeContext& context, NodeIndex self) {
  if (context.status(self) != Status::Idle) return;
  fold::dead(context, self);
  context.kept_values().erase(self);
}

template <class T, ValueType kList, ValueType kItem>
constexpr NodeKind kind_of_loop(std::string_view id) {
  return {.type = {.id = id,
                   .category = NodeCategory::Decorator,
                   .doc = "Ticks its child once for each item of a list, one after the other; "
                          "Failure as soon as it fails.",
                   .arity = {1, 1},
                   .parameters = kLoopParameters<kList, kItem>,
                   .can_run = true,
                   .reads_ports = true},
          .tick = tick_loop<T, kList, kItem>,
          .progress = progress_of_loop<T>,
          .state_size = sizeof(LoopState),
          .fold = fold_loop,
          .unreset = [](NodeContext&, NodeIndex) { return Unreset::GoesOn; }};
}

}  // namespace

const NodeKind kLoopInt = kind_of_loop<std::int64_t, ValueType::IntList, ValueType::Int>("LoopInt");
const NodeKind kLoopBool = kind_of_loop<Flag, ValueType::BoolList, ValueType::Bool>("LoopBool");
const NodeKind kLoopDouble =
    kind_of_loop<double, ValueType::DoubleList, ValueType::Double>("LoopDouble");
const NodeKind kLoopString =
    kind_of_loop<std::string, ValueType::StringList, ValueType::String>("LoopString");

}  // namespace lockstep::host::btcpp
