#include "author/server/diagnostics_json.h"

#include <fmt/format.h>

#include <algorithm>

#include "language/document/cursor.h"

namespace lockstep::host {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

int severity_number(Severity severity) {
  constexpr int kNumbers[] = {1, 2, 3};  // error, warning, information
  return kNumbers[static_cast<std::size_t>(severity)];
}

// The end of what begins at `begin`, at least one character of the line.
std::size_t end_of(std::string_view text, std::size_t begin) {
  const std::string_view rest = text.substr(begin);
  const std::string_view line = rest.substr(0, std::min(rest.find_first_of("\r\n"), rest.size()));
  if (line.empty()) return begin;
  const char before = begin == 0 ? ' ' : text[begin - 1];
  if (before == '"' || before == '\'') {
    const auto quote = line.find(before);
    if (quote != line.npos && quote > 0) return begin + quote;
  }
  const std::size_t sign = line.starts_with("</") ? 2 : line.starts_with('<') ? 1 : 0;
  Cursor cursor(line);
  cursor.go_to(sign);
  const std::size_t name = cursor.take_name().size();
  if (sign + name > 0) return begin + sign + name;
  std::size_t length = 1;
  while (length < line.size() && (static_cast<unsigned char>(line[length]) & 0xC0u) == 0x80)
    ++length;
  return begin + length;
}

class Converter {
 public:
  Converter(const Analysis& analysis, const Workspace& workspace, bool has_related_information)
      : analysis_(analysis),
        workspace_(workspace),
        has_related_information_(has_related_information) {}

  DiagnosticsByUri run() {
    for (const Diagnostic& it : analysis_.diagnostics) {
      const Text& text = text_of(it.location.file);
      result_[text.uri].push_back(converted(it, text));
    }
    return std::move(result_);
  }

 private:
  struct Text {
    std::string uri;
    std::shared_ptr<const Source> source;
    Positions positions;
    LineIndex lines;
    bool has_mark;  // which the editor counts as a character
  };

  // A message about no file is at the beginning of the one that was checked.
  const Text& text_of(const std::string& path) {
    const auto known = texts_.find(path);
    if (known != texts_.end()) return known->second;
    const auto found = std::ranges::find_if(
        analysis_.texts, [&](const auto& source) { return source->path() == path; });
    const auto& source = found == analysis_.texts.end() ? analysis_.texts.front() : *found;
    const bool is_main = source == analysis_.texts.front();
    std::string uri = is_main ? analysis_.uri : workspace_.uri_of(path);
    const auto open = workspace_.files().find(uri);
    const bool has_mark =
        open != workspace_.files().end() && open->second.bytes().starts_with(kByteOrderMark);
    return texts_
        .emplace(path, Text{std::move(uri), source, Positions(source->text()),
                            LineIndex(source->text()), has_mark})
        .first->second;
  }

  static Json json(const Text& text, std::size_t byte) {
    Position position = text.positions.position_of(byte);
    if (position.line == 0 && text.has_mark) ++position.character;
    return {{"line", position.line}, {"character", position.character}};
  }

  Json converted(const Diagnostic& it, const Text& text) const {
    const bool is_here = it.location.file == text.source->path();
    const ByteRange bytes =
        is_here ? range_of(text.source->text(), text.lines, it.location) : ByteRange{0, 0};
    Json range{{"start", json(text, bytes.begin)}, {"end", json(text, bytes.end)}};
    std::string message = it.message;
    const bool adds_hint = !it.hint.empty() && !has_related_information_;
    if (adds_hint) message += fmt::format("\nhint: {}", it.hint);
    Json json{{"range", range},
              {"severity", severity_number(it.severity)},
              {"source", "lockstep"},
              {"code", it.code.text()},
              {"message", std::move(message)}};
    if (it.hint.empty() || adds_hint) return json;
    Json place{{"uri", text.uri}, {"range", std::move(range)}};
    std::vector<Json> related;
    related.push_back(Json{{"location", std::move(place)}, {"message", it.hint}});
    json["relatedInformation"] = Json::array(std::move(related));
    return json;
  }

  const Analysis& analysis_;
  const Workspace& workspace_;
  bool has_related_information_;
  std::map<std::string, Text> texts_;  // by path
  DiagnosticsByUri result_;
};

}  // namespace

ByteRange range_of(std::string_view text, const LineIndex& lines, const SourceLocation& place) {
  if (place.line == 0) return {0, 0};
  const std::string_view line = lines.line(place.line);
  if (line.data() == nullptr) return {text.size(), text.size()};
  const auto start = static_cast<std::size_t>(line.data() - text.data());
  const std::size_t begin =
      std::min<std::size_t>(start + (place.column == 0 ? 0 : place.column - 1), text.size());
  return {begin, end_of(text, begin)};
}

DiagnosticsByUri diagnostics_of(const Analysis& analysis, const Workspace& workspace,
                                bool has_related_information) {
  return Converter(analysis, workspace, has_related_information).run();
}

}  // namespace lockstep::host
