#include "blackboard/entry.h"

#include <utility>

#include "blackboard/conversion.h"

namespace lockstep::host {
namespace {

bool is_of(const Entry& entry, ValueType type, const ObjectType* object) {
  if (entry.type != type) return false;
  return type != ValueType::Object || object == entry.object || object == nullptr ||
         entry.object == nullptr || object->name() == entry.object->name();
}

}  // namespace

bool write_entry(Entry& entry, ValueType type, const ObjectType* object, Value value) {
  if (!entry.is_present) {
    const bool is_text = type == ValueType::String;
    make_entry(entry, is_text ? Typing::Any : Typing::Declared, type, object);
  } else if (entry.typing == Typing::Any) {
    entry.typing = Typing::Declared;
    entry.type = type;
    entry.object = object;
  } else if (!is_of(entry, type, object)) {
    const bool is_text = std::holds_alternative<std::string>(value);
    if (!is_text && entry.type == ValueType::String) return false;
    auto converted = convert_value(value, entry.type, entry.object);
    if (!converted) return false;
    value = std::move(*converted);
  }
  std::swap(entry.value, value);  // what it had is released when the entry is as it will be
  ++entry.writes;
  return true;
}

}  // namespace lockstep::host
