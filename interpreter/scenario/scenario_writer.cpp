#include "scenario/scenario_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/system/replace_text.h"
#include "language/document/document.h"
#include "language/document/file.h"
#include "language/document/value_text.h"

namespace lockstep::host {
namespace {

constexpr std::string_view kEnd = "</scenarios>";

// "R0.1 R0.2*3 S"
std::string words_text(const std::vector<LeafWord>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size();) {
    std::size_t end = i + 1;
    while (end < words.size() && words[end] == words[i]) ++end;
    // Twelve digits are more than any barrier tells apart.
    LeafWord word = words[i];
    word.progress = std::round(word.progress * 1e12) / 1e12;
    text += fmt::format("{}{}", i == 0 ? "" : " ", to_text(word));
    if (end - i > 1) text += fmt::format("*{}", end - i);
    i = end;
  }
  return text;
}

// The names in the text of scenarios, as they are written there.
std::vector<std::string> names_in(const std::string& text) {
  constexpr std::string_view kBefore = "<scenario name=\"";
  std::vector<std::string> names;
  for (auto at = text.find(kBefore); at != std::string::npos; at = text.find(kBefore, at)) {
    at += kBefore.size();
    names.push_back(text.substr(at, text.find('"', at) - at));
  }
  return names;
}

std::string ending_text(const RecordedWords& words) {
  const bool is_cut = words.result.empty() || words.result == "stopped";
  return fmt::format("    <expect result=\"{}\" ticks=\"{}\"/>\n",
                     is_cut ? "running" : words.result, words.ticks.value_or(0));
}

}  // namespace

std::string to_text(const RecordedWords& words, const ScenarioText& about) {
  std::string text;
  for (const std::string& line : about.comments) {
    std::string safe = line;
    for (auto at = safe.find("--"); at != std::string::npos; at = safe.find("--")) safe[at] = ' ';
    text += fmt::format("  <!-- {} -->\n", safe);
  }
  text += fmt::format("  <scenario name=\"{}\"", escaped(about.name));
  if (!about.main.empty()) text += fmt::format(" main=\"{}\"", escaped(about.main));
  if (words.rate) text += fmt::format(" rate=\"{}\"", *words.rate);
  if (!words.tick.empty()) text += fmt::format(" tick=\"{}\"", escaped(words.tick));
  const bool is_cut = words.result.empty() || words.result == "stopped";
  if (is_cut && words.ticks && about.has_limit)
    text += fmt::format(" max-ticks=\"{}\"", std::max<std::uint64_t>(*words.ticks, 1));
  text += ">\n";
  for (const auto& [name, value] : words.arguments) {
    text += fmt::format("    <arg name=\"{}\" value=\"{}\"/>\n", name, escaped(value));
  }
  for (const auto& it : words.changes) {
    text += fmt::format("    <set key=\"{}\" value=\"{}\" tick=\"{}\"/>\n", escaped(it.key),
                        escaped(it.value), it.tick);
  }
  for (const auto& [path, leaf] : words.leaves) {
    text += fmt::format("    <leaf path=\"{}\" does=\"{}\"/>\n", escaped(path),
                        escaped(words_text(leaf)));
  }
  for (const std::string& it : about.expected) {
    text += fmt::format("    <expect>{}</expect>\n", escaped(it));
  }
  if (!about.result.empty()) {
    text += fmt::format("    <expect result=\"{}\"/>\n", about.result);
  } else if (about.expected.empty()) {
    text += ending_text(words);
  }
  return text + "  </scenario>\n";
}

std::string scenario_file(const std::string& tree, const std::string& scenarios) {
  return fmt::format("<scenarios lockstep=\"1\" tree=\"{}\">\n{}{}\n", escaped(tree), scenarios,
                     kEnd);
}

Result<void> add_to_scenario_file(const std::string& path, const std::string& tree,
                                  const std::string& scenarios) {
  if (std::filesystem::exists(path)) {
    const auto before = read_file(path, Document::kMaxBytes);
    if (!before) return problem(fmt::format("cannot read '{}': {}", path, before.error().message));
    const auto end = before->rfind(kEnd);
    if (end == std::string::npos) {
      return problem(fmt::format("'{}' is not a file of scenarios", path),
                     "it ends with </scenarios>");
    }
    const auto there = names_in(*before);
    for (const std::string& name : names_in(scenarios)) {
      if (std::ranges::find(there, name) == there.end()) continue;
      return problem(fmt::format("'{}' has a scenario '{}' already", path, name),
                     "rename that, or name another file");
    }
    return replace_text(path, *before, std::string(*before).insert(end, scenarios));
  }
  const auto folder = std::filesystem::path(path).parent_path();
  const auto from = std::filesystem::proximate(tree, folder.empty() ? "." : folder);
  return create_text(path, scenario_file(from.string(), scenarios));
}

}  // namespace lockstep::host
