#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "author/edit/edits.h"
#include "author/edit/element_text.h"
#include "author/edit/line_shift.h"
#include "author/edit/slot.h"
#include "base/core/pre_order.h"
#include "language/document/cursor.h"

namespace lockstep::host {
namespace {

auto broken() {
  return problem("the text is broken at this place");
}

// Its lines, if nothing else is in them.
void remove_part(TextEdit& edit, std::string_view text, std::size_t begin, std::size_t end) {
  if (indentation(text, begin) && ends_line(text, end)) {
    begin = line_begin(text, begin);
    end = std::min(text.find('\n', end), text.size() - 1) + 1;
  }
  edit.remove(begin, end);
}

// The indentation of the first child that begins a line.
std::optional<std::string_view> indentation_inside(const Document& document,
                                                   std::uint32_t element) {
  const auto elements = document.elements();
  for (const std::uint32_t child : children_in(elements, element)) {
    const auto it =
        indentation(document.source()->text(), offset_of(document, elements[child].place));
    if (it) return it;
  }
  return std::nullopt;
}

}  // namespace

Result<TextEdit> insert_behind(const Document& document, std::uint32_t sibling,
                               std::string_view xml) {
  const Grammar grammar = grammar_of(document);
  const auto slot = slot_behind(document, sibling);
  if (!slot) return broken();
  const std::string_view line_end = line_end_of(document.source()->text());
  TextEdit edit;
  edit.insert(slot->at, slot->before + shifted(with_line_ends(xml, grammar, line_end), grammar, {},
                                               slot->indentation));
  return edit;
}

Result<TextEdit> delete_element(const Document& document, std::uint32_t element) {
  const auto at = element_text(document, element);
  if (!at) return broken();
  TextEdit edit;
  remove_part(edit, document.source()->text(), at->tag.begin, at->end);
  return edit;
}

Result<TextEdit> swap_elements(const Document& document, std::uint32_t first,
                               std::uint32_t second) {
  const auto left = commented_text(document, first), right = commented_text(document, second);
  if (!left || !right) return broken();
  const std::string_view text = document.source()->text();
  const auto outer_left = indentation(text, left->begin),
             outer_right = indentation(text, right->begin);
  const auto part = [&](const CommentedText& it, auto from, auto to) {
    const std::string_view xml = text.substr(it.begin, it.end - it.begin);
    return from && to ? shifted(xml, grammar_of(document), *from, *to) : std::string(xml);
  };
  TextEdit edit;
  edit.replace(left->begin, left->end, part(*right, outer_right, outer_left));
  edit.replace(right->begin, right->end, part(*left, outer_left, outer_right));
  return edit;
}

Result<TextEdit> wrap_elements(const Document& document, std::uint32_t first, std::uint32_t last,
                               std::string_view tag) {
  const auto from = element_text(document, first), to = element_text(document, last);
  if (!from || !to) return broken();
  const std::string_view text = document.source()->text();
  const std::size_t begin = from->tag.begin, end = to->end;
  const std::string close = fmt::format("</{}>", Cursor(tag).take_name());
  const auto outer = indentation(text, begin);
  TextEdit edit;
  if (!outer) {
    edit.insert(begin, fmt::format("<{}>", tag));
    edit.insert(end, close);
    return edit;
  }
  const std::string inner = std::string(*outer).append(indentation_unit(document));
  edit.insert(begin, fmt::format("<{}>{}{}", tag, line_end_of(text), inner));
  shift_lines(edit, begin, text.substr(begin, end - begin), grammar_of(document), *outer, inner);
  edit.insert(end, fmt::format("{}{}{}", line_end_of(text), *outer, close));
  return edit;
}

Result<TextEdit> unwrap_element(const Document& document, std::uint32_t element) {
  const auto at = element_text(document, element);
  if (!at) return broken();
  const std::string_view text = document.source()->text();
  TextEdit edit;
  remove_part(edit, text, at->tag.begin, at->tag.end);
  if (at->tag.is_empty) return edit;
  const auto outer = indentation(text, at->tag.begin);
  const auto inner = indentation_inside(document, element);
  if (outer && inner) {
    shift_lines(edit, at->tag.end, text.substr(at->tag.end, at->close - at->tag.end),
                grammar_of(document), *inner, *outer);
  }
  remove_part(edit, text, at->close, at->end);
  return edit;
}

}  // namespace lockstep::host
