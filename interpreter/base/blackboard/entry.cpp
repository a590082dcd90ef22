#include "base/blackboard/entry.h"

#include <utility>

#include "base/blackboard/conversion.h"

namespace lockstep::host {
namespace {

bool is_of(const Entry& entry, ValueType type, const ObjectType* object) {
  if (entry.type != type) return false;
  return type != ValueType::Object || object == entry.object || object == nullptr ||
         entry.object == nullptr || object->name() == entry.object->name();
}

// A script decides with the first number that it puts into an entry whether the entry's numbers are
// whole or real. Returns false if the value cannot be of that kind.
bool keep_kind(const Entry& entry, Value& value) {
  const bool is_whole = std::holds_alternative<std::int64_t>(entry.value());
  if (!is_whole && !std::holds_alternative<double>(entry.value())) return true;
  if (value.index() == entry.value().index()) return true;
  auto kept = cast_value(value, is_whole ? ValueType::Int : ValueType::Double, nullptr);
  if (!kept) return false;
  value = std::move(*kept);
  return true;
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
    if (entry.typing == Typing::Declared && !keep_kind(entry, value)) return false;
  } else if (entry.typing == Typing::Declared && !keep_kind(entry, value)) {
    return false;
  }
  entry.assign(std::move(value));
  return true;
}

}  // namespace lockstep::host
