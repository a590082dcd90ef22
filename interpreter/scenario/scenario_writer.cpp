#include "scenario/scenario_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

#include "base/core/diagnostics.h"
#include "base/core/wording.h"
#include "base/system/output_file.h"
#include "base/system/replace_text.h"
#include "language/document/document.h"
#include "language/document/file.h"
#include "language/document/scanner.h"
#include "language/document/value_text.h"
#include "language/document/well_formed.h"
#include "scenario/binding_reader.h"

namespace lockstep::host {
namespace {

// A value of an attribute, in which "${" is no value of a row.
std::string literal(std::string_view text) {
  constexpr std::string_view kOfRow = "${";
  std::string safe(text);
  for (auto at = safe.find(kOfRow); at != safe.npos; at = safe.find(kOfRow, at + 1 + kOfRow.size()))
    safe.insert(at, 1, '$');
  return escaped(safe);
}

constexpr std::string_view kEnd = "</scenarios>";

// "0.5", in seconds. An attribute cannot have an exponent.
std::string decimal(Nanoseconds time) {
  std::string text =
      fmt::format("{}.{:09}", time.count() / 1'000'000'000, time.count() % 1'000'000'000);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

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

struct Existing {
  std::string text;
  std::unique_ptr<Document> document;
  std::size_t end = 0;  // where more scenarios come
};

// Its last close tag, which is none in a comment.
std::optional<std::size_t> end_of_scenarios(std::string_view text) {
  std::optional<std::size_t> last;
  Scanner scanner(text);
  for (XmlToken token = scanner.next(); token.kind != TokenKind::End; token = scanner.next()) {
    if (token.kind == TokenKind::Fault) return std::nullopt;
    if (token.kind == TokenKind::CloseTag) last = token.begin;
  }
  return last;
}

Result<Existing> read_existing(const std::string& path) {
  auto text = read_file(path, Document::kMaxBytes);
  if (!text) return problem(fmt::format("cannot read '{}': {}", path, text.error().message));
  Diagnostics diagnostics;
  auto document = Document::parse(path, *text, diagnostics);
  const auto end = end_of_scenarios(*text);
  if (document == nullptr || document->elements()[0].tag != "scenarios" || !end) {
    return problem(fmt::format("'{}' is not a file of scenarios", path),
                   "it ends with </scenarios>");
  }
  return Existing{std::move(*text), std::move(document), *end};
}

std::vector<std::string_view> names_in(const Document& document) {
  std::vector<std::string_view> names;
  for (std::uint32_t at = 0; at < document.elements().size(); ++at) {
    if (document.elements()[at].tag != "scenario") continue;
    if (const Attribute* name = document.find_attribute(at, "name")) names.push_back(name->value);
  }
  return names;
}

// The name of a file in another one.
std::string named_in(const std::string& path, const std::string& file) {
  const auto folder = std::filesystem::path(path).parent_path();
  return std::filesystem::proximate(file, folder.empty() ? "." : folder).string();
}

std::string ending_text(const RecordedWords& words) {
  const bool is_cut = words.result.empty() || words.result == "stopped";
  const std::uint64_t most = words.ticks.value_or(0);
  const std::uint64_t least = most > words.spare_ticks ? most - words.spare_ticks : 1;
  std::string ticks = fmt::format(" ticks=\"{}\"", most);
  if (words.lacks_ticks)
    ticks.clear();
  else if (!is_cut && least < most)
    ticks = fmt::format(" ticks=\"{}..{}\"", least, most);
  return fmt::format("    <expect result=\"{}\"{}/>\n", is_cut ? "running" : words.result, ticks);
}

}  // namespace

std::string to_text(const RecordedWords& words, const ScenarioText& about) {
  std::string text;
  for (const std::string& line : about.comments) {
    std::string safe = printable(line);
    for (auto at = safe.find("--"); at != std::string::npos; at = safe.find("--")) safe[at] = ' ';
    text += fmt::format("  <!-- {} -->\n", safe);
  }
  text += fmt::format("  <scenario name=\"{}\"", literal(printable(about.name)));
  if (!about.tree.empty()) text += fmt::format(" tree=\"{}\"", literal(about.tree));
  if (!about.main.empty()) text += fmt::format(" main=\"{}\"", literal(about.main));
  if (words.rate) text += fmt::format(" rate=\"{}\"", *words.rate);
  if (!words.tick.empty()) text += fmt::format(" tick=\"{}\"", literal(words.tick));
  const bool is_cut = words.result.empty() || words.result == "stopped";
  if (is_cut && words.ticks && about.has_limit)
    text += fmt::format(" max-ticks=\"{}\"", std::max<std::uint64_t>(*words.ticks, 1));
  text += ">\n";
  for (const auto& [name, value] : words.arguments) {
    text += fmt::format("    <arg name=\"{}\" value=\"{}\"/>\n", name, literal(value));
  }
  for (const auto& it : words.changes) {
    text += fmt::format("    <set key=\"{}\" value=\"{}\" tick=\"{}\"/>\n", literal(it.key),
                        literal(it.value), it.tick);
  }
  for (const auto& it : words.late) {
    text += fmt::format("    <late tick=\"{}\" by=\"{}\"/>\n", it.tick, decimal(it.by));
  }
  for (const auto& [path, leaf] : words.leaves) {
    text += fmt::format("    <leaf path=\"{}\" does=\"{}\"/>\n", literal(path),
                        literal(words_text(leaf)));
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

Result<std::string> scenario_file(const std::string& tree, const std::string& scenarios) {
  std::string text =
      fmt::format("<scenarios lockstep=\"1\" tree=\"{}\">\n{}{}\n", escaped(tree), scenarios, kEnd);
  if (const auto fault = check_encoding(text)) {
    return problem(fmt::format("a scenario cannot have this text: {}", fault->message),
                   "it has the names of the tree file, of nodes and of properties");
  }
  return text;
}

Result<std::string> tree_in_scenario_file(const std::string& path, const ScenarioTree& tree) {
  if (tree.file == "-") {
    return problem("a scenario needs a file with its tree, and this one was read from stdin",
                   "give the tree as a file");
  }
  if (!std::filesystem::exists(path)) return std::string();
  const auto existing = read_existing(path);
  if (!existing) return tl::unexpected(existing.error());
  const Attribute* const file = existing->document->find_attribute(0, "tree");
  const Attribute* const main = existing->document->find_attribute(0, "main");
  if (file != nullptr && !is_same_file(beside(path, file->value), tree.file)) {
    return problem(fmt::format("'{}' has scenarios of the tree '{}', not of '{}'", path,
                               brief(file->value), named_in(path, tree.file)),
                   "name another file");
  }
  if (main != nullptr && tree.main.empty() && main->value != tree.id) {
    return problem(fmt::format("'{}' has scenarios of the BehaviorTree '{}', not of '{}'", path,
                               brief(main->value), tree.id),
                   "name another file");
  }
  return file != nullptr ? std::string() : named_in(path, tree.file);
}

Result<void> add_to_scenario_file(const std::string& path, const ScenarioTree& tree,
                                  const std::string& scenarios) {
  if (const auto fits = tree_in_scenario_file(path, tree); !fits)
    return tl::unexpected(fits.error());
  const auto whole = scenario_file(named_in(path, tree.file), scenarios);
  if (!whole) return tl::unexpected(whole.error());
  if (!std::filesystem::exists(path)) return create_text(path, *whole);
  const auto existing = read_existing(path);
  if (!existing) return tl::unexpected(existing.error());
  Diagnostics diagnostics;
  const auto added = Document::parse(path, *whole, diagnostics);
  const auto there = names_in(*existing->document);
  for (const std::string_view name : names_in(*added)) {
    if (std::ranges::find(there, name) == there.end()) continue;
    return problem(fmt::format("'{}' has a scenario '{}' already", path, name),
                   "rename that, or name another file");
  }
  return replace_text(path, existing->text,
                      std::string(existing->text).insert(existing->end, scenarios));
}

}  // namespace lockstep::host
