#include "author/edit/slot.h"

#include <algorithm>

#include "author/edit/element_text.h"

namespace lockstep::host {
namespace {

// Behind the comment at the end of the line, which belongs to what is before it.
std::size_t behind_comment(std::string_view text, std::size_t at) {
  const auto begin = text.find_first_not_of(" \t", at);
  if (begin == std::string_view::npos || !text.substr(begin).starts_with("<!--")) return at;
  const auto end = text.find("-->", begin + 4);
  if (end == std::string_view::npos || !ends_line(text, end + 3)) return at;
  return line_end(text, at) < end ? at : end + 3;
}

// Where the comments begin that fill the lines before `at`.
std::size_t before_comments(std::string_view text, std::size_t at) {
  for (;;) {
    if (!indentation(text, at)) return at;
    std::string_view before = text.substr(0, line_begin(text, at));
    if (before.ends_with('\n')) before.remove_suffix(1);
    before = before.substr(0, before.find_last_not_of(" \t\r") + 1);
    if (!before.ends_with("-->")) return at;
    const std::size_t begin = before.rfind("<!--");
    if (!indentation(text, begin)) return at;
    at = begin;
  }
}

}  // namespace

std::string indentation_unit(const Document& document) {
  const std::string_view text = document.source()->text();
  const auto elements = document.elements();
  const auto indentation_at = [&](std::uint32_t element) {
    return indentation(text, offset_of(document, elements[element].place));
  };
  for (std::uint32_t parent = 0; parent < elements.size(); ++parent) {
    const auto outer = indentation_at(parent);
    if (!outer || elements[parent].end == parent + 1) continue;
    const auto inner = indentation_at(parent + 1);
    if (inner && inner->size() > outer->size() && inner->starts_with(*outer)) {
      return std::string(inner->substr(outer->size()));
    }
  }
  return "  ";
}

std::optional<SlotText> slot_behind(const Document& document, std::uint32_t sibling) {
  const auto at = element_text(document, sibling);
  if (!at) return std::nullopt;
  const std::string_view text = document.source()->text();
  const auto outer = indentation(text, at->tag.begin);
  if (!outer) return SlotText{at->end, {}, {}};
  const std::string line_end(line_end_of(text)), indent(*outer);
  // An empty line before the sibling is one before the new element, too.
  const std::size_t begin = line_begin(text, before_comments(text, at->tag.begin));
  const bool is_apart = text.substr(0, begin).ends_with("\n" + line_end);
  return SlotText{behind_comment(text, at->end), line_end + (is_apart ? line_end : "") + indent,
                  indent};
}

std::optional<CommentedText> commented_text(const Document& document, std::uint32_t element) {
  const auto at = element_text(document, element);
  if (!at) return std::nullopt;
  const std::string_view text = document.source()->text();
  return CommentedText{before_comments(text, at->tag.begin), behind_comment(text, at->end)};
}

bool ends_line(std::string_view text, std::size_t at) {
  const auto next = std::min(text.find_first_not_of(" \t\r", at), text.size());
  return next == text.size() || text[next] == '\n';
}

}  // namespace lockstep::host
