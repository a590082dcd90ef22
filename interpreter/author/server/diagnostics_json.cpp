#include "author/server/diagnostics_json.h"

#include <fmt/format.h>

#include <algorithm>

#include "language/document/byte_order_mark.h"

namespace lockstep::host {
namespace {

int severity_number(Severity severity) {
  constexpr int kNumbers[] = {1, 2, 3};  // error, warning, information
  return kNumbers[static_cast<std::size_t>(severity)];
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
        open != workspace_.files().end() && !byte_order_mark(open->second.bytes()).empty();
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

DiagnosticsByUri diagnostics_of(const Analysis& analysis, const Workspace& workspace,
                                bool has_related_information) {
  return Converter(analysis, workspace, has_related_information).run();
}

}  // namespace lockstep::host
