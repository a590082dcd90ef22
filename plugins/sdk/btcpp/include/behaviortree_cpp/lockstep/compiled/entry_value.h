// The functions of entry_value.h. Included by it.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "behaviortree_cpp/lockstep/entry_value.h"

namespace BT::lockstep_detail {

LOCKSTEP_BTCPP_INLINE bool describe(const Any& value, EntryValue& described) {
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

LOCKSTEP_BTCPP_INLINE void declare(const TypeInfo& info, EntryValue& described) {
  described.it.declared = LOCKSTEP_ANY;
  if (!info.isStronglyTyped()) return;
  const PortValues& values = info.lockstep_values();
  described.it.declared = values.type;
  if (values.type == LOCKSTEP_OBJECT) described.it.object_type = values.object();
}

LOCKSTEP_BTCPP_INLINE const KnownObject* find_object(const char* name) {
  if (name == nullptr) return nullptr;
  for (const auto* it = first_known_object().load(); it != nullptr; it = it->next) {
    if (StringView(it->type->name) == name) return it;
  }
  return nullptr;
}

LOCKSTEP_BTCPP_INLINE Any value_of(const lockstep_entry_value& value) {
  switch (value.type) {
    case LOCKSTEP_BOOL:
      return Any(value.flag);
    case LOCKSTEP_INT:
      return Any(value.whole);
    case LOCKSTEP_DOUBLE:
      return Any(value.number);
    case LOCKSTEP_STRING:
      return Any(std::string(static_cast<const char*>(value.items), value.count));
#define LOCKSTEP_ROW(TYPE, of_type, Item) \
  case LOCKSTEP_##TYPE:                   \
    return list_value<Item>(value);
      LOCKSTEP_LIST_TYPES(LOCKSTEP_ROW)
#undef LOCKSTEP_ROW
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

LOCKSTEP_BTCPP_INLINE bool is_same_value(const Any& any, const lockstep_entry_value& value) {
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

LOCKSTEP_BTCPP_INLINE TypeInfo type_of_entry(const lockstep_entry_value& value) {
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
// NOLINTBEGIN(bugprone-macro-parentheses): it is a type
#define LOCKSTEP_ROW(TYPE, of_type, Item) \
  case LOCKSTEP_##TYPE:                   \
    return TypeInfo::Create<ListOf<Item>>();
      LOCKSTEP_LIST_TYPES(LOCKSTEP_ROW)
#undef LOCKSTEP_ROW
      // NOLINTEND(bugprone-macro-parentheses)
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
