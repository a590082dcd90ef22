#include "leaves/remote/shared_memory/remote_entries.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/blackboard/conversion.h"
#include "leaves/plugin/contract/entry_value.h"

namespace lockstep::host {
namespace {

// Objects of this process are sent as bytes. Returns "" or why that failed; no value is sent then.
std::string put_packed(const Value& value, MessageWriter& message) {
  const auto* const object = std::get_if<Object>(&value);
  if (object == nullptr || object->type()->is_packed()) {
    message.put_value(value);
    return {};
  }
  const auto packed = pack(*object, WithText::No);
  message.put_value(packed ? Value(*packed) : Value());
  return packed ? "" : packed.error().message;
}

// A port of any type cannot read an object. The other side gets one without content, so that it
// sees another object there.
void put_generic(const Value& value, MessageWriter& message) {
  const auto* const object = std::get_if<Object>(&value);
  if (object == nullptr) {
    message.put_value(value);
  } else {
    message.put_value(Value(PackedType::of(object->type()->name()).make({})));
  }
}

// The value as a port of that type can read it. If it cannot, it is the one that the other side
// names in its error, as far as that can have it.
Value readable_value(const Value& value, ValueType type, const ObjectType* object) {
  auto converted = convert_value(value, type, object);
  if (!converted && !std::holds_alternative<Object>(value)) return value;
  if (!converted) return {};
  return std::move(*converted);
}

// The bytes are those of the object that is there, which the other side has sent before.
bool is_same_object(const Value& there, const Value& sent) {
  const auto* const one = std::get_if<Object>(&there);
  const auto* const other = std::get_if<Object>(&sent);
  return one != nullptr && other != nullptr && one->type() == other->type() &&
         one->type()->is_packed() && PackedType::get(*one).bytes == PackedType::get(*other).bytes;
}

bool is_finite(const Value& value) {
  if (const auto* real = std::get_if<double>(&value)) return std::isfinite(*real);
  const auto* list = std::get_if<std::vector<double>>(&value);
  return list == nullptr || std::ranges::all_of(*list, [](double it) { return std::isfinite(it); });
}

// As a port of type LOCKSTEP_ANY sets it.
bool write_generic(Entry& entry, const Value& value) {
  if (entry.typing != Typing::Strict) {
    return write_entry(entry, static_cast<ValueType>(value.index()), nullptr, value);
  }
  if (!holds(value, entry.type)) return false;
  entry.assign(value);
  return true;
}

// The type of a port that takes a value of any type.
constexpr auto kAnyType = static_cast<ValueType>(0xff);

}  // namespace

std::uint32_t RemoteEntries::number_of(const BoundPort& port) {
  const std::pair key(port.read, port.is_generic  ? kAnyType
                                 : port.is_strict ? ValueType::Number
                                                  : port.type);
  const auto [found, is_new] = numbers_.emplace(key, static_cast<std::uint32_t>(entries_.size()));
  if (is_new) {
    const PackedType* const objects =
        port.object() == nullptr ? nullptr : &PackedType::of(port.object()->name());
    entries_.push_back({.read = port.read,
                        .write = nullptr,
                        .port = {},
                        .key = {},
                        .type = port.type,
                        .objects = objects,
                        .object = port.object(),
                        .is_strict = port.is_strict,
                        .is_generic = port.is_generic});
  }
  Entry& entry = entries_[found->second];
  if (port.write != nullptr) {
    entry.write = port.write;
    entry.port = port.name();
    entry.key = port.entry;
  }
  return found->second;
}

std::string RemoteEntries::write(std::span<const std::uint32_t> ports, MessageWriter& message) {
  std::string failure;
  for (const std::uint32_t number : ports) {
    if (number == kNone) continue;
    Entry& entry = entries_[number];
    Value converted;
    const bool is_as_it_is = entry.is_strict || entry.is_generic;
    if (!is_as_it_is) converted = readable_value(*entry.read, entry.type, entry.object);
    const Value& value = is_as_it_is ? *entry.read : converted;
    if (entry.known && entry.last == value) continue;
    message.put(number);
    std::string reason;
    if (entry.is_generic) {
      put_generic(value, message);
    } else {
      reason = put_packed(value, message);
    }
    entry.known = reason.empty();
    entry.last = entry.known ? value : Value();
    if (failure.empty()) failure = std::move(reason);
  }
  message.put(kNone);
  return failure;
}

bool RemoteEntries::read(MessageReader& message, std::string& refused) {
  for (auto number = message.get<std::uint32_t>(); number != kNone;
       number = message.get<std::uint32_t>()) {
    if (number >= entries_.size() || entries_[number].write == nullptr) return false;
    Entry& entry = entries_[number];
    if (!message.value_into(entry.last, entry.objects)) return false;
    if (entry.is_generic ? !entry.last.index() : !holds(entry.last, entry.type)) return false;
    if (entry.write->typing == Typing::Strict && !is_finite(entry.last)) return false;
    // A node that looks whether the entry has changed sees that it has not.
    if (is_same_object(entry.write->value(), entry.last)) entry.last = entry.write->value();
    entry.known = true;
    bool is_taken = true;
    if (entry.is_generic) {
      is_taken = write_generic(*entry.write, entry.last);
    } else if (entry.is_strict) {
      entry.write->assign(entry.last);
    } else {
      is_taken = write_entry(*entry.write, entry.type, entry.object, entry.last);
    }
    if (is_taken || !refused.empty()) continue;
    const auto type = static_cast<ValueType>(entry.last.index());
    refused =
        fmt::format("cannot set '{}': {}", entry.port, refusal_of(*entry.write, entry.key, type));
  }
  return message.good();
}

void RemoteEntries::forget() {
  for (Entry& entry : entries_) {
    entry.known = false;
    entry.last = Value();
  }
}

}  // namespace lockstep::host
