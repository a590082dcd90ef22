#include "leaves/word_check.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/core/suggest.h"
#include "base/core/wording.h"

namespace lockstep::host {
namespace {

using leaf_words::Word;

// Whether the value is one of the words that a plain choice has; true for all other patterns.
bool is_one_of(const Attribute& it, const Word& word, const Reporter& report) {
  const bool is_choice = word.pattern.find('|') != std::string_view::npos &&
                         word.pattern.find_first_of("()[]:\\") == std::string_view::npos;
  if (!is_choice) return true;
  const auto choices = split(word.pattern, "|");
  if (std::ranges::find(choices, it.value) != choices.end()) return true;
  report.at_value("bad-value"_code, it.place,
                  fmt::format("'{}' cannot be '{}'", word.name, brief(it.value)),
                  suggest(it.value, choices, "it can be"));
  return false;
}

}  // namespace

std::vector<std::string_view> split(std::string_view text, std::string_view between) {
  std::vector<std::string_view> parts;
  for (auto at = text.find(between); at != std::string_view::npos; at = text.find(between)) {
    parts.push_back(text.substr(0, at));
    text.remove_prefix(at + between.size());
  }
  parts.push_back(text);
  return parts;
}

bool check_words(const Document& document, std::uint32_t element, std::string_view open,
                 std::span<const Word> words, const Reporter& report) {
  const std::string_view tag = document.elements()[element].tag;
  std::vector<std::string_view> names, may_be_empty;
  for (const Word& word : words) {
    names.push_back(word.name);
    if (word.may_be_empty) may_be_empty.push_back(word.name);
  }
  for (const auto& [name, value, place] : document.attributes(element)) {
    if (name.empty()) continue;  // it is the text
    const bool is_open = !open.empty() && name.starts_with(open);
    if (!is_open && std::ranges::find(names, name) == names.end()) {
      report.at("unknown-attribute"_code, place,
                fmt::format("unknown attribute '{}' of '{}'", brief(name), tag),
                suggest(name, names, fmt::format("attributes of '{}'", tag)));
    } else if (value.empty() && std::ranges::find(may_be_empty, name) == may_be_empty.end()) {
      report.at_value("bad-value"_code, place, fmt::format("'{}' is empty", brief(name)));
    }
  }
  bool complete = true;
  for (const Word& word : words) {
    const Attribute* const it = document.find_attribute(element, word.name);
    if (it != nullptr && !is_one_of(*it, word, report)) complete = false;
    if (it != nullptr || !word.required) continue;
    complete = false;
    report.at("missing-attribute"_code, document.elements()[element].place,
              fmt::format("'{}' needs the attribute '{}'", tag, word.name));
  }
  return complete;
}

}  // namespace lockstep::host
