// SetBlackboard and UnsetBlackboard: write an entry, or remove it.
#include "base/blackboard/conversion.h"
#include "base/core/wording.h"
#include "dialect/btcpp/nodes/kinds.h"
#include "engine/node_context.h"
#include "engine/node_ports.h"
#include "engine/nodes/at_once.h"

namespace lockstep::host::btcpp {
namespace {

constexpr unsigned kNewValue = 0, kOutputKey = 1;
constexpr unsigned kKey = 0;

constexpr Parameter kSetParameters[] = {{.name = "value",
                                         .type = ValueType::String,
                                         .doc = "A text, or the entry to copy.",
                                         .required = true,
                                         .is_generic = true},
                                        {.name = "output_key",
                                         .type = ValueType::String,
                                         .doc = "The name of the entry to write.",
                                         .required = true,
                                         .is_generic = true,
                                         .is_key = true}};
constexpr Parameter kUnsetParameters[] = {{.name = "key",
                                           .type = ValueType::String,
                                           .doc = "The name of the entry to remove.",
                                           .required = true,
                                           .is_key = true,
                                           .own_only = true}};

// Into an entry that has a type goes what is of it, and a text that is one.
bool store(NodeContext& context, NodeIndex self, Entry& target, const Value& value) {
  const auto* const text = std::get_if<std::string>(&value);
  if (target.typing == Typing::Any || holds(value, target.type)) {
    target.assign(value);
    return true;
  }
  auto converted =
      text == nullptr ? std::nullopt : convert_value(value, target.type, target.object);
  if (converted) {
    target.assign(std::move(*converted));
    return true;
  }
  context.set_fault(self, "cannot write '" + brief(to_text(value)) + "' to an entry that holds " +
                              std::string(expected_text(target.type)));
  return false;
}

// Nothing: the name has no value, which is a fault.
std::optional<Entry*> named(NodeContext& context, NodeIndex self, unsigned port) {
  const auto entry = context.ports().named(self, port);
  if (!entry) context.set_fault(self, context.ports().missing_name(self, port));
  return entry;
}

Status tick_set(NodeContext& context, NodeIndex self) {
  const auto entry = named(context, self, kOutputKey);
  const Entry* const source = context.ports().entry(self, kNewValue);
  if (source != nullptr && !source->is_present) {
    context.set_fault(self, "there is no entry to copy: 'value' names one that was removed");
    return Status::Failure;
  }
  const Value* const value = context.ports().value(self, kNewValue);
  if (!entry || value == nullptr) return Status::Failure;
  Entry* const target = *entry;
  if (target == nullptr) return Status::Success;  // without a name
  if (source == target) return Status::Success;
  if (!target->is_present) {
    source == nullptr ? make_entry(*target, Typing::Declared, ValueType::String)
                      : make_entry(*target, source->typing, source->type, source->object);
  }
  return store(context, self, *target, *value) ? Status::Success : Status::Failure;
}

Status tick_unset(NodeContext& context, NodeIndex self) {
  const auto entry = named(context, self, kKey);
  if (!entry) return Status::Failure;
  if (*entry != nullptr) unset_entry(**entry);
  return Status::Success;
}

}  // namespace

const NodeKind kSetBlackboard{.type = {.id = "SetBlackboard",
                                       .category = NodeCategory::Action,
                                       .doc = "Writes a text, or a copy of another entry, to an "
                                              "entry.",
                                       .arity = {0, 0},
                                       .parameters = kSetParameters,
                                       .reads_ports = true},
                              .tick = tick_set,
                              .progress = no_progress};

const NodeKind kUnsetBlackboard{.type = {.id = "UnsetBlackboard",
                                         .category = NodeCategory::Action,
                                         .doc = "Removes an entry of this tree.",
                                         .arity = {0, 0},
                                         .parameters = kUnsetParameters,
                                         .reads_ports = true},
                                .tick = tick_unset,
                                .progress = no_progress};

}  // namespace lockstep::host::btcpp
