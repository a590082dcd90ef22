// Whether the code of a plugin uses entries by their names.
#pragma once

namespace BT::lockstep_detail {

// Its value is true in a plugin whose code opens entries: only then does it get them.
[[gnu::visibility("hidden")]] inline bool& opens_entries() {
  static bool opens = false;
  return opens;
}
template <class Use>
struct OpeningMark {
  static bool note() { return opens_entries() = true; }
  [[gnu::visibility("hidden")]] static inline const bool kNoted = note();
};

// For a function template that opens an entry: `Use` is one of its parameters, so that the mark is
// made only where the function is used.
template <class Use>
void note_opening() {
  static_cast<void>(OpeningMark<Use>::kNoted);
}

}  // namespace BT::lockstep_detail
