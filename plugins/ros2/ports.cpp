#include "ports.hpp"

#include <cstring>

#include "message_object.hpp"

namespace ros2 {
namespace {

using Kind = Field::Kind;

// 0: no port carries it.
lockstep_type type_of(Kind kind, lockstep_direction direction) {
  switch (kind) {
    case Kind::Bool:
      return LOCKSTEP_BOOL;
    case Kind::Int:
      return LOCKSTEP_INT;
    case Kind::Double:
    case Kind::Duration:
      return direction == LOCKSTEP_INPUT ? LOCKSTEP_NUMBER : LOCKSTEP_DOUBLE;
    case Kind::String:
      return LOCKSTEP_STRING;
    case Kind::BoolList:
      return LOCKSTEP_BOOL_LIST;
    case Kind::IntList:
      return LOCKSTEP_INT_LIST;
    case Kind::DoubleList:
      return LOCKSTEP_DOUBLE_LIST;
    case Kind::StringList:
      return LOCKSTEP_STRING_LIST;
    case Kind::Time:
      return direction == LOCKSTEP_INPUT ? LOCKSTEP_STRING : 0;
    case Kind::Object:
      return LOCKSTEP_OBJECT;
    case Kind::Messages:
      return 0;
  }
  return 0;
}

}  // namespace

FieldPorts PortList::add(const std::string& prefix, const std::vector<Field>& fields,
                         lockstep_direction direction) {
  FieldPorts added;
  for (const Field& field : fields) {
    const std::string name =
        field.path.empty() ? prefix.substr(0, prefix.size() - 1) : prefix + field.path;
    // A short name may be that of another field.
    if (named_ == nullptr || named_->names.count(name) == 0) {
      add_one(name, field, direction, added);
    }
    if (named_ == nullptr) continue;
    for (const auto& [short_name, means] : named_->names) {
      if (means == name) add_one(short_name, field, direction, added);
    }
  }
  return added;
}

void PortList::add_one(const std::string& name, const Field& field, lockstep_direction direction,
                       FieldPorts& added) {
  constexpr std::size_t kMost = 4096;  // that a leaf type may have
  const lockstep_type type = type_of(field.kind, direction);
  if (type == 0 || list_.size() == kMost) return;
  lockstep_port& port = ports_.emplace_back();
  port.struct_size = sizeof port;
  port.type = type;
  port.direction = direction;
  port.name = names_.emplace_back(name).c_str();
  port.min = field.min;
  port.max = field.max;
  if (direction == LOCKSTEP_INPUT) port.flags = LOCKSTEP_OPTIONAL;
  if (named_ != nullptr) port.default_value = named_->default_of(name);
  if (field.kind == Kind::Duration) port.unit = "s";
  if (field.kind == Kind::Object) port.object = &object_type(*field.message);
  if (field.kind == Kind::Time) {
    port.choices = "now";
    port.doc = "now: the time at which the goal is sent.";
  }
  added.push_back({static_cast<std::uint32_t>(list_.size()), &field});
  list_.push_back(&port);
}

void PortList::give_to(lockstep_leaf_type& type) const {
  type.ports = list_.data();
  type.port_count = static_cast<std::uint32_t>(list_.size());
}

bool is_given(const lockstep_host& host, const lockstep_caller* caller, std::uint32_t port) {
  const auto* const place = static_cast<const lockstep_place*>(host.get_extension(LOCKSTEP_PLACE));
  return place->given(caller, port) != nullptr;
}

const lockstep_leaf_type* refuse(lockstep_refusal* why, const char* port, const Problem& problem) {
  thread_local Problem kept;
  kept = problem;
  why->port = port;
  why->message = kept.message.c_str();
  why->hint = kept.hint.empty() ? nullptr : kept.hint.c_str();
  return nullptr;
}

std::string fixed_text(const lockstep_fixed* fixed, std::uint32_t count, const char* port) {
  for (std::uint32_t i = 0; i < count; ++i) {
    if (std::strcmp(fixed[i].port, port) == 0) return fixed[i].text;
  }
  return {};
}

}  // namespace ros2
