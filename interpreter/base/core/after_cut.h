// What an action does after its process was cut: docs/resume.md.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace lockstep::host {

// What a leaf does that ran at the cut. The results are those of its next tick, without a call.
enum class AfterCut : std::uint8_t { StartsAgain, Continues, Failure, Success };

// "restart", "failure" or "success", as elements and options have it. Nothing: another word.
constexpr std::optional<AfterCut> after_cut_named(std::string_view word) {
  if (word == "restart") return AfterCut::StartsAgain;
  if (word == "failure") return AfterCut::Failure;
  return word == "success" ? std::optional(AfterCut::Success) : std::nullopt;
}

constexpr std::string_view word_of(AfterCut after) {
  if (after == AfterCut::StartsAgain) return "restart";
  return after == AfterCut::Failure ? "failure" : "success";
}

// What an element says of its leaf.
struct LeafAtCut {
  AfterCut otherwise = AfterCut::StartsAgain;  // what it does if it cannot be asked
  bool is_given = false;                       // `otherwise`; if not, the run decides
  bool commits = false;  // its success counts only once a checkpoint with it is on the disk

  // What it does if it cannot be asked, in a run with this default.
  AfterCut unasked(AfterCut of_run) const { return is_given ? otherwise : of_run; }
};

}  // namespace lockstep::host
