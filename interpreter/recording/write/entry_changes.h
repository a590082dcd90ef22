// Which blackboard entries have another value than in the last line of a recording. A line that the
// file did not take is as if it had not been. An entry that nobody writes costs a comparison per
// tick. Used by recorder.
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

  // Of these slots of the blackboard, which are numbered in this order.
  explicit EntryChanges(std::vector<std::uint32_t> slots);

  // After a tick. Valid until the next call. Allocates only where a text is longer than before.
  std::span<const EntryChange> changes(const Blackboard& board);
  // What changes() gave last has reached the file.
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
