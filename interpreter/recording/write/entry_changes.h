// Which blackboard entries have another value than in the last line of a recording. A line that the
// file did not take is as if it had not been. An entry that nobody writes costs a comparison per
// tick. Used by recorder.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/blackboard.h"
#include "recording/recording.h"

namespace lockstep {

class EntryChanges {
 public:
  static constexpr std::size_t kLongest = 256;  // bytes of a value as text

  // Of these slots of the blackboard, which are numbered in this order.
  explicit EntryChanges(std::vector<std::uint32_t> slots);

  // After a tick. Valid until the next call.
  std::span<const RecordedEntry> changes(const Blackboard& board);
  // What changes() gave last has reached the file.
  void keep();

 private:
  struct Watched {
    std::uint32_t slot = 0;
    std::optional<std::uint32_t> writes = {};  // of the entry, when it was looked at last
    std::optional<std::string> value = {};     // in the file; none: too long
    bool is_known = false;                     // it is in the file
  };
  std::vector<Watched> watched_;
  std::vector<RecordedEntry> changes_;
  const Blackboard* board_ = nullptr;  // that they are of
};

}  // namespace lockstep
