#include "base/core/behavior.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <span>

#include "base/core/suggest.h"
#include "base/core/value.h"
#include "base/core/wording.h"

namespace lockstep::host {
namespace {

constexpr std::array<std::string_view, 8> kWords{"result", "ticks",  "ends", "progress",
                                                 "step",   "finish", "held", "writes"};

// "3", "1..5", "2..inf".
std::optional<WholeRange> parse_range(std::string_view text) {
  constexpr std::string_view kBetween = "..";
  const auto at = text.find(kBetween);
  const auto least = parse_int(text.substr(0, at));
  if (!least) return std::nullopt;
  if (at == std::string_view::npos) return WholeRange{*least, least};
  const std::string_view end = text.substr(at + kBetween.size());
  if (end == "inf") return WholeRange{*least, std::nullopt};
  const auto most = parse_int(end);
  if (!most || *most < *least) return std::nullopt;
  return WholeRange{*least, most};
}

std::optional<Problem> read_range(std::string_view value, std::optional<std::int64_t> least,
                                  std::string_view as, std::optional<WholeRange>& into) {
  constexpr std::int64_t kMost = 1'000'000;
  const auto is_small = [](std::int64_t it) { return it >= -kMost && it <= kMost; };
  into = parse_range(value);
  if (into && is_small(into->least) && (!least || into->least >= *least) &&
      is_small(into->most.value_or(0))) {
    return std::nullopt;
  }
  return Problem{fmt::format("'{}' is not a range", brief(value)), fmt::format("write {}", as)};
}

std::optional<Problem> read_held(std::string_view value, std::optional<WholeRange>& into) {
  constexpr std::string_view kAs = "still or -1..0";
  if (value == "still") {
    into = WholeRange{0, 0};
    return std::nullopt;
  }
  if (auto wrong = read_range(value, std::nullopt, kAs, into)) return wrong;
  if (!into->most) return Problem{"'held' has no end", std::string(kAs)};
  return std::nullopt;
}

// "success;failure", or each with its chance: "success:0.7;failure:0.3".
std::optional<Problem> read_results(std::string_view value, std::optional<ResultSet>& into) {
  constexpr std::array<std::string_view, 4> kResults{"success", "failure", "skipped", "fault"};
  constexpr std::string_view kAs = "write success:0.7;failure:0.3";
  constexpr double kMostRounding = 1e-6;  // of the sum
  std::array<bool, kResults.size()> has{};
  std::array<double, kResults.size()> chances{};
  std::size_t parts = 0, with_chance = 0;
  while (true) {
    const std::string_view part = value.substr(0, value.find(';'));
    const auto colon = part.find(':');
    const std::string_view name = part.substr(0, colon);
    const auto* const word = std::ranges::find(kResults, name);
    if (word == kResults.end()) {
      return Problem{fmt::format("'{}' is not a result", brief(name)),
                     suggest(name, kResults, "results")};
    }
    const auto place = static_cast<std::size_t>(word - kResults.begin());
    if (colon != std::string_view::npos) {
      const auto chance = parse_double(part.substr(colon + 1));
      if (!chance || !(*chance > 0 && *chance <= 1)) {
        return Problem{
            fmt::format("'{}' is not a chance of {}", brief(part.substr(colon + 1)), name),
            "a chance is a number above 0, at most 1; leave out a result that never comes"};
      }
      if (has[place]) return Problem{fmt::format("'{}' has two chances", name), std::string(kAs)};
      chances[place] = *chance;
      ++with_chance;
    }
    has[place] = true;
    ++parts;
    if (part.size() == value.size()) break;
    value.remove_prefix(part.size() + 1);
  }
  if (with_chance != 0) {
    if (with_chance != parts)
      return Problem{"some results have chances, and others have none", std::string(kAs)};
    const double sum = std::accumulate(chances.begin(), chances.end(), 0.0);
    if (std::abs(sum - 1) > kMostRounding)
      return Problem{fmt::format("the chances add up to {:.6g}, not to 1", sum), std::string(kAs)};
    for (double& it : chances) it /= sum;
  }
  into = ResultSet{has[0], has[1], has[2], has[3], chances};
  return std::nullopt;
}

std::optional<Problem> read_progress(std::string_view value, std::optional<ProgressWay>& into) {
  constexpr std::int64_t kMost = 1000;
  constexpr std::string_view kGrid = "grid:";
  if (value == "none") into = ProgressWay{ProgressWay::Kind::None, 0};
  if (value == "cuts") into = ProgressWay{ProgressWay::Kind::Cuts, 0};
  const auto parts =
      value.starts_with(kGrid) ? parse_int(value.substr(kGrid.size())) : std::nullopt;
  if (parts && *parts >= 1 && *parts <= kMost) {
    into = ProgressWay{ProgressWay::Kind::Grid, static_cast<std::uint32_t>(*parts)};
  }
  if (value == "none" || value == "cuts" || (into && parts && into->parts == *parts)) {
    return std::nullopt;
  }
  return Problem{fmt::format("'{}' is not a kind of progress", brief(value)),
                 "write none, cuts, or grid:10 (at most 1000 parts)"};
}

// Which of some words it is.
std::optional<Problem> read_choice(std::string_view word, std::string_view value,
                                   std::span<const std::string_view> choices, std::size_t& into) {
  into = static_cast<std::size_t>(std::ranges::find(choices, value) - choices.begin());
  if (into < choices.size()) return std::nullopt;
  return Problem{fmt::format("'{}' cannot be '{}'", word, brief(value)),
                 suggest(value, choices, "it can be")};
}

std::optional<Problem> read_flag(std::string_view word, std::string_view value,
                                 const std::array<std::string_view, 2>& no_and_yes,
                                 std::optional<bool>& into) {
  std::size_t which = 0;
  auto wrong = read_choice(word, value, no_and_yes, which);
  into = which == 1;
  return wrong;
}

}  // namespace

bool is_behavior_word(std::string_view word) {
  return word.starts_with(kOutputWord) || std::ranges::find(kWords, word) != kWords.end();
}

bool says(const Behavior& behavior, std::string_view word) {
  if (word.starts_with(kOutputWord)) {
    const std::string_view port = word.substr(kOutputWord.size());
    return std::ranges::find(behavior.outputs, port, &Behavior::Named::name) !=
           behavior.outputs.end();
  }
  const std::array<bool, kWords.size()> said{
      behavior.results.has_value(),  behavior.ticks.has_value(), behavior.ends.has_value(),
      behavior.progress.has_value(), behavior.step.has_value(),  behavior.finishes_full.has_value(),
      behavior.held.has_value(),     behavior.writes.has_value()};
  const auto* const at = std::ranges::find(kWords, word);
  return at != kWords.end() && said[static_cast<std::size_t>(at - kWords.begin())];
}

std::string suggested_behavior_word(std::string_view word) {
  return suggest(word, kWords, "words next to out.PORT");
}

std::optional<Problem> add_statement(std::string_view word, std::string_view value,
                                     Behavior& into) {
  if (word == "result") return read_results(value, into.results);
  if (word == "ticks") return read_range(value, 1, "1..5, 3 or 2..inf", into.ticks);
  if (word == "ends") return read_flag(word, value, {"no", "yes"}, into.ends);
  if (word == "progress") return read_progress(value, into.progress);
  if (word == "step") return read_range(value, std::nullopt, "0..2, 1 or 0..inf", into.step);
  if (word == "finish") return read_flag(word, value, {"any", "full"}, into.finishes_full);
  if (word == "held") return read_held(value, into.held);
  if (word == "writes") {
    constexpr std::array<std::string_view, 4> kMoments{"success", "start", "tick", "any"};
    std::size_t which = 0;
    if (auto wrong = read_choice(word, value, kMoments, which)) return wrong;
    into.writes = static_cast<Writes>(which);
    return std::nullopt;
  }
  into.outputs.push_back({std::string(word.substr(kOutputWord.size())), std::string(value)});
  return std::nullopt;
}

}  // namespace lockstep::host
