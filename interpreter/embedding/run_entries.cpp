// The entries of a lockstep_run, by key and by index.
#include <fmt/format.h>
#include <lockstep/value_types.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "base/core/parameter_value.h"
#include "base/core/value_types.h"
#include "embedding/run_handle.h"

namespace lockstep::host::embedding {
namespace {

// An entry of a run, which its program names by key or by index. Null: there is an error.
Entry* find_entry(lockstep_run* run, const char* key) {
  if (run == nullptr) fail("an argument is NULL");
  if (run == nullptr) return nullptr;
  const auto slot = find_slot(tree_of(*run), key);
  return slot ? &run->run.blackboard().entries[*slot] : nullptr;
}

Entry* find_entry(lockstep_run* run, std::uint32_t index) {
  if (run == nullptr) fail("an argument is NULL");
  if (run == nullptr) return nullptr;
  auto& entries = run->run.blackboard().entries;
  if (index < entries.size()) return &entries[index];
  fail("no such entry");
  return nullptr;
}

const std::string& key_of(lockstep_run& run, const Entry& entry) {
  return tree_of(run).slots[&entry - run.run.blackboard().entries.data()].name;
}

bool fail_to_read(lockstep_run& run, const Entry& entry) {
  const std::string& key = key_of(run, entry);
  return fail(entry.has_value() ? fmt::format("the entry '{}' has another type", key)
                                : fmt::format("nothing has written the entry '{}'", key));
}

// Whether the entry is for objects of this type, in the memory of this process.
bool has_objects(lockstep_run& run, const Entry& entry, const lockstep_object_type* type) {
  if (type == nullptr || type->name == nullptr) return fail("an argument is NULL");
  if (entry.object == nullptr || entry.object->name() != type->name) {
    return fail(fmt::format("the entry '{}' is of type {}, not {}", key_of(run, entry),
                            type_name(entry.type, entry.object), type->name));
  }
  return !entry.object->is_packed() ||
         fail(fmt::format("the objects of the entry '{}' are in another process",
                          key_of(run, entry)));
}

// The value of the entry, if it is one of type T; else there is an error.
template <class T, class Where>
const T* find_value(lockstep_run* run, Where where) {
  const Entry* const entry = find_entry(run, where);
  if (entry == nullptr) return nullptr;
  const T* const found = std::get_if<T>(&entry->value());
  if (found == nullptr) fail_to_read(*run, *entry);
  return found;
}

template <class T, class Where>
bool get(lockstep_run* run, Where where, T* value) {
  return guarded([&] {
    const InEngine scope(lock_of(run));
    if (value == nullptr) return fail("an argument is NULL");
    const T* const found = find_value<T>(run, where);
    if (found != nullptr) *value = *found;
    return found != nullptr;
  });
}

// A whole number is also a real one.
template <class Where>
bool get(lockstep_run* run, Where where, double* value) {
  return guarded([&] {
    const InEngine scope(lock_of(run));
    if (value == nullptr) return fail("an argument is NULL");
    const Entry* const entry = find_entry(run, where);
    if (entry == nullptr) return false;
    const auto* const whole = std::get_if<std::int64_t>(&entry->value());
    if (whole != nullptr) {
      *value = static_cast<double>(*whole);
      return true;
    }
    const auto* const number = std::get_if<double>(&entry->value());
    if (number == nullptr) return fail_to_read(*run, *entry);
    *value = *number;
    return true;
  });
}

template <class Item, class Where>
bool get_list(lockstep_run* run, Where where, const Item** items, std::size_t* count) {
  static_assert(sizeof(ItemOf<Item>) == sizeof(Item));
  return guarded([&] {
    const InEngine scope(lock_of(run));
    if (items == nullptr || count == nullptr) return fail("an argument is NULL");
    const auto* const found = find_value<std::vector<ItemOf<Item>>>(run, where);
    if (found == nullptr) return false;
    *items = reinterpret_cast<const Item*>(found->data());
    *count = found->size();
    return true;
  });
}

bool write(Entry& entry, Value value) {
  entry.assign(std::move(value));
  return true;
}

template <class T>
bool is_finite(const T& value) {
  if constexpr (std::is_floating_point_v<T>) return std::isfinite(value);
  return true;
}
template <class Item>
bool is_finite(const std::vector<Item>& values) {
  return std::ranges::all_of(values, [](const Item& it) { return is_finite(it); });
}

template <class T, class Where>
bool put(lockstep_run* run, Where where, T value) {
  return guarded([&] {
    const InEngine scope(lock_of(run));
    Entry* const entry = find_entry(run, where);
    if (entry == nullptr) return false;
    if (entry->typing == Typing::Any) return write(*entry, Value(std::move(value)));
    if (!holds(Value(value), entry->type)) {
      return fail(fmt::format("the entry '{}' is of type {}", key_of(*run, *entry),
                              type_name(entry->type, entry->object)));
    }
    const bool is_strict = entry->typing == Typing::Strict;
    if (is_strict && !is_finite(value)) return fail("a number must be finite");
    return write(*entry, Value(std::move(value)));
  });
}

template <class T, class Where>
bool set(lockstep_run* run, Where where, T value) {
  return put(run, where, std::move(value));
}

// A whole number where the entry has a real one: the nearest. An entry that may also have the whole
// number keeps that, if no real one is the same.
template <class Where>
bool set(lockstep_run* run, Where where, std::int64_t value) {
  constexpr auto kExact = std::int64_t{1} << std::numeric_limits<double>::digits;
  const bool is_exact = value <= kExact && value >= -kExact;
  const bool is_real = guarded([&] {
    const InEngine scope(lock_of(run));
    const Entry* const entry = find_entry(run, where);
    return entry != nullptr && (entry->typing == Typing::Any
                                    ? is_exact && std::holds_alternative<double>(entry->value())
                                    : entry->type == ValueType::Double);
  });
  return is_real ? put(run, where, static_cast<double>(value)) : put(run, where, value);
}

template <class Item, class Where>
bool set_list(lockstep_run* run, Where where, const Item* items, std::size_t count) {
  using T = ItemOf<Item>;
  return guarded([&] {
    if (items == nullptr && count != 0) return fail("an argument is NULL");
    const auto* const first = reinterpret_cast<const T*>(items);
    return put(run, where, std::vector<T>(first, first + count));
  });
}

template <class Where>
bool get_text(lockstep_run* run, Where where, lockstep_text* text) {
  return guarded([&] {
    const InEngine scope(lock_of(run));
    if (text == nullptr) return fail("an argument is NULL");
    const Entry* const entry = find_entry(run, where);
    if (entry == nullptr) return false;
    if (!entry->has_value()) return fail_to_read(*run, *entry);
    run->text = to_text(entry->value());
    *text = {run->text.c_str(), run->text.size()};
    return true;
  });
}

template <class Where>
const char* get_text(lockstep_run* run, Where where) {
  lockstep_text text{};
  return get_text(run, where, &text) ? text.text : nullptr;
}

template <class Where>
bool set_text(lockstep_run* run, Where where, const char* text, std::size_t length) {
  return guarded([&] {
    const InEngine scope(lock_of(run));
    if (!is_text("the text", text, length)) return false;
    Entry* const entry = find_entry(run, where);
    if (entry == nullptr) return false;
    auto value = parse_value(entry->type, entry->object, {text, length});
    if (!value) {
      return fail(fmt::format("the entry '{}' is of type {}: expected {}", key_of(*run, *entry),
                              type_name(entry->type, entry->object),
                              expected_text(entry->type, entry->object)));
    }
    return write(*entry, std::move(*value));
  });
}

template <class Where>
bool set_text(lockstep_run* run, Where where, const char* text) {
  return set_text(run, where, text, text == nullptr ? 0 : std::strlen(text));
}

template <class Where>
bool get_text_list(lockstep_run* run, Where where, const lockstep_text** values,
                   std::size_t* count) {
  return guarded([&] {
    const InEngine scope(lock_of(run));
    if (values == nullptr || count == nullptr) return fail("an argument is NULL");
    const auto* const found = find_value<std::vector<std::string>>(run, where);
    if (found == nullptr) return false;
    run->texts.clear();
    for (const std::string& text : *found) run->texts.push_back({text.c_str(), text.size()});
    *values = run->texts.data();
    *count = run->texts.size();
    return true;
  });
}

template <class Where>
bool set_text_list(lockstep_run* run, Where where, const lockstep_text* values, std::size_t count) {
  return guarded([&] {
    if (values == nullptr && count != 0) return fail("an argument is NULL");
    std::vector<std::string> texts;
    for (std::size_t i = 0; i < count; ++i) {
      if (values[i].text == nullptr && values[i].length != 0) return fail("a text is NULL");
      const bool is_empty = values[i].length == 0;
      if (!is_empty && !is_text("a text", values[i].text, values[i].length)) return false;
      texts.emplace_back(is_empty ? "" : values[i].text, values[i].length);
    }
    return put(run, where, std::move(texts));
  });
}

template <class Where>
lockstep_type value_type(lockstep_run* run, Where where) {
  return guarded([&]() -> lockstep_type {
    const InEngine scope(lock_of(run));
    const Entry* const entry = find_entry(run, where);
    // The types of the contract have the numbers of the alternatives.
    return entry == nullptr ? 0 : static_cast<lockstep_type>(entry->value().index());
  });
}

// An object, which must have the type that the program knows.
template <class Where>
void* get_object(lockstep_run* run, Where where, const lockstep_object_type* type) {
  return guarded([&]() -> void* {
    const InEngine scope(lock_of(run));
    const Entry* const entry = find_entry(run, where);
    if (entry == nullptr || !has_objects(*run, *entry, type)) return nullptr;
    const Object* const found = std::get_if<Object>(&entry->value());
    if (found == nullptr) fail_to_read(*run, *entry);
    return found == nullptr ? nullptr : found->get();
  });
}

template <class Where>
bool set_object(lockstep_run* run, Where where, const lockstep_object_type* type, void* object) {
  return guarded([&] {
    const InEngine scope(lock_of(run));
    if (object == nullptr) return fail("an argument is NULL");
    Entry* const entry = find_entry(run, where);
    if (entry == nullptr || !has_objects(*run, *entry, type)) return false;
    entry->object->retain(object);
    return write(*entry, Object(*entry->object, object));
  });
}

}  // namespace
}  // namespace lockstep::host::embedding

