#include "cli/check_formats.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/core/utf8.h"
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
  return fmt::format("::{} {}title=lockstep{}::{}\n", github_word(message.severity), properties,
                     message.code.empty() ? "" : fmt::format(" {}", message.code.text()),
                     escaped(whole_text(message), kData));
}

Json json_of(const Mend& mend) {
  Json patches = Json::array();
  for (const Patch& it : mend.edit.patches())
    patches.push_back(Json{{"begin", it.begin}, {"end", it.end}, {"text", it.text}});
  return {{"title", mend.title}, {"certain", mend.is_certain}, {"patches", std::move(patches)}};
}

}  // namespace

std::string as_json(std::span<const MendableMessage> messages) {
  Json all = Json::array();
  for (const auto& [it, place, mends] : messages) {
    Json message{{"severity", to_string(it.severity)},
                 {"code", it.code.text()},
                 {"file", it.location.file},
                 {"line", it.location.line},
                 {"column", it.location.column}};
    if (place) {
      message.add("begin", place->begin);
      message.add("end", place->end);
    }
    message.add("message", it.message);
    message.add("hint", it.hint);
    Json edits = Json::array();
    for (const Mend& mend : mends) edits.push_back(json_of(mend));
    message.add("edits", std::move(edits));
    all.push_back(std::move(message));
  }
  return all.printable(2) + "\n";
}

std::string as_github(std::span<const MendableMessage> messages) {
  std::string lines;
  for (const MendableMessage& it : messages) lines += github_line(it.message);
  return lines;
}

}  // namespace lockstep::host
