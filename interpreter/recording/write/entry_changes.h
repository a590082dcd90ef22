// Finds blackboard entries whose value differs from the last line of a recording. Lines that the
// file did not accept are ignored. An entry that nobody writes costs one comparison per tick. Used
// by recorder.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/blackboard.h"

namespace lockstep {

struct EntryChange {
  std::uint32_t entry = 0;            // its number among those that are recorded
  const std::string* text = nullptr;  // its value; null: it is too long
};

class EntryChanges {
 public:
  static constexpr std::size_t kLongest = 256;  // bytes of a value as text

  // For these slots of the blackboard, numbered in this order.
  explicit EntryChanges(std::vector<std::uint32_t> slots);

  // Call after a tick. The result is valid until the next call. Allocates only if a text is longer
  // than before.
  std::span<const EntryChange> changes(const Blackboard& board);
  // Call when the file has accepted the last result of changes().
  void keep();

 private:
  struct Watched {
    std::uint32_t slot = 0;
    std::optional<std::uint32_t> writes = {};  // of the entry, when its value was found in the file
    bool has_text = false;                     // else the file has no value, or that it is too long
    std::string text = {};                     // in the file
    std::string next = {};                     // to come there
  };
  std::vector<Watched> watched_;
  std::vector<EntryChange> changes_;
  const Blackboard* board_ = nullptr;  // that they are of
};

}  // namespace lockstep