using namespace lockstep::host;
using namespace lockstep::host::embedding;

// Each function exists twice: for an entry by its key, and by its index.

// NOLINTBEGIN(bugprone-macro-parentheses): it is a type
#define LOCKSTEP_ROW(TYPE, of_type, Item)                                                \
  bool lockstep_run_get_##of_type(lockstep_run* run, const char* key, Item* value) {     \
    return get(run, key, value);                                                         \
  }                                                                                      \
  bool lockstep_run_get_##of_type##_at(lockstep_run* run, uint32_t entry, Item* value) { \
    return get(run, entry, value);                                                       \
  }                                                                                      \
  bool lockstep_run_set_##of_type(lockstep_run* run, const char* key, Item value) {      \
    return set(run, key, value);                                                         \
  }                                                                                      \
  bool lockstep_run_set_##of_type##_at(lockstep_run* run, uint32_t entry, Item value) {  \
    return set(run, entry, value);                                                       \
  }
// NOLINTEND(bugprone-macro-parentheses)
LOCKSTEP_PLAIN_TYPES(LOCKSTEP_ROW)
#undef LOCKSTEP_ROW

#define LOCKSTEP_ROW(TYPE, of_type, Item)                                                      \
  bool lockstep_run_get_##of_type(lockstep_run* run, const char* key, const Item** values,     \
                                  size_t* count) {                                             \
    return get_list(run, key, values, count);                                                  \
  }                                                                                            \
  bool lockstep_run_get_##of_type##_at(lockstep_run* run, uint32_t entry, const Item** values, \
                                       size_t* count) {                                        \
    return get_list(run, entry, values, count);                                                \
  }                                                                                            \
  bool lockstep_run_set_##of_type(lockstep_run* run, const char* key, const Item* values,      \
                                  size_t count) {                                              \
    return set_list(run, key, values, count);                                                  \
  }                                                                                            \
  bool lockstep_run_set_##of_type##_at(lockstep_run* run, uint32_t entry, const Item* values,  \
                                       size_t count) {                                         \
    return set_list(run, entry, values, count);                                                \
  }
