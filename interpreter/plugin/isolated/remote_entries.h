// The blackboard entries and constants that the leaves of one run in another process are bound to,
// by number, with what that process knows of each: only what has changed is sent.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/value.h"
#include "plugin/host.h"
#include "plugin/isolated/message.h"

namespace lockstep {

class RemoteEntries {
 public:
  static constexpr std::uint32_t kNone = 0xffffffff;

  // Ports of one entry have one number. The port must be bound.
  std::uint32_t number_of(const BoundPort& port);
  // The entries of these ports (kNone is passed over), as far as the other side does not know them.
  void write(std::span<const std::uint32_t> ports, MessageWriter& message);
  // Takes what was set on the other side. False: the message makes no sense.
  bool read(MessageReader& message);
  // The other side knows nothing any more.
  void forget();

 private:
  struct Entry {
    const Value* read;
    lockstep::Entry* write;  // null: nobody there may set it
    ValueType type;
    bool known = false;
    Value last = {};  // what the other side knows
  };
  std::vector<Entry> entries_;
  std::unordered_map<const Value*, std::uint32_t> numbers_;
};

}  // namespace lockstep
