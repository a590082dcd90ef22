// The functions with which a node of a plugin asks about its place in the tree and its ports:
// lockstep_place.
#include "engine/node_ports.h"
#include "engine/tree.h"
#include "leaves/plugin/contract/host.h"
#include "leaves/plugin/contract/object_type.h"
#include "leaves/plugin/contract/wake_up.h"

namespace lockstep::host {

const NodeTexts& TextsOnDemand::set(NodeTexts texts) {
  auto made = std::make_unique<const NodeTexts>(std::move(texts));
  const NodeTexts* first = nullptr;
  const bool is_first = texts_.compare_exchange_strong(first, made.get());
  return is_first ? *made.release() : *first;
}

const NodeTexts& texts_of(const lockstep_caller& caller) {
  if (const NodeTexts* const made = caller.texts.get()) return *made;
  const Tree& tree = *caller.run->tree;
  NodeTexts texts{.name = std::string(tree.labels[caller.node].name)};
  for (std::uint32_t child = 0; child < caller.children; ++child) {
    const NodeLabel& label = tree.labels[caller.child(child)];
    texts.children.push_back({std::string(label.type->id), std::string(label.name)});
  }
  return mine(&caller).texts.set(std::move(texts));
}

namespace {

const char* name(const lockstep_caller* caller) {
  return caller->type == nullptr ? "" : texts_of(*caller).name.c_str();
}

const char* id(const lockstep_caller* caller) {
  return caller->type == nullptr ? nullptr : caller->type->leaf->id;
}

const char* language(const lockstep_caller* caller) {
  const Tree* const tree = caller->run == nullptr ? nullptr : caller->run->tree;
  return tree == nullptr ? nullptr : tree->rules->root_attribute.data();  // of a literal
}

const char* path(const lockstep_caller* caller) {
  return caller->who;
}

const NodeTexts::Child* child_of(const lockstep_caller* caller, std::uint32_t child) {
  return child < caller->children ? &texts_of(*caller).children[child] : nullptr;
}

const char* child_id(const lockstep_caller* caller, std::uint32_t child) {
  const NodeTexts::Child* const it = child_of(caller, child);
  return it == nullptr ? nullptr : it->id.c_str();
}

const char* child_name(const lockstep_caller* caller, std::uint32_t child) {
  const NodeTexts::Child* const it = child_of(caller, child);
  return it == nullptr ? nullptr : it->name.c_str();
}

const char* given(const lockstep_caller* caller, std::uint32_t port) {
  BoundPort* const it = port_of(*caller, port);
  if (it == nullptr || (it->read == nullptr && it->entry.empty())) return nullptr;
  try {
    std::string& given = it->remembered().given;
    if (it->entry.empty()) {
      given = to_text(*it->read);
    } else {
      given = "{" + std::string(it->entry.substr(it->entry.rfind('/') + 1)) + "}";
    }
    return given.c_str();
  } catch (const std::exception&) {
    return nullptr;
  }
}

// The types of the contract have the numbers of the alternatives.
lockstep_type value_type(const lockstep_caller* caller, std::uint32_t port) {
  const InEngine scope(caller->run->lock);
  const BoundPort* const it = port_of(*caller, port);
  const Value* const value = it == nullptr ? nullptr : it->value();
  return value == nullptr ? 0 : static_cast<lockstep_type>(value->index());
}

// Null: it is none.
const ObjectType* object_type_of(const lockstep_caller* caller,
                                 const lockstep_object_type* declared) {
  const auto type = read_object_type(declared, caller->type->plugin);
  return type ? *type : nullptr;
}

bool get_object(const lockstep_caller* caller, std::uint32_t port,
                const lockstep_object_type* declared, void** object) {
  const InEngine scope(caller->run->lock);
  const BoundPort* const it = port_of(*caller, port);
  const Value* const value = it == nullptr ? nullptr : it->value();
  const auto* const found = value == nullptr ? nullptr : std::get_if<Object>(value);
  if (found == nullptr || declared == nullptr || found->type()->is_packed()) return false;
  if (found->type()->name() != declared->name) return false;
  *object = found->get();
  return true;
}

bool set_object(const lockstep_caller* caller, std::uint32_t port,
                const lockstep_object_type* declared, void* object) {
  const BoundPort* const it = port_of(*caller, port);
  if (it == nullptr || it->write == nullptr || !it->is_generic || object == nullptr) return false;
  if (caller->run->written != nullptr) return false;  // it cannot leave this process
  try {
    const ObjectType* const type = object_type_of(caller, declared);
    if (type == nullptr) return false;
    const InEngine scope(caller->run->lock);
    type->retain(object);
    return write_entry(*it->write, ValueType::Object, type, Object(*type, object));
  } catch (const std::exception&) {
    return false;
  }
}

// As a port that is bound to it.
BoundPort opened_port(Entry& entry, std::string_view key) {
  return {.read = &entry.value(),
          .write = &entry,
          .entry = key,
          .is_strict = false,
          .is_generic = true};
}

// How many ports the tree gives to the node.
std::size_t first_opened(const lockstep_caller& caller) {
  return caller.type == nullptr ? 0 : caller.type->parameters.size();
}

bool may_open(const lockstep_caller& caller) {
  if (caller.is_foreign() || caller.run->node_context == nullptr || caller.type == nullptr)
    return false;
  return caller.type->opens_entries && !caller.run->tree->boards.empty();
}

// The ports of the caller become its own, with another one.
void open_port(lockstep_caller& caller, std::string_view key) {
  if (caller.rest == nullptr) caller.rest = std::make_unique<CallerRest>();
  CallerRest& rest = *caller.rest;
  if (rest.ports.size() == 0) {
    if (caller.run->lock != nullptr) rest.ports.hide_entries();
    rest.ports.reserve(caller.ports.size() + 1);
    for (BoundPort* const port : caller.ports) rest.ports.share(*port);
    rest.ports.give_to(caller);
  }
  const std::string& kept = rest.opened.emplace_back(key);
  rest.ports.add(opened_port(caller.run->node_context->ports().at(caller.node, kept), kept));
  rest.ports.give_to(caller);
}

std::uint32_t open(const lockstep_caller* caller, const char* text, std::size_t length) {
  if (!may_open(*caller)) return UINT32_MAX;
  const std::string_view key(text, length);
  for (std::size_t port = first_opened(*caller); port < caller->ports.size(); ++port) {
    if (caller->ports[port]->entry == key) return static_cast<std::uint32_t>(port);
  }
  try {
    const InEngine scope(caller->run->lock);
    open_port(mine(caller), key);
  } catch (const std::exception&) {
    return UINT32_MAX;
  }
  return static_cast<std::uint32_t>(caller->ports.size() - 1);
}

void unset(const lockstep_caller* caller, std::uint32_t port) {
  const BoundPort* const it = port_of(*caller, port);
  if (it == nullptr || port < first_opened(*caller)) return;
  const InEngine scope(caller->run->lock);
  Entry* const own = caller->run->node_context->ports().own_at(caller->node, it->entry);
  if (own != nullptr) unset_entry(*own);
}

void ask_for_tick(const lockstep_caller* caller) {
  if (caller->is_foreign() || caller->run->node_context == nullptr) return;
  const bool may_ask = caller->run->node_context->tree().rules->may_tick_again;
  if (may_ask) caller->run->node_context->ask_for_another_tick(caller->node);
}

const void* data(const lockstep_caller* caller) {
  return caller->type == nullptr ? nullptr : caller->type->leaf->data;
}

void wake(const lockstep_caller* caller) {
  WakeUp* const wake_up = caller->time->wake_up;
  if (wake_up != nullptr) wake_up->wake();
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
                                         .ask_for_tick = ask_for_tick,
                                         .wake = wake,
                                         .data = data,
                                         .language = language};
  return kTable;
}

}  // namespace lockstep::host
