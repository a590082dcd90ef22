// Values of entries, as the host has them and as BT::Any has them.
#pragma once

#include <lockstep/leaf.h>

#include <cstdint>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "behaviortree_cpp/basic_types.h"
#include "behaviortree_cpp/lockstep/port_value.h"

namespace BT::lockstep_detail {

// With what it points to.
struct EntryValue {
  lockstep_entry_value it{};
  std::shared_ptr<void> kept = {};

  EntryValue() { it.struct_size = sizeof it; }

  template <class T>
  void keep_list(lockstep_type type, std::vector<T> list) {
    auto owned = std::make_shared<std::vector<T>>(std::move(list));
    it.type = type;
    it.items = owned->data();
    it.count = owned->size();
    kept = std::move(owned);
  }
};

template <class T>
void describe_object(const std::shared_ptr<void>& value, EntryValue& described) {
  constexpr lockstep_type kType = port_type<T>();
  const T& object = *static_cast<const T*>(value.get());
  if constexpr (kType == LOCKSTEP_BOOL_LIST) {
    const std::size_t count = object.size();
    const std::shared_ptr<bool[]> flags(new bool[count == 0 ? 1 : count]);
    for (std::size_t i = 0; i < count; ++i) flags[i] = object[i];
    described.it.type = kType;
    described.it.items = flags.get();
    described.it.count = count;
    described.kept = flags;
  } else if constexpr (kType == LOCKSTEP_STRING_LIST) {
    std::vector<lockstep_text> texts;
    for (const std::string& text : object) texts.push_back({text.data(), text.size()});
    described.keep_list(kType, std::move(texts));  // they point into `value`
  } else if constexpr (list_type<T>() != LOCKSTEP_OBJECT) {
    described.keep_list(kType, HostList<T>(object.begin(), object.end()));
  } else if constexpr (kType == LOCKSTEP_OBJECT) {
    using Holder = lockstep::detail::ObjectHolder<T>;
    auto* const holder = new Holder{std::static_pointer_cast<const T>(value)};
    described.it.type = kType;
    described.it.object = holder;
    described.it.object_type = object_type<T>();
    described.kept = {holder, [](void* it) { ObjectCalls<T>::Common::release(it); }};
  }
}

// False: the host has no such value.
bool describe(const Any& value, EntryValue& described);

// Describes an entry of that type.
void declare(const TypeInfo& info, EntryValue& described);

const KnownObject* find_object(const char* name);

template <class T>
Any list_value(const lockstep_entry_value& value) {
  const auto* const items = static_cast<const T*>(value.items);
  return Any(ListOf<T>(items, items + value.count));
}

// Empty: there is no value, or an object of a type that this shared object does not use.
Any value_of(const lockstep_entry_value& value);

// Whether `any` has it already: what is cheap to compare.
bool is_same_value(const Any& any, const lockstep_entry_value& value);

// The type that an entry has for C++, when only the host knows it.
TypeInfo type_of_entry(const lockstep_entry_value& value);

}  // namespace BT::lockstep_detail

#if LOCKSTEP_BTCPP_HAS_FUNCTIONS
#include "behaviortree_cpp/lockstep/compiled/entry_value.h"  // IWYU pragma: export
#endif
