#include <fmt/format.h>

#include "cli/tools/manual/page.h"
#include "cli/tools/manual/pages.h"
#include "record/lines.h"

namespace lockstep::host {
namespace {

// "[version of the law](language.md#…)" as "version of the law"
std::string without_links(std::string text) {
  for (std::size_t end = text.find("]("); end != std::string::npos; end = text.find("](")) {
    const std::size_t begin = text.rfind('[', end), last = text.find(')', end);
    if (begin == std::string::npos || last == std::string::npos) break;
    text = text.substr(0, begin) + text.substr(begin + 1, end - begin - 1) + text.substr(last + 1);
  }
  return text;
}

// "[index, status, progress]"
std::string parts_of(std::string_view type) {
  for (const lines::Tuple& tuple : lines::kTuples) {
    if (!type.starts_with(tuple.name)) continue;
    std::string text;
    for (const auto& part : tuple.parts) {
      if (!part.name.empty()) text += fmt::format("{}{}", text.empty() ? "" : ", ", part.name);
    }
    return "`[" + text + "]`";
  }
  return {};
}

std::string about(const lines::Field& field) {
  std::string text = without_links(std::string(field.meaning));
  if (const std::size_t at = text.find("{}"); at != std::string::npos)
    text.replace(at, 2, parts_of(field.type));
  return text + ".";
}

}  // namespace

ManualFile recording_page(std::string_view date) {
  ManualPage page("lockstep-recording", "5", date, "what lockstep run --record writes");
  page.section("DESCRIPTION");
  page.text(
      "A recording is JSON Lines: UTF-8, one object a line. The first line is the header, then "
      "comes one line for each tick in which something changed, and at last the end. A file whose "
      "name ends in `.zst` is compressed with zstd. A reader skips keys that it does not know.");
  for (const lines::Object& object : lines::kObjects) {
    page.subsection(object.name);
    page.begin_list();
    for (const lines::Field& field : object.fields) page.item(mdoc_word(field.key), about(field));
    page.end_list();
  }
  page.section("EXAMPLES");
  page.literal(
      "lockstep run --example door_pulling --record run.jsonl\n"
      "lockstep log info run.jsonl");
  page.section("SEE ALSO");
  page.line(
      ".Xr lockstep 1 ,\n.Xr lockstep-log 1 ,\n.Xr lockstep-replay 1 ,\n.Xr lockstep-run 1 ,\n"
      ".Xr lockstep-tree 5");
  return {"man5/lockstep-recording.5", page.roff()};
}

}  // namespace lockstep::host
