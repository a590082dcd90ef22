#include "base/core/suggest.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "base/core/typo.h"
#include "base/core/wording.h"

namespace lockstep::host {
namespace {

constexpr std::size_t kLongestWord = 256;
constexpr std::size_t kMostEdits = 8;
constexpr std::size_t kMostCandidates = 10'000;
constexpr std::size_t kMostAsNear = 3;
constexpr std::size_t kMostBytes = 200;  // of words that are as near
// The largest table of distances for one word: less than a millisecond. All names of a large robot
// take a fifth of it.
constexpr std::size_t kMostCells = 100'000;

constexpr char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

// Optimal string alignment: like Levenshtein's distance, and a swap of neighbors costs one. Only
// the cells near the diagonal can be within a limit, and only these are computed.
class EditDistance {
 public:
  explicit EditDistance(std::string_view word) : word_(word) {}

  // Something above `limit` when the distance is.
  std::size_t to(std::string_view other, std::size_t limit) {
    const std::size_t far = limit + 1;
    for (std::size_t j = 0; j <= other.size(); ++j) row(0)[j] = std::min(j, far);
    for (std::size_t i = 1; i <= word_.size(); ++i) {
      const std::size_t first = i > limit ? i - limit : 1;
      const std::size_t last = std::min(other.size(), i + limit);
      row(i)[first - 1] = first == 1 ? i : far;
      std::size_t least = row(i)[first - 1];
      for (std::size_t j = first; j <= last; ++j) {
        row(i)[j] = std::min(cell(other, i, j, j == i + limit ? far : row(i - 1)[j]), far);
        least = std::min(least, row(i)[j]);
      }
      cells_ += last - first + 1;
      if (least > limit) return far;
    }
    return row(word_.size())[other.size()];
  }

  std::size_t cells() const { return cells_; }

 private:
  using Row = std::array<std::size_t, kLongestWord + kMostEdits + 1>;
  Row& row(std::size_t i) { return rows_[i % rows_.size()]; }

  // `above`: the cell of the last row, which at the end of the band is not there.
  std::size_t cell(std::string_view other, std::size_t i, std::size_t j, std::size_t above) {
    const char a = lower(word_[i - 1]);
    const char b = lower(other[j - 1]);
    std::size_t best =
        std::min({above + 1, row(i)[j - 1] + 1, row(i - 1)[j - 1] + (a == b ? 0 : 1)});
    const bool swapped = i > 1 && j > 1 && a == lower(other[j - 2]) && lower(word_[i - 2]) == b;
    if (swapped) best = std::min(best, row(i - 2)[j - 2] + 1);
    return best;
  }

