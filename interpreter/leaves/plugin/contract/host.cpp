#include "leaves/plugin/contract/host.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <new>
#include <utility>

#include "base/blackboard/conversion.h"
#include "base/core/parameter_value.h"
#include "base/core/utf8.h"
#include "base/core/value_types.h"
#include "base/core/version.h"
#include "base/core/wording.h"
#include "base/system/fork_guard.h"
#include "engine/node_context.h"
#include "leaves/plugin/contract/boards.h"
#include "leaves/plugin/contract/entry_value.h"
#include "leaves/plugin/contract/held.h"
#include "leaves/plugin/contract/packed_object.h"
#include "leaves/plugin/contract/workers.h"
#include "lockstep/value_types.h"

namespace lockstep::host {
namespace {

// False: the entry has a value that the port does not take, which is an error of the caller.
bool may_be_read(const lockstep_caller& caller, const BoundPort& port, const Value& value) {
  const auto why = refuse_value(*port.parameter, value);
  if (why) take_error(caller, Shortened(refusal_text(*why, port.name(), value, port.entry)));
  return !why;
}

void refuse_to_set(const lockstep_caller& caller, const BoundPort& port, std::string_view why) {
  take_error(caller, Shortened(fmt::format("cannot set '{}': {}", port.name(), why)));
}

// The same of a value that the caller sets.
bool may_be_set(const lockstep_caller& caller, const BoundPort& port, const Value& value) {
  const auto why = refuse_value(*port.parameter, value);
  if (why) refuse_to_set(caller, port, why->message + "; " + why->hint);
  return !why;
}

// The value of an entry that has another type than the port, as one of the port's; or null. Another
// type than the port's is no conversion, but an error of the caller.
const Value* converted(BoundPort& port, ValueType type) {
  if (port.is_generic) return nullptr;
  const bool is_number = type == ValueType::Int || type == ValueType::Double;
  if (port.type != type && !(port.type == ValueType::Number && is_number)) return nullptr;
  if (holds(*port.read, port.type)) return nullptr;  // the other kind of number
  auto value = convert_value(*port.read, port.type, port.object());
  if (!value) return nullptr;
  Value& kept = port.remembered().converted;
  kept = *std::move(value);
  return &kept;
}

bool is_of(const Value& value, ValueType type) {
  return value.index() == static_cast<std::size_t>(type);
}

// As `readable`, for what is not ordinary.
const Value* found_otherwise(const lockstep_caller& caller, BoundPort& port, ValueType type) {
  const Value* value = port.read;
  if (!is_of(*value, type)) {
    const bool is_empty = std::holds_alternative<NoValue>(*value);
    if (is_empty)
      return port.fallback != nullptr && is_of(*port.fallback, type) ? port.fallback : nullptr;
    value = converted(port, type);
    if (value == nullptr) return nullptr;
  }
  if (port.must_be_checked() && !may_be_read(caller, port, *value)) return nullptr;
  return value;
}

// The value of the port in the ordinary case, if it is a T; else null. The getters of numbers try
// this first and do the rest in another function, so that they need no stack.
template <class T>
inline const T* ordinary(const lockstep_caller* caller, std::uint32_t port) {
  if (caller->is_foreign() || port >= caller->ports.size()) [[unlikely]]
    return nullptr;
  const Value& value = *caller->ordinary[port];
  return std::get_if<T>(&value);
}

// Where other threads write entries, too, it is a copy.
[[gnu::noinline]] const Value* otherwise_readable(const lockstep_caller& caller, BoundPort& port,
                                                  ValueType type) {
  if (port.read == nullptr) return nullptr;
  if (caller.run->lock == nullptr) return found_otherwise(caller, port, type);
  const InEngine scope(caller.run->lock);
  const Value* const found = found_otherwise(caller, port, type);
  const bool may_change = found == port.read && !port.entry.empty();
  return may_change ? &(port.remembered().converted = *found) : found;
}

// The port's value when it has one of this type; else null.
inline const Value* readable(const lockstep_caller* caller, std::uint32_t port, ValueType type) {
  if (caller->is_foreign() || port >= caller->ports.size()) [[unlikely]]
    return nullptr;
  const Value* const value = caller->ordinary[port];
  if (is_of(*value, type)) [[likely]]
    return value;
  try {
    return otherwise_readable(*caller, *caller->ports[port], type);
  } catch (const std::exception&) {
    return nullptr;  // out of memory
  }
}

template <class T>
const T* readable(const lockstep_caller* caller, std::uint32_t port) {
  return std::get_if<T>(readable(caller, port, value_type_of<T>()));
}

template <class T>
[[gnu::noinline]] bool get_otherwise(const lockstep_caller* caller, std::uint32_t port, T* value) {
  const T* found = readable<T>(caller, port);
  if (found != nullptr) *value = *found;
  return found != nullptr;
}

template <class T>
bool get(const lockstep_caller* caller, std::uint32_t port, T* value) {
  const T* const found = ordinary<T>(caller, port);
  if (found == nullptr) [[unlikely]]
    return get_otherwise(caller, port, value);
  *value = *found;
  return true;
}

bool get_string(const lockstep_caller* caller, std::uint32_t port, const char** text,
                std::size_t* length) {
  const auto* found = readable<std::string>(caller, port);
  if (found == nullptr) return false;
  *text = found->c_str();
  *length = found->size();
  return true;
}

// A number is an int when the port is bound to an entry that is one, or has such a constant.
[[gnu::noinline]] bool get_double_otherwise(const lockstep_caller* caller, std::uint32_t port,
                                            double* value) {
  if (get_otherwise(caller, port, value)) return true;
  const auto* whole = readable<std::int64_t>(caller, port);
  if (whole == nullptr || caller->ports[port]->type != ValueType::Number) return false;
  *value = static_cast<double>(*whole);
  return true;
}

bool get(const lockstep_caller* caller, std::uint32_t port, double* value) {
  const double* const found = ordinary<double>(caller, port);
  if (found == nullptr) [[unlikely]]
    return get_double_otherwise(caller, port, value);
  *value = *found;
  return true;
}

template <class Item>
constexpr ValueType list_type_of() {
  return value_type_of<std::vector<ItemOf<Item>>>();
}

template <class Item>
bool get_list(const lockstep_caller* caller, std::uint32_t port, const Item** items,
              std::size_t* count) {
  static_assert(sizeof(ItemOf<Item>) == sizeof(Item));
  const auto* found = readable<std::vector<ItemOf<Item>>>(caller, port);
  if (found == nullptr) return false;
  *items = reinterpret_cast<const Item*>(found->data());
  *count = found->size();
  return true;
}

bool get_string_list(const lockstep_caller* caller, std::uint32_t port, const lockstep_text** items,
                     std::size_t* count) {
  const auto* found = readable<std::vector<std::string>>(caller, port);
  if (found == nullptr) return false;
  try {
    auto& texts = caller->ports[port]->remembered().texts;
    texts.clear();
    for (const std::string& text : *found) texts.push_back({text.c_str(), text.size()});
    *items = texts.data();
    *count = texts.size();
  } catch (const std::exception&) {
    return false;
  }
  return true;
}

void note_written(std::vector<Entry*>& written, Entry* entry) {
  if (std::ranges::find(written, entry) == written.end()) written.push_back(entry);
}

// The value that the caller is about to write; it is counted as written.
Value* writable(const lockstep_caller& caller, const BoundPort& port, ValueType type) {
  Entry* const entry = port.write;
  if (entry == nullptr || (port.is_generic ? entry->type : port.type) != type) return nullptr;
  if (caller.run->written != nullptr) note_written(*caller.run->written, entry);
  return &entry->to_write();
}

// The port is bound to an entry whose type may be another, or none.
bool is_loose(const BoundPort& port, ValueType type) {
  if (port.write == nullptr || port.write->typing == Typing::Strict) return false;
  return port.is_generic ? type != ValueType::Object : port.type == type;
}

// Sets such an entry to a value of this type.
bool set_loose(const lockstep_caller& caller, const BoundPort& port, ValueType type, Value value) {
  if (!write_entry(*port.write, type, port.object(), std::move(value))) {
    refuse_to_set(caller, port, refusal_of(*port.write, port.entry, type));
    return false;
  }
  if (caller.run->written != nullptr) note_written(*caller.run->written, port.write);
  return true;
}

// Sets the port to the value of this type that `make` gives. `assign` puts it into an entry of the
// type, without memory where it can.
template <class Make, class Assign>
bool store(const lockstep_caller& caller, const BoundPort& port, ValueType type, Make make,
           Assign assign) {
  const InEngine scope(caller.run->lock);
  const bool has_limits = port.has_limits && port.parameter->direction != Direction::Input;
  if (has_limits && !may_be_set(caller, port, make())) return false;
  if (is_loose(port, type)) return set_loose(caller, port, type, make());
  Value* const target = writable(caller, port, type);
  if (target != nullptr) assign(*target);
  return target != nullptr;
}

// The same where memory may be needed, of which there may be none.
template <class Make, class Assign>
bool try_to_store(const lockstep_caller* caller, std::uint32_t port, ValueType type, Make make,
                  Assign assign) {
  const BoundPort* const it = port_of(*caller, port);
  try {
    return it != nullptr && store(*caller, *it, type, make, assign);
  } catch (const std::exception&) {
    return false;  // out of memory, or a length that is none
  }
}

// Only an entry of lockstep's own language takes no NaN, and nothing infinite.
bool takes_any_number(const BoundPort& port, ValueType type) {
  return is_loose(port, type) || port.is_loose_there;
}

template <class T>
bool is_finite(T value) {
  if constexpr (std::is_floating_point_v<T>) return std::isfinite(value);
  return true;
}

template <class T>
[[gnu::noinline]] bool set_otherwise(const lockstep_caller& caller, const BoundPort& port,
                                     T value) {
  if (!is_finite(value) && !takes_any_number(port, value_type_of<T>())) return false;
  return store(
      caller, port, value_type_of<T>(), [=] { return Value(value); },
      [=](Value& target) { held<T>(target) = value; });
}

template <class T>
bool set(const lockstep_caller* caller, std::uint32_t port, T value) {
  const BoundPort* const it = port_of(*caller, port);
  if (it == nullptr) return false;
  Entry* const entry = it->write;
  if (it->has_limits) return set_otherwise(*caller, *it, value);
  if (entry == nullptr) return false;
  const bool is_ordinary = std::holds_alternative<T>(entry->value()) &&
                           it->type == value_type_of<T>() && !it->is_generic &&
                           entry->typing == Typing::Strict && caller->run->sets_plainly();
  if (!is_ordinary || !is_finite(value)) return set_otherwise(*caller, *it, value);
  entry->assign_same(value);
  return true;
}

bool set_string(const lockstep_caller* caller, std::uint32_t port, const char* text,
                std::size_t length) {
  if (text == nullptr && length != 0) return false;
  const char* const given = length == 0 ? "" : text;
  return try_to_store(
      caller, port, ValueType::String, [=] { return Value(std::string(given, length)); },
      // Also right when the text is (a part of) this entry's own.
      [=](Value& target) { held<std::string>(target).assign(given, length); });
}

template <class Item>
bool set_list(const lockstep_caller* caller, std::uint32_t port, const Item* items,
              std::size_t count) {
  using T = ItemOf<Item>;
  if (items == nullptr && count != 0) return false;
  const BoundPort* const it = port_of(*caller, port);
  const bool is_any = it != nullptr && takes_any_number(*it, list_type_of<Item>());
  if (!is_any && !std::all_of(items, items + count, is_finite<Item>)) return false;
  const auto* const values = reinterpret_cast<const T*>(items);
  const auto assign = [=](Value& target) {
    auto& list = held<std::vector<T>>(target);
    if (count > list.size()) {
      list.assign(values, values + count);
    } else {
      // `values` may be a part of this very list.
      if (count != 0) std::memmove(list.data(), values, count * sizeof(T));
      list.resize(count);
    }
  };
  return try_to_store(
      caller, port, list_type_of<Item>(),
      [=] { return Value(std::vector<T>(values, values + count)); }, assign);
}

bool set_string_list(const lockstep_caller* caller, std::uint32_t port, const lockstep_text* items,
                     std::size_t count) {
  if (items == nullptr && count != 0) return false;
  const auto is_text = [](const lockstep_text& it) { return it.text != nullptr || it.length == 0; };
  if (!std::all_of(items, items + count, is_text)) return false;
  const auto make = [=] {
    std::vector<std::string> list;  // the items may be texts of the entry's own list
    list.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      list.emplace_back(items[i].length == 0 ? "" : items[i].text, items[i].length);
    }
    return Value(std::move(list));
  };
  return try_to_store(caller, port, ValueType::StringList, make,
                      [=](Value& target) { target = make(); });
}

// An entry without a declared type may hold an object of any type.
bool is_of_type(const Object& object, const ObjectType* type) {
  return object.type() == type || (type != nullptr && object.type()->name() == type->name());
}

// An object of another process as one of the port's own type; null after an error.
const Object* unpacked(const lockstep_caller& caller, BoundPort& port, const Object& packed) {
  PortMemory& memory = port.remembered();
  if (memory.packed == packed) return &memory.unpacked;
  auto made = port.object()->from_bytes(PackedType::get(packed).bytes);
  if (!made) {
    take_error(caller,
               Shortened(fmt::format("cannot read '{}': {}", port.name(), made.error().message)));
    return nullptr;
  }
  memory.unpacked = *std::move(made);
  memory.packed = packed;
  return &memory.unpacked;
}

bool get_object(const lockstep_caller* caller, std::uint32_t port, void** object) {
  const auto* found = readable<Object>(caller, port);
  if (found == nullptr || !is_of_type(*found, caller->ports[port]->object())) return false;
  try {
    if (found->type()->is_packed()) found = unpacked(*caller, *caller->ports[port], *found);
  } catch (const std::exception&) {
    return false;
  }
  if (found != nullptr) *object = found->get();
  return found != nullptr;
}

// In a process that only mirrors the entries, an object is set as bytes. Nothing after an error.
std::optional<Object> settable(const lockstep_caller& caller, const BoundPort& port,
                               Object object) {
  if (caller.run->written == nullptr) return object;
  auto packed = pack(object, WithText::Yes);
  if (packed) return *std::move(packed);
  refuse_to_set(caller, port, packed.error().message);
  return std::nullopt;
}

bool set_object(const lockstep_caller* caller, std::uint32_t port, void* object) {
  const BoundPort* const it = port_of(*caller, port);
  if (object == nullptr || it == nullptr || it->object() == nullptr) return false;
  const InEngine scope(caller->run->lock);
  const bool loose = is_loose(*it, ValueType::Object);
  Value* const target = loose ? nullptr : writable(*caller, *it, ValueType::Object);
  if (!loose && target == nullptr) return false;
  const ObjectType& type = *it->object();
  type.retain(object);
  try {
    auto held = settable(*caller, *it, Object(type, object));
    if (!held) return false;
    if (loose) return set_loose(*caller, *it, ValueType::Object, *std::move(held));
    // The old value is released at the end: its release finds the entry as it will be.
    const Value before = std::exchange(*target, *std::move(held));
  } catch (const std::exception&) {
    return false;
  }
  return true;
}

void set_error(const lockstep_caller* caller, const char* message) {
  if (caller->is_foreign()) return;
  if (message == nullptr || *message == '\0') message = "unknown error";
  take_error(*caller, Shortened(message));
}

// A leaf knows its ports, only we know the entries.
std::string why_empty(const BoundPort& port) {
  std::string text = fmt::format("port '{}' has no value", port.name());
  if (port.entry.empty() || port.read == nullptr) return text;
  if (std::holds_alternative<NoValue>(*port.read)) {
    text += fmt::format(": nothing has written the entry '{{{}}}'", brief(port.entry));
  } else if (!convert_value(*port.read, port.type, port.object())) {
    text += fmt::format(": the entry '{{{}}}' has '{}', which is not {}", brief(port.entry),
                        brief(to_text(*port.read)), expected_text(port.type, port.object()));
  }
  return text;
}

void set_empty_port(const lockstep_caller* caller, std::uint32_t port) {
  if (caller->is_foreign()) return;
  const BoundPort* const it = port_of(*caller, port);
  if (it == nullptr) return take_error(*caller, Shortened("needs a port that it does not have"));
  const InEngine scope(caller->run->lock);
  take_error(*caller, Shortened(why_empty(*it)));
}

double now(const lockstep_caller* caller) {
  return caller->is_foreign() ? 0 : to_seconds(caller->time->now);
}
double tick_period(const lockstep_caller* caller) {
  return to_seconds(caller->time->period);
}

std::uint64_t random_bits(const lockstep_caller* caller) {
  return caller->is_foreign() ? 0 : mine(caller).random.next();
}
double random_double(const lockstep_caller* caller) {
  return caller->is_foreign() ? 0 : mine(caller).random.next_double();
}

void log(const lockstep_caller* caller, lockstep_log_level level, const char* message) {
  // A child that was forked off has neither the locks nor the threads that lines go through.
  if (!*caller->run->log || ForkGuard::is_child()) return;
  level = std::clamp<lockstep_log_level>(level, LOCKSTEP_LOG_DEBUG, LOCKSTEP_LOG_WARNING);
  try {
    const std::string_view text = message == nullptr ? "" : message;
    (*caller->run->log)(caller->who, level, utf8_front(text, kLongestLogLine));
  } catch (...) {  // NOLINT(bugprone-empty-catch): a lost line must not unwind through a plugin
  }
}

const void* get_extension(const char* id) {
  const std::string_view wanted = id == nullptr ? "" : id;
  if (wanted == LOCKSTEP_CHILDREN) return &children_table();
  if (wanted == LOCKSTEP_WORKERS) return &workers_table();
  if (wanted == LOCKSTEP_PLACE) return &place_table();
  if (wanted == LOCKSTEP_BOARDS) return &boards_table();
  if (wanted == LOCKSTEP_LASTING) return &lasting_table();
  if (wanted == LOCKSTEP_CHANGES) return &changes_table();
  if (wanted == LOCKSTEP_TICKS) return &ticks_table();
  if (wanted == LOCKSTEP_REASON) return &reason_table();
  return nullptr;
}

constexpr lockstep_host whole_table() {
  lockstep_host table{};
  table.abi_major = LOCKSTEP_ABI_MAJOR;
  table.abi_minor = LOCKSTEP_ABI_MINOR;
  table.struct_size = sizeof(lockstep_host);
  table.name = "lockstep";
  table.version = kVersion;
  // The types of the contract have the numbers of ours.
#define LOCKSTEP_ROW(TYPE, of_type, Item)                                    \
  static_assert(LOCKSTEP_##TYPE == static_cast<int>(value_type_of<Item>())); \
  table.get_##of_type = get;                                                 \
  table.set_##of_type = set;
  LOCKSTEP_PLAIN_TYPES(LOCKSTEP_ROW)
#undef LOCKSTEP_ROW
#define LOCKSTEP_ROW(TYPE, of_type, Item)                                   \
  static_assert(LOCKSTEP_##TYPE == static_cast<int>(list_type_of<Item>())); \
  table.get_##of_type = get_list<Item>;                                     \
  table.set_##of_type = set_list<Item>;
  LOCKSTEP_LIST_TYPES(LOCKSTEP_ROW)
#undef LOCKSTEP_ROW
  table.get_string = get_string;
  table.set_string = set_string;
  table.get_string_list = get_string_list;
  table.set_string_list = set_string_list;
  table.get_object = get_object;
  table.set_object = set_object;
  table.set_error = set_error;
  table.set_empty_port = set_empty_port;
  table.now = now;
  table.tick_period = tick_period;
  table.random_bits = random_bits;
  table.random = random_double;
  table.log = log;
  table.get_extension = get_extension;
  return table;
}

}  // namespace

void take_error(const lockstep_caller& caller, const Shortened& message) {
  lockstep_caller& it = mine(&caller);
  if (it.slot->error != nullptr) return;
  if (it.run->node_context != nullptr) it.run->node_context->note_error();
  if (it.rest == nullptr) it.rest.reset(new (std::nothrow) CallerRest);
  if (it.rest == nullptr) {
    it.slot->set_error("an error, and no memory is left for its text");
    return;
  }
  it.rest->error = message;
  it.slot->set_error(it.rest->error.c_str());
}

const Value* read_port(const lockstep_caller& caller, std::uint32_t port) {
  const ValueType type = caller.ports[port]->type;
  if (type != ValueType::Number) return readable(&caller, port, type);
  const Value* const number = readable(&caller, port, ValueType::Double);
  return number != nullptr ? number : readable(&caller, port, ValueType::Int);
}

bool write_port(const lockstep_caller& caller, std::uint32_t port, const Value& value) {
  const BoundPort* const it = port_of(caller, port);
  return it != nullptr && store(
                              caller, *it, static_cast<ValueType>(value.index()),
                              [&] { return value; }, [&](Value& target) { target = value; });
}

const lockstep_host& host_table() {
  static constexpr lockstep_host kTable = whole_table();
  return kTable;
}

}  // namespace lockstep::host
