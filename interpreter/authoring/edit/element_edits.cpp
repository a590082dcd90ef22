#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "authoring/edit/edits.h"
#include "authoring/edit/element_text.h"
#include "authoring/edit/line_shift.h"
#include "authoring/edit/slot.h"
#include "core/pre_order.h"
#include "core/wording.h"
#include "document/well_formed.h"

namespace lockstep::host {
namespace {

auto broken() {
  return problem("the text is broken at this place");
}

auto is_root() {
  return problem("a file needs its root element");
}

// Its lines, if nothing else is in them.
void remove_part(TextEdit& edit, std::string_view text, std::size_t begin, std::size_t end) {
  if (indentation(text, begin) && ends_line(text, end)) {
    begin = line_begin(text, begin);
    end = std::min(text.find('\n', end), text.size() - 1) + 1;
  }
  edit.remove(begin, end);
}

void insert_at(TextEdit& edit, const ChildSlotText& slot, std::string_view xml) {
  edit.replace(slot.begin, slot.end, fmt::format("{}{}{}", slot.before, xml, slot.after));
}

std::optional<Problem> check_fragment(std::string_view xml, Grammar grammar) {
  const std::string text = fmt::format("<r>{}</r>", xml);
  const WellFormed written = check_well_formed(text, {}, grammar);
  if (written.readable) return std::nullopt;
  return Problem{written.faults.front().message, written.faults.front().hint};
}

// Which of the children of `parent` it is.
std::uint32_t index_of(const Document& document, std::uint32_t parent, std::uint32_t element) {
  const auto elements = document.elements();
  std::uint32_t index = 0;
  for (const std::uint32_t child : children_in(elements, parent)) {
    if (child == element) return index;
    ++index;
  }
  return UINT32_MAX;
}

std::uint32_t count_children(const Document& document, std::uint32_t parent) {
  const auto elements = document.elements();
  std::uint32_t count = 0;
  for ([[maybe_unused]] const auto child : children_in(elements, parent)) ++count;
  return count;
}

bool is_tag(std::string_view tag, Grammar grammar) {
  const std::string text = fmt::format("<{}>", tag);
  Scanner scanner(text, grammar);
  if (scanner.next().kind != TokenKind::OpenTag) return false;
  XmlToken token = scanner.next();
  while (token.kind == TokenKind::Attribute) token = scanner.next();
  return token.kind == TokenKind::TagEnd && scanner.next().kind == TokenKind::End;
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

Result<TextEdit> insert_element(const Document& document, ChildSlot slot, std::string_view xml) {
  const Grammar grammar = grammar_of(document);
  if (auto wrong = check_fragment(xml, grammar)) return tl::unexpected(std::move(*wrong));
  const auto at = slot_text(document, slot);
  if (!at) return broken();
  const std::string_view line_end = line_end_of(document.source()->text());
  TextEdit edit;
  insert_at(edit, *at,
            shifted(with_line_ends(xml, grammar, line_end), grammar, {}, at->indentation));
  return edit;
}

Result<TextEdit> delete_element(const Document& document, std::uint32_t element) {
  if (element == 0) return is_root();
  const auto at = element_text(document, element);
  if (!at) return broken();
  TextEdit edit;
  remove_part(edit, document.source()->text(), at->tag.begin, at->end);
  return edit;
}

Result<TextEdit> move_element(const Document& document, std::uint32_t element, ChildSlot slot) {
  if (element == 0) return is_root();
  if (slot.parent >= element && slot.parent < document.elements()[element].end) {
    return problem("an element cannot move into itself");
  }
  TextEdit edit;
  slot.index = std::min(slot.index, count_children(document, slot.parent));
  const std::uint32_t own = index_of(document, slot.parent, element);
  if (own != UINT32_MAX && (slot.index == own || slot.index == own + 1)) return edit;
  const auto from = element_text(document, element);
  const auto to = slot_text(document, slot);
  if (!from || !to) return broken();
  const std::string_view text = document.source()->text();
  const std::string_view xml = text.substr(from->tag.begin, from->end - from->tag.begin);
  insert_at(edit, *to,
            shifted(xml, grammar_of(document), indentation(text, from->tag.begin).value_or(""),
                    to->indentation));
  remove_part(edit, text, from->tag.begin, from->end);
  return edit;
}

Result<TextEdit> wrap_element(const Document& document, std::uint32_t element,
                              std::string_view tag) {
  if (element == 0) return is_root();
  const Grammar grammar = grammar_of(document);
  if (!is_tag(tag, grammar)) {
    return problem(fmt::format("'<{}>' is not a tag", brief(tag)),
                   "write Name attribute=\"value\"");
  }
  const auto at = element_text(document, element);
  if (!at) return broken();
  const std::string_view text = document.source()->text();
  const std::string close = fmt::format("</{}>", Cursor(tag).take_name());
  const auto outer = indentation(text, at->tag.begin);
  TextEdit edit;
  if (!outer) {
    edit.insert(at->tag.begin, fmt::format("<{}>", tag));
    edit.insert(at->end, close);
    return edit;
  }
  const std::string inner = std::string(*outer).append(indentation_unit(document));
  edit.insert(at->tag.begin, fmt::format("<{}>{}{}", tag, line_end_of(text), inner));
  shift_lines(edit, at->tag.begin, text.substr(at->tag.begin, at->end - at->tag.begin), grammar,
              *outer, inner);
  edit.insert(at->end, fmt::format("{}{}{}", line_end_of(text), *outer, close));
  return edit;
}

Result<TextEdit> unwrap_element(const Document& document, std::uint32_t element) {
  if (element == 0) return is_root();
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
