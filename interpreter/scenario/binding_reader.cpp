#include "scenario/binding_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "base/core/value.h"
#include "base/core/wording.h"
#include "leaves/leaf_words.h"
#include "leaves/word_check.h"

namespace lockstep::host {
namespace {

constexpr std::uint64_t kMostTimes = 1'000'000;
constexpr std::string_view kToTheEnd = "...";

struct Words {
  std::vector<LeafWord> words;
  std::string wrong;  // the first that is none
  std::size_t offset = 0;
};

// "R.25*3" is three words, "S..." is as "S": the last word stays.
bool add_word(std::string_view text, std::vector<LeafWord>& words) {
  if (text.ends_with(kToTheEnd)) text.remove_suffix(kToTheEnd.size());
  std::uint64_t times = 1;
  const auto star =
      text.find(']') == std::string_view::npos ? text.find('*') : text.find('*', text.rfind(']'));
  if (star != std::string_view::npos) {
    const auto number = parse_int(text.substr(star + 1));
    if (!number || *number < 1 || static_cast<std::uint64_t>(*number) > kMostTimes) return false;
    times = static_cast<std::uint64_t>(*number);
    text = text.substr(0, star);
  }
  const auto word = parse_leaf_word(text);
  if (!word || words.size() + times > kMostTimes) return false;
  words.insert(words.end(), times, *word);
  return true;
}

Words parse_words(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n";
  Words all;
  std::size_t at = text.find_first_not_of(kBlanks);
  while (at != std::string_view::npos) {
    const auto end = std::min(text.find_first_of(kBlanks, at), text.size());
    const std::string_view word = text.substr(at, end - at);
    if (!add_word(word, all.words)) {
      all.wrong = word;
      all.offset = at;
      return all;
    }
    at = text.find_first_not_of(kBlanks, end);
  }
  return all;
}

Status status_of(std::string_view result) {
  if (result == "success") return Status::Success;
  if (result == "failure") return Status::Failure;
  return result == "skipped" ? Status::Skipped : Status::Running;
}

}  // namespace

std::string beside(const std::string& file, std::string_view name) {
  const std::filesystem::path path(name);
  if (path.is_absolute()) return std::string(name);
  return (std::filesystem::path(file).parent_path() / path).lexically_normal().string();
}

void add_even_words(BindingRow& row, std::uint64_t ticks) {
  const bool ends = row.is_fault || row.result != Status::Running;
  for (std::uint64_t i = 1; i < std::min(ticks, kMostTimes); ++i) {
    row.words.push_back({.progress = static_cast<double>(i) / static_cast<double>(ticks)});
  }
  LeafWord last{.status = row.result, .written = row.written};
  if (row.is_fault) last.kind = LeafWord::Kind::Fault;
  if (!ends && !row.words.empty()) last.progress = row.words.back().progress;
  row.words.push_back(std::move(last));
}

void BindingReader::read_leaf(std::uint32_t element, Scenario& into) const {
  BindingRow row;
  int sources = 0;
  bool has_result = false;
  for (const Attribute& it : document_.attributes(element)) {
    if (it.name == "of" || it.name == "path") {
      (it.name == "of" ? row.of : row.path) = it.value;
      row.place = it.place;
    } else if (it.name == "does" || it.name == "each") {
      ++sources;
      read_words(it, row);
      row.restarts = it.name == "each";
    } else if (it.name == "from") {
      ++sources;
      read_source(it, row);
    } else if (it.name == "result") {
      ++sources;
      has_result = true;
      row.source = it.place;
    }
  }
  const Place place = document_.elements()[element].place;
  if (row.of.empty() == row.path.empty()) {
    return report_.at("bad-attributes"_code, place, "give exactly one of 'of' and 'path'");
  }
  if (sources != 1) {
    return report_.at("bad-scenario"_code, place,
                      "give exactly one of 'does', 'each', 'result' and 'from'",
                      "does=\"R.25 R.5 S\", or result=\"success\" ticks=\"3\"");
  }
  for (const Attribute& it : document_.attributes(element)) {
    const bool needs_result =
        it.name == "ticks" || it.name == "seconds" || it.name.starts_with(leaf_words::kOutput);
    if (needs_result && !has_result) {
      return report_.at("bad-scenario"_code, it.place,
                        fmt::format("'{}' is of a leaf with 'result'", it.name));
    }
  }
  if (has_result) make_words(element, row);
  into.bindings.push_back(std::move(row));
}

void BindingReader::read_words(const Attribute& it, BindingRow& row) const {
  Words all = parse_words(it.value);
  row.source = it.place;
  if (!all.wrong.empty()) {
    report_.in_value("bad-scenario"_code, it.place, all.offset,
                     fmt::format("'{}' is not a word of a leaf", brief(all.wrong)),
                     "there are R.5 (running, with its progress), S, F, K (skipped), X (a fault), "
                     "~.5 (held), S[port=value] (it writes), R.5*3 (three times)");
  } else if (all.words.empty()) {
    report_.at_value("bad-scenario"_code, it.place, "a leaf without words", "write R.25 R.5 S");
  }
  row.words = std::move(all.words);
}

void BindingReader::read_source(const Attribute& it, BindingRow& row) const {
  row.source = it.place;
  row.from = it.value == "plugin" ? BindingRow::From::Plugin : BindingRow::From::Recording;
  if (row.from == BindingRow::From::Recording) row.recording = beside(file_, it.value);
}

// Progress rises in equal steps.
void BindingReader::make_words(std::uint32_t element, BindingRow& row) const {
  const std::string_view result = document_.find_attribute(element, "result")->value;
  const Attribute *ticks = document_.find_attribute(element, "ticks"),
                  *seconds = document_.find_attribute(element, "seconds");
  if (ticks != nullptr && seconds != nullptr) {
    report_.at("bad-attributes"_code, seconds->place, "give one of 'ticks' and 'seconds'");
  }
  row.restarts = row.has_result = true;
  row.result = status_of(result);
  row.is_fault = result == "fault";
  if (seconds != nullptr) row.seconds = number(*seconds, 0, 1e9);
  for (const Attribute& it : document_.attributes(element)) {
    if (!it.name.starts_with(leaf_words::kOutput)) continue;
    row.written.emplace_back(it.name.substr(leaf_words::kOutput.size()), it.value);
  }
  if (!row.seconds) add_even_words(row, ticks == nullptr ? 1 : count(*ticks, 1));
}

std::uint64_t BindingReader::count(const Attribute& it, std::uint64_t least) const {
  const auto number = parse_int(it.value);
  if (number && *number >= 0 && static_cast<std::uint64_t>(*number) >= least) {
    return static_cast<std::uint64_t>(*number);
  }
  report_.at_value("bad-value"_code, it.place,
                   fmt::format("'{}' is not a whole number from {}", brief(it.value), least));
  return least;
}

double BindingReader::number(const Attribute& it, double least, double most) const {
  const auto number = parse_double(it.value);
  if (number && *number >= least && *number <= most) return *number;
  report_.at_value("bad-value"_code, it.place,
                   fmt::format("'{}' must be a number from {} to {}", it.name, least, most));
  return least;
}

NumberRange BindingReader::range(const Attribute& it, std::string_view as) const {
  const auto parts = split(it.value, "..");
  const auto least = parse_double(parts.front());
  const auto most = parse_double(parts.back());
  const bool is_open = parts.size() == 2 && parts.back() == "inf";
  const bool fits =
      least && *least >= 0 && parts.size() <= 2 && (is_open || (most && *most >= *least));
  if (fits) return {*least, is_open ? std::nullopt : most};
  report_.at_value("bad-scenario"_code, it.place,
                   fmt::format("'{}' is not a range", brief(it.value)),
                   fmt::format("write {}", as));
  return {};
}

}  // namespace lockstep::host
