#include "author/server/features/site.h"

#include "author/edit/element_text.h"

namespace lockstep::host {
namespace {

Site in_tag(const TolerantTree& tree, const TolerantElement& element, std::size_t byte) {
  const ByteRange tag = range_of(tree, element.tag);
  if (byte <= tag.end) return {Site::Part::Tag, &element, nullptr, tag};
  for (const TolerantAttribute& it : tree.attributes_of(element)) {
    const ByteRange name = range_of(tree, it.name);
    if (name.has(byte)) return {Site::Part::AttributeName, &element, &it, name};
    if (!it.has_quote) continue;
    const ByteRange value = range_of(tree, it.value);
    if (value.has(byte)) return {Site::Part::AttributeValue, &element, &it, value};
    // The value of an open quote ends before its blanks, and the person who types is behind them.
    if (it.is_closed || byte < value.end) continue;
    const std::string_view between = tree.text.substr(value.end, byte - value.end);
    if (between.find_first_not_of(" \t") == between.npos)
      return {Site::Part::AttributeValue, &element, &it, {value.begin, byte}};
  }
  return {Site::Part::AttributeName, &element, nullptr, {byte, byte}};
}

// The selection without the blanks around it.
ByteRange trimmed(std::string_view text, ByteRange selection) {
  constexpr std::string_view kBlanks = " \t\r\n";
  const bool is_cursor = selection.begin >= selection.end;
  if (is_cursor && !indentation(text, selection.begin)) return {selection.begin, selection.begin};
  const std::size_t end = is_cursor ? line_end(text, selection.begin) : selection.end;
  const std::size_t begin = text.find_first_not_of(kBlanks, selection.begin);
  if (begin >= end) return selection;
  return {begin, is_cursor ? begin : text.find_last_not_of(kBlanks, end - 1) + 1};
}

}  // namespace

SelectedElements selected_elements(const TolerantTree& tree, ByteRange selection) {
  const auto [begin, end] = trimmed(tree.text, selection);
  const TolerantElement* first = nullptr;
  for (const TolerantElement& it : tree.elements) {
    if (it.begin > begin) break;
    const bool is_in_tag = begin <= it.tag_end || begin >= it.close;
    if (is_in_tag && begin <= it.end) first = &it;
  }
  if (first == nullptr) return {};
  const TolerantElement* last = first;
  for (const TolerantElement& it : tree.elements)
    if (it.parent == first->parent && it.begin > last->begin && it.begin < end) last = &it;
  return end <= last->end ? SelectedElements{first, last} : SelectedElements{};
}

Site site_at(const TolerantTree& tree, std::size_t byte) {
  if (tree.is_in_comment(byte)) return {};
  const TolerantElement* const element = tree.at(byte);
  if (element != nullptr && element->has_in_tag(byte)) return in_tag(tree, *element, byte);
  const auto sign = tree.text.substr(0, byte).find_last_of("<>");
  if (sign != std::string_view::npos && tree.text[sign] == '<') {
    if (tree.text.substr(sign, byte - sign).starts_with("</"))
      return {Site::Part::EndTag, tree.at(sign), nullptr, {sign + 2, byte}};
    return {};
  }
  return {Site::Part::Content, element, nullptr, {byte, byte}};
}

}  // namespace lockstep::host
