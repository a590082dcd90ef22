#include "plugin/isolated/remote_entries.h"

namespace lockstep {
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

}  // namespace

std::uint32_t RemoteEntries::number_of(const BoundPort& port) {
  const auto [found, is_new] =
      numbers_.emplace(port.read, static_cast<std::uint32_t>(entries_.size()));
  if (is_new) {
    const PackedType* const objects =
        port.object == nullptr ? nullptr : &PackedType::of(port.object->name());
    entries_.push_back(Entry{port.read, nullptr, port.type, objects});
  }
  Entry& entry = entries_[found->second];
  if (port.write != nullptr) entry.write = port.write;
  return found->second;
}

std::string RemoteEntries::write(std::span<const std::uint32_t> ports, MessageWriter& message) {
  std::string failure;
  for (const std::uint32_t number : ports) {
    if (number == kNone) continue;
    Entry& entry = entries_[number];
    if (entry.known && entry.last == *entry.read) continue;
    message.put(number);
    std::string reason = put_packed(*entry.read, message);
    entry.known = reason.empty();
    entry.last = entry.known ? *entry.read : Value();
    if (failure.empty()) failure = std::move(reason);
  }
  message.put(kNone);
  return failure;
}

bool RemoteEntries::read(MessageReader& message) {
  for (auto number = message.get<std::uint32_t>(); number != kNone;
       number = message.get<std::uint32_t>()) {
    if (number >= entries_.size() || entries_[number].write == nullptr) return false;
    Entry& entry = entries_[number];
    if (!message.value_into(entry.last, entry.objects)) return false;
    if (!holds(entry.last, entry.type)) return false;
    entry.write->value = entry.last;
    ++entry.write->writes;
    entry.known = true;
  }
  return message.good();
}

void RemoteEntries::forget() {
  for (Entry& entry : entries_) {
    entry.known = false;
    entry.last = Value();
  }
}

}  // namespace lockstep
