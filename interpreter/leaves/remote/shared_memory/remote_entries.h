// The blackboard entries and constants that the leaves of a run in another process are bound to, by
// number, with the value that the process has: only changes are sent.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/core/value.h"
#include "leaves/plugin/contract/bound_port.h"
#include "leaves/plugin/contract/packed_object.h"
#include "leaves/remote/shared_memory/message.h"

namespace lockstep::host {

class RemoteEntries {
 public:
  static constexpr std::uint32_t kNone = 0xffffffff;
  // How a port sets its entry; loosely: it may hold values of other types, and any number.
  enum class Sets : std::uint8_t { No, Strictly, Loosely };

  // Ports of one entry have one number. The port must be bound.
  std::uint32_t number_of(const BoundPort& port);
  // The entries of these ports (kNone is skipped) whose values the other side does not have.
  // Returns "", or why an object of one cannot be sent: the other side finds no value there.
  std::string write(std::span<const std::uint32_t> ports, MessageWriter& message);
  // Stores what the other side has set. Returns false if the message is invalid. `refused`: why an
  // entry did not take its value.
  bool read(MessageReader& message, std::string& refused);
  // Forgets which values the other side has, and releases them.
  void forget();

 private:
  struct Entry {
    const Value* read;
    lockstep::host::Entry* write;  // null: the other side may not set it
    std::string_view port, key;    // by which it does
    ValueType type;
    const PackedType* objects;  // null: its values are none
    const ObjectType* object;
    bool is_strict;
    bool is_generic;
    bool known = false;
    Value last = {};  // what the other side knows
  };
  std::vector<Entry> entries_;
  // Ports of different types may read one entry whose type is not strict: each has a number.
  std::map<std::pair<const Value*, ValueType>, std::uint32_t> numbers_;
};

}  // namespace lockstep::host
