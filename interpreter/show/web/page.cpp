#include "show/web/page.h"

#include <fmt/format.h>

#include <utility>

#include "show/web/page_text.h"

namespace lockstep::host {
namespace {

constexpr std::string_view kSourceBegin = R"(<script type="application/json" id="source">)";

// Nothing in it ends the element in which it stands.
std::string without_tags(std::string_view json) {
  std::string text;
  text.reserve(json.size());
  for (const char letter : json) {
    if (letter == '<') {
      text += "\\u003c";
    } else {
      text += letter;
    }
  }
  return text;
}

// The page in front of the source, and behind it.
std::pair<std::string_view, std::string_view> parts_around_source() {
  const std::size_t begin = kPage.find(kSourceBegin) + kSourceBegin.size();
  return {kPage.substr(0, begin), kPage.substr(kPage.find('<', begin))};
}

constexpr std::string_view kRecordingBegin = R"("recording":")", kRecordingEnd = R"("})";

}  // namespace

std::string page_with_source(std::string_view source) {
  const auto [before, behind] = parts_around_source();
  return std::string(before) + without_tags(source) + std::string(behind);
}

RecordingPage::RecordingPage(Gzip::Sink sink, std::optional<std::uint64_t> from,
                             std::optional<std::uint64_t> to)
    : sink_(std::move(sink)),
      base64_(sink_),
      gzip_([this](std::string_view bytes) { base64_.add(bytes); }) {
  sink_(parts_around_source().first);
  sink_("{");
  if (from) sink_(fmt::format(R"("from":{},)", *from));
  if (to) sink_(fmt::format(R"("to":{},)", *to));
  sink_(kRecordingBegin);
}

void RecordingPage::finish() {
  gzip_.finish();
  base64_.finish();
  sink_(kRecordingEnd);
  sink_(parts_around_source().second);
}

std::string_view page_policy() {
  constexpr std::string_view kBegin = R"("Content-Security-Policy" content=")";
  const std::size_t begin = kPage.find(kBegin) + kBegin.size();
  return kPage.substr(begin, kPage.find('"', begin) - begin);
}

}  // namespace lockstep::host