  std::string_view word_;
  std::array<Row, 3> rows_;  // the last three of the table
  std::size_t cells_ = 0;
};

std::size_t difference(std::size_t a, std::size_t b) {
  return a > b ? a - b : b - a;
}

constexpr bool is_letter(char c) {
  return lower(c) >= 'a' && lower(c) <= 'z';
}

std::string without_marks(std::string_view word) {
  std::string letters;
  for (const char c : word)
    if (c != '_' && c != '-') letters += lower(c);
  return letters;
}

// "Door" of "IsDoorOpen": the letters around a place, from one that is large to the next.
std::string_view part_around(std::string_view word, std::size_t place) {
  const auto is_large = [](char c) { return c >= 'A' && c <= 'Z'; };
  std::size_t begin = place, end = place + 1;
  while (begin > 0 && !is_large(word[begin]) && is_letter(word[begin - 1])) --begin;
  while (end < word.size() && is_letter(word[end]) && !is_large(word[end])) ++end;
  return word.substr(begin, end - begin);
}

std::vector<std::string_view> nearest_ones(std::string_view word,
                                           std::span<const std::string_view> candidates) {
  if (word.size() > kLongestWord) return {};
  if (word.size() < 2) return {};  // near to every other letter
  std::size_t limit = std::min((word.size() + 2) / 3, kMostEdits);
  std::vector<std::string_view> best;
  EditDistance distance(word);
  for (const auto candidate : candidates.first(std::min(candidates.size(), kMostCandidates))) {
    if (distance.cells() > kMostCells) break;
    if (candidate.empty() || difference(candidate.size(), word.size()) > limit) continue;
    const auto edits = distance.to(candidate, limit);
    if (edits > limit) continue;
    if (edits < limit) best.clear();
    limit = edits;
    if (best.size() < kMostAsNear && std::ranges::find(best, candidate) == best.end())
      best.push_back(candidate);
  }
  return best;
}

}  // namespace

bool is_typo_of(std::string_view word, std::string_view known) {
  const std::size_t limit = std::min(1 + word.size() / 8, kMostEdits);
  if (word.size() > kLongestWord || difference(word.size(), known.size()) > limit) return false;
  return EditDistance(word).to(known, limit) <= limit;
}

bool is_slip_of(std::string_view word, std::string_view known) {
  const auto has_digit = [](std::string_view text) {
    return text.find_first_of("0123456789") != text.npos;  // 'to1_11' and 'to11_1' are two places
  };
  const bool is_same_case = std::ranges::equal(word, known, {}, lower, lower);
  if (is_same_case || (!has_digit(word) && without_marks(word) == without_marks(known)))
    return true;
  const auto begin = static_cast<std::size_t>(
      std::ranges::mismatch(word, known, {}, lower, lower).in1 - word.begin());
  std::size_t same = 0;  // at the end
  const std::size_t most = std::min(word.size(), known.size()) - begin;
  while (same < most &&
         lower(word[word.size() - same - 1]) == lower(known[known.size() - same - 1]))
    ++same;
  const std::string_view is = word.substr(begin, word.size() - same - begin);
  const std::string_view be = known.substr(begin, known.size() - same - begin);
  if (!std::ranges::all_of(is, is_letter) || !std::ranges::all_of(be, is_letter)) return false;
  const bool is_swap = is.size() == 2 && be.size() == 2 && lower(is[0]) == lower(be[1]) &&
                       lower(is[1]) == lower(be[0]);
  const std::string_view longer = is.empty() ? known : word;
  const std::string_view part = part_around(longer, begin);
  const std::size_t place = begin - static_cast<std::size_t>(part.data() - longer.data());
  constexpr std::size_t kLeast = 6;
  if (is_swap) return part.size() >= kLeast && place + 2 <= part.size();
  if (is.size() + be.size() != 1) return false;
  // "Locked" and "Blocked", "Charge" and "Charger", "Rest" and "Reset" are words.
  const bool is_inside = place > 0 && place + 1 < part.size();
  const bool is_doubled = place > 0 && lower(part[place]) == lower(part[place - 1]);
  return is_doubled ? part.size() >= kLeast : is_inside && part.size() > kLeast;
}

std::string_view nearest(std::string_view word, std::span<const std::string_view> candidates) {
  const auto best = nearest_ones(word, candidates);
  return best.empty() ? std::string_view() : best.front();
}

std::string did_you_mean(std::string_view word, std::span<const std::string_view> candidates) {
  std::string words;
  for (const auto candidate : nearest_ones(word, candidates)) {
    if (!words.empty() && words.size() + candidate.size() > kMostBytes) break;
    words += fmt::format("{}'{}'", words.empty() ? "" : " or ", brief(candidate));
  }
  return words.empty() ? words : fmt::format("did you mean {}?", words);
}

std::string suggest(std::string_view word, std::span<const std::string_view> candidates,
                    std::string_view what) {
  std::string hint = did_you_mean(word, candidates);
  if (hint.empty() && !candidates.empty()) hint = fmt::format("{}: {}", what, listed(candidates));
  return hint;
}

std::string_view end_that_reads(std::string_view path, std::string_view name) {
  constexpr std::string_view kSlash = "%2F";
  std::size_t begin = path.size();
  for (std::size_t left = name.size(); left > 0; --left) {
    const char letter = name[left - 1];
    if (letter == '/' && path.substr(0, begin).ends_with(kSlash)) {
      begin -= kSlash.size();
    } else if (begin > 0 && path[begin - 1] == letter) {
      --begin;
    } else {
      return {};
    }
  }
  return begin == 0 || path[begin - 1] == '/' ? path.substr(begin) : std::string_view();
}

std::string suggest_path(std::string_view name, std::span<const std::string_view> paths,
                         std::string_view what) {
  const auto reads = [name](std::string_view it) { return !end_that_reads(it, name).empty(); };
  const auto path = std::ranges::find_if(paths, reads);
  return path == paths.end() ? suggest(name, paths, what)
                             : fmt::format("did you mean '{}'?", brief(*path));
}

std::string join_hints(std::string first, std::string_view second) {
  if (!first.empty() && !second.empty()) first += "; ";
  return first.append(second);
}

}  // namespace lockstep::host
