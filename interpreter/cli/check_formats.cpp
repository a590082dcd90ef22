#include "cli/check_formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "base/core/path_in_uri.h"
#include "base/core/utf8.h"
#include "base/core/version.h"
#include "base/json/json.h"

namespace lockstep::host {
namespace {

// The message and, in a separate line, the hint. A line end inside of them is made visible.
std::string whole_text(const Diagnostic& message) {
  const std::string text = printable(message.message);
  return message.hint.empty() ? text : fmt::format("{}\nhint: {}", text, printable(message.hint));
}

struct Escape {
  char character;
  std::string_view text;
};

std::string escaped(std::string_view text, std::span<const Escape> escapes) {
  std::string out;
  for (const char c : text) {
    const auto it = std::ranges::find(escapes, c, &Escape::character);
    it == escapes.end() ? out += c : out += it->text;
  }
  return out;
}

// The rules of GitHub's toolkit, @actions/core: a property ends at a comma, and a message begins
// after a colon.
constexpr Escape kProperty[] = {
    {'%', "%25"}, {'\r', "%0D"}, {'\n', "%0A"}, {':', "%3A"}, {',', "%2C"}};
constexpr auto kData = std::span(kProperty).first(3);

std::string_view github_word(Severity severity) {
  return severity == Severity::Note ? "notice" : to_string(severity);
}

std::string github_line(const Diagnostic& message) {
  const auto& [file, line, column] = message.location;
  std::string properties = file.empty() ? "" : "file=" + escaped(printable(file), kProperty) + ",";
  if (line > 0) properties += fmt::format("line={},", line);
  if (line > 0 && column > 0) properties += fmt::format("col={},", column);
  return fmt::format("::{} {}title=lockstep::{}\n", github_word(message.severity), properties,
                     escaped(whole_text(message), kData));
}

std::string uri_of(const std::string& path) {
  return (std::filesystem::path(path).is_absolute() ? "file://" : "") + path_in_uri(path);
}

// SARIF counts characters, we count bytes; nothing where the line is not known so far.
std::optional<std::size_t> column_in_characters(const Diagnostic& message) {
  const std::size_t before = message.location.column - std::size_t{1};
  if (message.location.column == 0 || message.excerpt.column != 1 ||
      before > message.excerpt.text.size())
    return std::nullopt;
  std::size_t characters = 1;
  for (std::size_t at = 0; at < before; ++characters) {
    at += std::max<std::size_t>(utf8_length(std::string_view(message.excerpt.text).substr(at)), 1);
  }
  return characters;
}

struct Rule {
  std::string_view id, level, description;
};

// A rule for each severity.
constexpr Rule kRules[] = {{"error", "error", "The tree does not run."},
                           {"warning", "warning", "The tree runs, but probably not as intended."},
                           {"note", "note", "The tree runs; this is good to know."}};

Json sarif_location(const Diagnostic& message) {
  Json physical = {{"artifactLocation", {{"uri", uri_of(message.location.file)}}}};
  if (message.location.line > 0) {
    physical["region"] = {{"startLine", message.location.line}};
    if (const auto column = column_in_characters(message)) {
      physical["region"]["startColumn"] = *column;
    }
  }
  return {{"physicalLocation", std::move(physical)}};
}

Json sarif_result(const Diagnostic& message) {
  const auto index = static_cast<std::size_t>(message.severity);
  Json result = {{"ruleId", kRules[index].id},
                 {"ruleIndex", index},
                 {"level", kRules[index].level},
                 {"message", {{"text", whole_text(message)}}}};
  result["locations"] = Json::array();
  if (!message.location.file.empty()) result["locations"].push_back(sarif_location(message));
  return result;
}

}  // namespace

std::string as_json(std::span<const Diagnostic> messages) {
  Json all = Json::array();
  for (const Diagnostic& it : messages) {
    all.push_back({{"severity", to_string(it.severity)},
                   {"file", it.location.file},
                   {"line", it.location.line},
                   {"column", it.location.column},
                   {"message", it.message},
                   {"hint", it.hint}});
  }
  return all.printable(2) + "\n";
}

std::string as_github(std::span<const Diagnostic> messages) {
  std::string lines;
  for (const Diagnostic& it : messages) lines += github_line(it);
  return lines;
}

std::string as_sarif(std::span<const Diagnostic> messages) {
  Json rules = Json::array();
  for (const Rule& rule : kRules) {
    rules.push_back({{"id", rule.id},
                     {"shortDescription", {{"text", rule.description}}},
                     {"defaultConfiguration", {{"level", rule.level}}}});
  }
  Json driver = {{"name", "lockstep"}, {"version", kVersion}, {"rules", std::move(rules)}};
  Json run = {{"tool", {{"driver", std::move(driver)}}},
              {"columnKind", "unicodeCodePoints"},
              {"results", Json::array()}};
  for (const Diagnostic& it : messages) run["results"].push_back(sarif_result(it));
  Json log = {{"$schema", "https://json.schemastore.org/sarif-2.1.0.json"}, {"version", "2.1.0"}};
  log["runs"] = Json::array({std::move(run)});
  return log.printable(2) + "\n";
}

}  // namespace lockstep::host
