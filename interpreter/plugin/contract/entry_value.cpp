#include "plugin/contract/entry_value.h"

#include <optional>
#include <utility>

#include "plugin/contract/object_type.h"

namespace lockstep::host {
namespace {

static_assert(sizeof(Flag) == sizeof(bool));

template <class T>
void describe_list(const std::vector<T>& list, lockstep_entry_value& value) {
  value.items = list.data();
  value.count = list.size();
}

void describe(const Object& object, lockstep_entry_value& value) {
  value.object_name = object.type()->name().data();
  if (object.type()->is_packed()) {
    value.type = 0;
  } else {
    value.object = object.get();
  }
}

void describe(const Value& from, lockstep_entry_value& value, std::vector<lockstep_text>& texts) {
  // The types of the contract have the numbers of the alternatives.
  value.type = static_cast<lockstep_type>(from.index());
  if (const auto* flag = std::get_if<bool>(&from)) value.flag = *flag;
  if (const auto* whole = std::get_if<std::int64_t>(&from)) value.whole = *whole;
  if (const auto* number = std::get_if<double>(&from)) value.number = *number;
  if (const auto* text = std::get_if<std::string>(&from)) {
    value.items = text->c_str();
    value.count = text->size();
  }
  if (const auto* list = std::get_if<std::vector<double>>(&from)) describe_list(*list, value);
  if (const auto* list = std::get_if<std::vector<std::int64_t>>(&from)) describe_list(*list, value);
  if (const auto* list = std::get_if<std::vector<Flag>>(&from)) describe_list(*list, value);
  if (const auto* list = std::get_if<std::vector<std::string>>(&from)) {
    texts.clear();
    for (const std::string& text : *list) texts.push_back({text.c_str(), text.size()});
    describe_list(texts, value);
  }
  if (const auto* object = std::get_if<Object>(&from)) describe(*object, value);
}

template <class T>
Value list_of(const lockstep_entry_value& value) {
  const auto* const items = static_cast<const T*>(value.items);
  return std::vector<T>(items, items + value.count);
}

Value text_list_of(const lockstep_entry_value& value) {
  std::vector<std::string> texts;
  const auto* const items = static_cast<const lockstep_text*>(value.items);
  for (std::size_t i = 0; i < value.count; ++i) texts.emplace_back(items[i].text, items[i].length);
  return texts;
}

// Nothing: it is no value.
std::optional<Value> value_of(const lockstep_entry_value& value, const ObjectType* type) {
  switch (value.type) {
    case LOCKSTEP_BOOL:
      return Value(value.flag);
    case LOCKSTEP_INT:
      return Value(value.whole);
    case LOCKSTEP_DOUBLE:
      return Value(value.number);
    case LOCKSTEP_STRING:
      return Value(std::string(static_cast<const char*>(value.items), value.count));
    case LOCKSTEP_DOUBLE_LIST:
      return list_of<double>(value);
    case LOCKSTEP_INT_LIST:
      return list_of<std::int64_t>(value);
    case LOCKSTEP_BOOL_LIST:
      return list_of<Flag>(value);
    case LOCKSTEP_STRING_LIST:
      return text_list_of(value);
    default:
      break;
  }
  if (value.type != LOCKSTEP_OBJECT || type == nullptr || value.object == nullptr) {
    return std::nullopt;
  }
  type->retain(value.object);
  return Value(Object(*type, value.object));
}

// Gives the entry its declared type.
void declare(Entry& entry, lockstep_type declared, const ObjectType* object) {
  entry.is_present = true;
  const bool is_any = declared == LOCKSTEP_ANY || declared == 0;
  entry.typing = is_any ? Typing::Any : Typing::Declared;
  entry.type = is_any ? ValueType::String : static_cast<ValueType>(declared);
  entry.object = is_any ? nullptr : object;
}

}  // namespace

lockstep_entry_value described(const Entry& entry, std::vector<lockstep_text>& texts) {
  lockstep_entry_value value{};
  value.declared = entry.typing == Typing::Any       ? LOCKSTEP_ANY
                   : entry.type == ValueType::Number ? LOCKSTEP_NUMBER
                                                     : static_cast<lockstep_type>(entry.type);
  if (entry.object != nullptr) value.object_name = entry.object->name().data();
  describe(entry.value, value, texts);
  return value;
}

bool assign(Entry& entry, const lockstep_entry_value& given) {
  const ObjectType* type = nullptr;
  if (given.object_type != nullptr) {
    const auto known = read_object_type(given.object_type, "");
    if (!known) return false;
    type = *known;
  }
  std::optional<Value> value = value_of(given, type);
  if (given.type != 0 && !value) return false;
  if (entry.typing == Typing::Strict) {
    if (!value || !holds(*value, entry.type)) return false;
  } else {
    declare(entry, given.declared, type);
  }
  if (!value) return true;
  std::swap(entry.value, *value);  // what it had is released when the entry is as it will be
  ++entry.writes;
  return true;
}

}  // namespace lockstep::host
