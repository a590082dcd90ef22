// What a node of a plugin may ask about its place in the tree and its ports: lockstep_place.
#include "blackboard/conversion.h"
#include "engine/node_ports.h"
#include "engine/ticker.h"
#include "plugin/contract/host.h"
#include "plugin/contract/object_type.h"

namespace lockstep::host {
namespace {

const char* name(const lockstep_caller* caller) {
  return caller->name.c_str();
}

const char* id(const lockstep_caller* caller) {
  return caller->id.data();
}

const char* path(const lockstep_caller* caller) {
  return caller->who.data();
}

const ChildLabel* child_of(const lockstep_caller* caller, std::uint32_t child) {
  return child < caller->labels.size() ? &caller->labels[child] : nullptr;
}

const char* child_id(const lockstep_caller* caller, std::uint32_t child) {
  const ChildLabel* const label = child_of(caller, child);
  return label == nullptr ? nullptr : label->id.c_str();
}

const char* child_name(const lockstep_caller* caller, std::uint32_t child) {
  const ChildLabel* const label = child_of(caller, child);
  return label == nullptr ? nullptr : label->name.c_str();
}

BoundPort* port_of(const lockstep_caller* caller, std::uint32_t port) {
  if (caller->is_foreign() || port >= caller->ports.size()) return nullptr;
  return &mine(caller).ports[port];
}

const char* given(const lockstep_caller* caller, std::uint32_t port) {
  BoundPort* const it = port_of(caller, port);
  if (it == nullptr || (it->read == nullptr && it->entry.empty())) return nullptr;
  try {
    if (it->entry.empty()) {
      it->given = to_text(*it->read);
    } else {
      it->given = "{" + std::string(it->entry.substr(it->entry.rfind('/') + 1)) + "}";
    }
  } catch (const std::exception&) {
    return nullptr;
  }
  return it->given.c_str();
}

// The value that the port has now; null: none.
const Value* value_of(const BoundPort* port) {
  if (port == nullptr || port->read == nullptr) return nullptr;
  const bool is_empty = std::holds_alternative<NoValue>(*port->read);
  return is_empty ? port->fallback : port->read;
}

// The types of the contract have the numbers of the alternatives.
lockstep_type value_type(const lockstep_caller* caller, std::uint32_t port) {
  const Value* const value = value_of(port_of(caller, port));
  return value == nullptr ? 0 : static_cast<lockstep_type>(value->index());
}

// Null: it is none.
const ObjectType* object_type_of(const lockstep_caller* caller,
                                 const lockstep_object_type* declared) {
  const auto type = read_object_type(declared, caller->plugin_name);
  return type ? *type : nullptr;
}

bool get_object(const lockstep_caller* caller, std::uint32_t port,
                const lockstep_object_type* declared, void** object) {
  const Value* const value = value_of(port_of(caller, port));
  const auto* const found = value == nullptr ? nullptr : std::get_if<Object>(value);
  if (found == nullptr || declared == nullptr || found->type()->is_packed()) return false;
  if (found->type()->name() != declared->name) return false;
  *object = found->get();
  return true;
}

bool set_object(const lockstep_caller* caller, std::uint32_t port,
                const lockstep_object_type* declared, void* object) {
  const BoundPort* const it = port_of(caller, port);
  if (it == nullptr || it->write == nullptr || !it->is_generic || object == nullptr) return false;
  if (caller->written != nullptr) return false;  // it cannot leave this process
  try {
    const ObjectType* const type = object_type_of(caller, declared);
    if (type == nullptr) return false;
    type->retain(object);
    return write_entry(*it->write, ValueType::Object, type, Object(*type, object));
  } catch (const std::exception&) {
    return false;
  }
}

// As a port that is bound to it.
BoundPort opened_port(Entry& entry, std::string_view key) {
  BoundPort port{.type = ValueType::String};
  port.read = &entry.value;
  port.write = &entry;
  port.is_strict = false;
  port.is_generic = true;
  port.name = port.entry = key;
  return port;
}

std::uint32_t open(const lockstep_caller* caller, const char* text, std::size_t length) {
  if (caller->is_foreign() || !caller->opens_entries || caller->ticker == nullptr)
    return UINT32_MAX;
  const std::string_view key(text, length);
  std::vector<BoundPort>& ports = mine(caller).ports;
  const std::size_t first = ports.size() - caller->opened.size();
  for (std::size_t port = first; port < ports.size(); ++port) {
    if (ports[port].name == key) return static_cast<std::uint32_t>(port);
  }
  try {
    const std::string& kept = mine(caller).opened.emplace_back(key);
    ports.push_back(opened_port(caller->ticker->ports().at(caller->node, kept), kept));
  } catch (const std::exception&) {
    return UINT32_MAX;
  }
  return static_cast<std::uint32_t>(ports.size() - 1);
}

void unset(const lockstep_caller* caller, std::uint32_t port) {
  const BoundPort* const it = port_of(caller, port);
  if (it == nullptr || port < caller->ports.size() - caller->opened.size()) return;
  Entry* const own = caller->ticker->ports().own_at(caller->node, it->name);
  if (own != nullptr) unset_entry(*own);
}

void ask_for_tick(const lockstep_caller* caller) {
  if (caller->is_foreign() || caller->ticker == nullptr) return;
  const bool may_ask = caller->ticker->tree().rules->may_tick_again;
  if (may_ask) caller->ticker->ask_for_another_tick(caller->node);
}

}  // namespace

const lockstep_place& place_table() {
  static constexpr lockstep_place kTable{.struct_size = sizeof(lockstep_place),
                                         .name = name,
                                         .path = path,
                                         .id = id,
                                         .child_id = child_id,
                                         .child_name = child_name,
                                         .given = given,
                                         .value_type = value_type,
                                         .get_object = get_object,
                                         .set_object = set_object,
                                         .open = open,
                                         .unset = unset,
                                         .ask_for_tick = ask_for_tick};
  return kTable;
}

}  // namespace lockstep::host
