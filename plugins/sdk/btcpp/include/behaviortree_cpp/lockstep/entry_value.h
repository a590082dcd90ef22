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
  if constexpr (kType == LOCKSTEP_DOUBLE_LIST) {
    described.keep_list(kType, object);
  } else if constexpr (kType == LOCKSTEP_INT_LIST) {
    described.keep_list(kType, std::vector<std::int64_t>(object.begin(), object.end()));
  } else if constexpr (kType == LOCKSTEP_BOOL_LIST) {
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
inline bool describe(const Any& value, EntryValue& described) {
  if (value.empty()) return true;
  if (value.isString()) {
    auto text = std::make_shared<std::string>(value.cast<std::string>());
    described.it.type = LOCKSTEP_STRING;
    described.it.items = text->data();
    described.it.count = text->size();
    described.kept = std::move(text);
  } else if (value.isType<bool>() && value.isIntegral()) {
    described.it.type = LOCKSTEP_BOOL;
    described.it.flag = value.cast<bool>();
  } else if (value.isIntegral()) {
    const auto whole = value.tryCast<std::int64_t>();
    if (!whole) return false;
    described.it.type = LOCKSTEP_INT;
    described.it.whole = *whole;
  } else if (value.isNumber()) {
    described.it.type = LOCKSTEP_DOUBLE;
    described.it.number = value.cast<double>();
  } else {
    value.lockstep_describe(described);
  }
  return described.it.type != 0;
}

// What an entry of that type is declared as.
inline void declare(const TypeInfo& info, EntryValue& described) {
  described.it.declared = LOCKSTEP_ANY;
  if (!info.isStronglyTyped()) return;
  const PortValues& values = info.lockstep_values();
  described.it.declared = values.type;
  if (values.type == LOCKSTEP_OBJECT) described.it.object_type = values.object();
}

inline const KnownObject* find_object(const char* name) {
  if (name == nullptr) return nullptr;
  for (const auto* it = first_known_object().load(); it != nullptr; it = it->next) {
    if (StringView(it->type->name) == name) return it;
  }
  return nullptr;
}

template <class T>
Any list_value(const lockstep_entry_value& value) {
  const auto* const items = static_cast<const T*>(value.items);
  if constexpr (std::is_same_v<T, std::int64_t>) {
    return Any(std::vector<int>(items, items + value.count));
  } else {
    return Any(std::vector<T>(items, items + value.count));
  }
}

// Empty: there is no value, or an object of a type that this shared object does not use.
inline Any value_of(const lockstep_entry_value& value) {
  switch (value.type) {
    case LOCKSTEP_BOOL:
      return Any(value.flag);
    case LOCKSTEP_INT:
      return Any(value.whole);
    case LOCKSTEP_DOUBLE:
      return Any(value.number);
    case LOCKSTEP_STRING:
      return Any(std::string(static_cast<const char*>(value.items), value.count));
    case LOCKSTEP_DOUBLE_LIST:
      return list_value<double>(value);
    case LOCKSTEP_INT_LIST:
      return list_value<std::int64_t>(value);
    case LOCKSTEP_BOOL_LIST:
      return list_value<bool>(value);
    case LOCKSTEP_STRING_LIST: {
      std::vector<std::string> texts;
      const auto* const items = static_cast<const lockstep_text*>(value.items);
      for (std::size_t i = 0; i < value.count; ++i) {
        texts.emplace_back(items[i].text, items[i].length);
      }
      return Any(texts);
    }
    case LOCKSTEP_OBJECT: {
      const KnownObject* const known = find_object(value.object_name);
      if (known != nullptr && value.object != nullptr) return known->value(value.object);
      return {};
    }
    default:
      return {};
  }
}

// Whether `any` has it already: what is cheap to compare.
inline bool is_same_value(const Any& any, const lockstep_entry_value& value) {
  switch (value.type) {
    case LOCKSTEP_BOOL:
    case LOCKSTEP_INT:
      return !any.empty() && any.castedType() == typeid(std::int64_t) &&
             *any.castPtr<std::int64_t>() ==
                 (value.type == LOCKSTEP_BOOL ? std::int64_t{value.flag} : value.whole);
    case LOCKSTEP_DOUBLE:
      return any.castedType() == typeid(double) && *any.castPtr<double>() == value.number;
    case LOCKSTEP_STRING:
      return any.isString() && *any.castPtr<std::string>() ==
                                   StringView(static_cast<const char*>(value.items), value.count);
    case LOCKSTEP_OBJECT: {
      const KnownObject* const known = find_object(value.object_name);
      return known != nullptr && value.object != nullptr &&
             known->value(value.object).lockstep_object() == any.lockstep_object();
    }
    default:
      return false;
  }
}

// The type that an entry has for C++, when only the host knows it.
inline TypeInfo type_of_entry(const lockstep_entry_value& value) {
  switch (value.declared) {
    case LOCKSTEP_BOOL:
      return TypeInfo::Create<bool>();
    case LOCKSTEP_INT:
      return TypeInfo::Create<std::int64_t>();
    case LOCKSTEP_DOUBLE:
    case LOCKSTEP_NUMBER:
      return TypeInfo::Create<double>();
    case LOCKSTEP_STRING:
      return TypeInfo::Create<std::string>();
    case LOCKSTEP_DOUBLE_LIST:
      return TypeInfo::Create<std::vector<double>>();
    case LOCKSTEP_INT_LIST:
      return TypeInfo::Create<std::vector<int>>();
    case LOCKSTEP_BOOL_LIST:
      return TypeInfo::Create<std::vector<bool>>();
    case LOCKSTEP_STRING_LIST:
      return TypeInfo::Create<std::vector<std::string>>();
    case LOCKSTEP_OBJECT: {
      const KnownObject* const known = find_object(value.object_name);
      return known == nullptr ? TypeInfo() : known->info();
    }
    default:
      return {};
  }
}

}  // namespace BT::lockstep_detail
