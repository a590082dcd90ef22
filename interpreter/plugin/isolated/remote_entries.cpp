#include "plugin/isolated/remote_entries.h"

namespace lockstep {

std::uint32_t RemoteEntries::number_of(const BoundPort& port) {
  const auto [found, is_new] =
      numbers_.emplace(port.read, static_cast<std::uint32_t>(entries_.size()));
  if (is_new) entries_.push_back(Entry{port.read, nullptr, port.type});
  Entry& entry = entries_[found->second];
  if (port.write != nullptr) entry.write = port.write;
  return found->second;
}

void RemoteEntries::write(std::span<const std::uint32_t> ports, MessageWriter& message) {
  for (const std::uint32_t number : ports) {
    if (number == kNone) continue;
    Entry& entry = entries_[number];
    if (entry.known && entry.last == *entry.read) continue;
    message.put(number);
    message.put_value(*entry.read);
    entry.last = *entry.read;
    entry.known = true;
  }
  message.put(kNone);
}

bool RemoteEntries::read(MessageReader& message) {
  for (auto number = message.get<std::uint32_t>(); number != kNone;
       number = message.get<std::uint32_t>()) {
    if (number >= entries_.size() || entries_[number].write == nullptr) return false;
    Entry& entry = entries_[number];
    if (!message.value_into(entry.last)) return false;
    if (!holds(entry.last, entry.type)) return false;
    entry.write->value = entry.last;
    ++entry.write->writes;
    entry.known = true;
  }
  return message.good();
}

void RemoteEntries::forget() {
  for (Entry& entry : entries_) entry.known = false;
}

}  // namespace lockstep
