// Scripts say tick by tick what leaves do, as text: NAME.leaves. A counter-example of verify is
// one, and `run
// --leaves` plays it. docs/verify.md has the grammar.
//   @rate 10
//   @ticks 14
//   @cut 3
//   @cut 3 continue M/p/arm
//   M/p/arm = R0 R0.1 ~0.05 R0.1 S[place=kitchen]
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/core/after_cut.h"
#include "base/core/clock.h"
#include "base/core/problem.h"
#include "base/core/status.h"

namespace lockstep::host {

struct LeafWord {
  enum class Kind : std::uint8_t { Tick, Fault, Held } kind = Kind::Tick;
  Status status = Status::Running;  // of a Tick
  double progress = 0;              // of a Tick that goes on, and of Held
  // Ports, with the texts of their values: written in this tick, before it if it is the first.
  std::vector<std::pair<std::string, std::string>> written = {};

  friend bool operator==(const LeafWord&, const LeafWord&) = default;
};

// The process is cut before a tick, and goes on with it.
struct ScriptCut {
  std::uint64_t tick = 1;  // counted from 0
  // The leaves, by path, that do something else then than to begin again.
  std::map<std::string, AfterCut, std::less<>> leaves = {};

  AfterCut of(std::string_view path) const {
    const auto it = leaves.find(path);
    return it == leaves.end() ? AfterCut::StartsAgain : it->second;
  }
  friend bool operator==(const ScriptCut&, const ScriptCut&) = default;
};

// "continue", of one that goes on.
inline constexpr std::string_view kContinues = "continue";

struct LeafScripts {
  std::optional<double> rate;
  std::optional<std::uint64_t> ticks;  // of the tree, as many as the scripts are for
  std::vector<ScriptCut> cuts = {};    // in the order of their ticks
  std::map<std::string, std::vector<LeafWord>, std::less<>> leaves = {};  // by path
  // The leaves that begin with their first word again in each activation. The text has no word for
  // it: scenarios do.
  std::set<std::string, std::less<>> restarting = {};
  // The leaves that run for this time and then do what their only word says; likewise.
  std::map<std::string, Nanoseconds, std::less<>> times = {};
};

// A text that begins with '<' is a leaf file (leaves/leaf_file.h), any other is scripts.
bool is_leaf_file(std::string_view text);

// "R0.5", "S[place=kitchen]"; nothing if it is none.
std::optional<LeafWord> parse_leaf_word(std::string_view text);
std::string to_text(const LeafWord& word);

struct LeafScriptError {
  std::string message, hint;
  std::uint32_t line = 1, column = 1;
};
tl::expected<LeafScripts, LeafScriptError> parse_leaf_scripts(std::string_view text);
// The line of a text that has the steps of the leaf with this path; 0: none.
std::uint32_t line_of_leaf(std::string_view text, std::string_view path);
std::string to_text(const LeafScripts& scripts);

}  // namespace lockstep::host
