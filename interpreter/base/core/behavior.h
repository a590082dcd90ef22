// The statements about what a leaf does: of a row in a leaf file, or of a plugin about a type.
// docs/verify.md says what the words mean.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/core/place.h"
#include "base/core/problem.h"

namespace lockstep::host {

// The whole numbers from `least` to `most`; none: without end.
struct WholeRange {
  std::int64_t least = 0;
  std::optional<std::int64_t> most;

  friend bool operator==(const WholeRange&, const WholeRange&) = default;
};

// The results that an activation may have.
struct ResultSet {
  bool success = true, failure = true, skipped = false, fault = false;
  // The chance of each, in this order; those that it may have are in (0, 1] and add up to 1. All 0:
  // nothing is known about chances.
  std::array<double, 4> chances = {};

  bool has_chances() const {
    return std::ranges::any_of(chances, [](double it) { return it > 0; });
  }

  friend bool operator==(const ResultSet&, const ResultSet&) = default;
};

struct ProgressWay {
  enum class Kind : std::uint8_t { None, Cuts, Grid } kind = Kind::Cuts;
  std::uint32_t parts = 0;  // of a grid

  friend bool operator==(const ProgressWay&, const ProgressWay&) = default;
};

// When a leaf writes its outputs. In any tick: or not, but it does not succeed before all have
// values. In any call: or not, also when it is halted or held; no statement says so.
enum class Writes : std::uint8_t { OnSuccess, AtStart, InEachTick, InAnyTick, InAnyCall };

// A statement that is not made is not there.
struct Behavior {
  std::optional<ResultSet> results = {};
  std::optional<WholeRange> ticks = {};
  std::optional<bool> ends = {};
  std::optional<ProgressWay> progress = {};
  std::optional<WholeRange> step = {};
  std::optional<bool> finishes_full = {};
  std::optional<WholeRange> held = {};  // 0..0: it stands still
  std::optional<Writes> writes = {};

  struct Named {
    std::string name;
    std::string text;
    Place place = {};
  };
  std::vector<Named> outputs = {};  // a port, and its values with '|' between
};

inline constexpr std::string_view kOutputWord = "out.";  // before the name of a port

// Adds the statement `word`="`value`". A problem is one of the value; `word` must be one of those
// that is_behavior_word knows.
std::optional<Problem> add_statement(std::string_view word, std::string_view value,
                                     Behavior& behavior);

bool is_behavior_word(std::string_view word);
// Whether there is a statement with this word.
bool says(const Behavior& behavior, std::string_view word);
// A hint for a word that is none.
std::string suggested_behavior_word(std::string_view word);

}  // namespace lockstep::host