LOCKSTEP_LIST_TYPES(LOCKSTEP_ROW)
#undef LOCKSTEP_ROW

const char* lockstep_run_get_text(lockstep_run* run, const char* key) {
  return get_text(run, key);
}
bool lockstep_run_get_sized_text(lockstep_run* run, const char* key, lockstep_text* text) {
  return get_text(run, key, text);
}
bool lockstep_run_set_sized_text(lockstep_run* run, const char* key, const char* text,
                                 size_t length) {
  return set_text(run, key, text, length);
}
bool lockstep_run_get_text_list(lockstep_run* run, const char* key, const lockstep_text** values,
                                size_t* count) {
  return get_text_list(run, key, values, count);
}
bool lockstep_run_set_text(lockstep_run* run, const char* key, const char* text) {
  return set_text(run, key, text);
}
bool lockstep_run_set_text_list(lockstep_run* run, const char* key, const lockstep_text* values,
                                size_t count) {
  return set_text_list(run, key, values, count);
}
lockstep_type lockstep_run_value_type(lockstep_run* run, const char* key) {
  return value_type(run, key);
}

const char* lockstep_run_get_text_at(lockstep_run* run, uint32_t entry) {
  return get_text(run, entry);
}
bool lockstep_run_get_sized_text_at(lockstep_run* run, uint32_t entry, lockstep_text* text) {
  return get_text(run, entry, text);
}
bool lockstep_run_set_sized_text_at(lockstep_run* run, uint32_t entry, const char* text,
                                    size_t length) {
  return set_text(run, entry, text, length);
}
bool lockstep_run_get_text_list_at(lockstep_run* run, uint32_t entry, const lockstep_text** values,
                                   size_t* count) {
  return get_text_list(run, entry, values, count);
}
bool lockstep_run_set_text_at(lockstep_run* run, uint32_t entry, const char* text) {
  return set_text(run, entry, text);
}
bool lockstep_run_set_text_list_at(lockstep_run* run, uint32_t entry, const lockstep_text* values,
                                   size_t count) {
  return set_text_list(run, entry, values, count);
}
lockstep_type lockstep_run_value_type_at(lockstep_run* run, uint32_t entry) {
  return value_type(run, entry);
}

void* lockstep_run_get_object(lockstep_run* run, const char* key,
                              const lockstep_object_type* type) {
  return get_object(run, key, type);
}
bool lockstep_run_set_object(lockstep_run* run, const char* key, const lockstep_object_type* type,
                             void* object) {
  return set_object(run, key, type, object);
}
void* lockstep_run_get_object_at(lockstep_run* run, uint32_t entry,
                                 const lockstep_object_type* type) {
  return get_object(run, entry, type);
}
bool lockstep_run_set_object_at(lockstep_run* run, uint32_t entry, const lockstep_object_type* type,
                                void* object) {
  return set_object(run, entry, type, object);
}
