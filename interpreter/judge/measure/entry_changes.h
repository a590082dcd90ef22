// Finds blackboard entries whose value differs from what was kept last: for a recording what its
// file has accepted, for a view what it has taken. An entry that nobody writes costs one comparison
// per tick. Used by recorder and snapshot_feed.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/blackboard/entry.h"

namespace lockstep::host {

struct EntryChange {
  std::uint32_t entry = 0;             // its number among those that are watched
  const std::string* text = nullptr;   // its value; null: it is too long
  bool is_set = false;                 // it was written between ticks, perhaps also in the tick
  bool is_written_again = false;       // it was: then `given` is what it had before the tick
  const std::string* given = nullptr;  // null: it is too long
};

// The state of an entry after a tick.
struct EntryState {
  std::string text = {};                      // its value; "" if it is too long
  bool is_long = false;                       // it is
  std::optional<std::uint64_t> changed = {};  // the tick of the last change; none: no value yet
  bool is_older = false;  // it changed in that tick or before: what was before is not known

  void set(const std::string* value, std::uint64_t tick);  // null: it is too long
  friend bool operator==(const EntryState&, const EntryState&) = default;
};

class EntryChanges {
 public:
  static constexpr std::size_t kLongest = 256;  // bytes of a value as text
  static constexpr std::size_t kNumber = 32;    // and of the longest number, at least

  // For these slots of the blackboard, numbered in this order.
  explicit EntryChanges(const std::vector<std::uint32_t>& slots);

  // Call once before the first tick: what was written until then is no change of a tick, but in
  // these slots.
  void begin(std::span<const Entry> entries, std::span<const std::uint32_t> set = {});
  // May be called before a tick whose changes() come: finds what was written since the last ones.
  void before_tick(std::span<const Entry> entries);
  // Call after a tick. The result is valid until the next call. Allocates only if a text is longer
  // than before.
  std::span<const EntryChange> changes(std::span<const Entry> entries);
  // After changes(): each entry that has a value. Valid until the next call of either.
  std::span<const EntryChange> values();
  // Call when the last result of changes() was accepted.
  void keep();
  // Forgets what was kept: the next result has every entry that has a value.
  void start_over();

 private:
  struct Watched {
    std::uint32_t slot = 0;
    std::optional<std::uint32_t> writes = {};  // of the entry, when its value was kept
    std::uint32_t writes_of_tick = 0;          // after the last tick that was looked at
    bool is_set = false;                       // between ticks, since a change was kept
    bool has_text = false;                     // else nothing was kept, or that it is too long
    std::string text = {};                     // that was kept
    std::string next = {};                     // to be kept
    bool has_given = false;                    // if is_set: it is not too long
    std::string given = {};                    // what it was set to
  };
  std::vector<Watched> watched_;
  std::vector<EntryChange> changes_, values_;
  std::span<const Entry> entries_;  // that they are of
};

}  // namespace lockstep::host
