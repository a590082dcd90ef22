#include "authoring/server/features/site.h"

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
  }
  return {Site::Part::AttributeName, &element, nullptr, {byte, byte}};
}

}  // namespace

Site site_at(const TolerantTree& tree, std::size_t byte) {
  if (tree.is_in_comment(byte)) return {};
  const TolerantElement* const element = tree.at(byte);
  if (element != nullptr && element->has_in_tag(byte)) return in_tag(tree, *element, byte);
  const auto sign = tree.text.substr(0, byte).find_last_of("<>");
  if (sign != std::string_view::npos && tree.text[sign] == '<') {
    if (tree.text.substr(sign).starts_with("</"))
      return {Site::Part::EndTag, tree.at(sign), nullptr, {sign + 2, byte}};
    return {};
  }
  return {Site::Part::Content, element, nullptr, {byte, byte}};
}

}  // namespace lockstep::host
