// Keeps the first few notes for a summary and counts the others.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <vector>

#include "base/core/wording.h"
#include "judge/summary/summary.h"

namespace lockstep::host {

class CappedNotes {
 public:
  static constexpr std::size_t kMost = 5;

  // `noun` is what the notes are about: "fault".
  explicit CappedNotes(std::string_view noun) : noun_(noun) {}

  // `text` makes the note; it is only called for those that are kept.
  template <class Text>
  void add(Text text) {
    if (++count_ <= kMost) kept_.push_back(text());
  }
  std::uint64_t count() const { return count_; }

  void append_to(std::vector<std::string>& notes) const {
    notes.insert(notes.end(), kept_.begin(), kept_.end());
    if (count_ > kMost) notes.push_back(fmt::format("and {} more", counted(count_ - kMost, noun_)));
  }

 private:
  std::string_view noun_;
  std::uint64_t count_ = 0;
  std::vector<std::string> kept_;
};

}  // namespace lockstep::host
