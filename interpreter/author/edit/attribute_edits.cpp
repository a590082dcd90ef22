#include <fmt/format.h>

#include "author/edit/edits.h"
#include "author/edit/element_text.h"
#include "base/core/wording.h"
#include "language/document/cursor.h"
#include "language/document/value_text.h"

namespace lockstep::host {
namespace {

constexpr auto kBroken = "the text is broken at this place";

bool is_xml_name(std::string_view name) {
  return !name.empty() && Cursor(name).take_name() == name;
}

auto no_name(std::string_view name) {
  return problem(fmt::format("'{}' is not a name in XML", brief(name)),
                 "a letter or '_', then letters, digits, '_', '-' or '.'");
}

struct Found {
  const Attribute* attribute;
  AttributeText text;
};

Result<Found> find(const Document& document, std::uint32_t element, std::string_view name) {
  const Attribute* it = document.find_attribute(element, name);
  if (it == nullptr || name.empty()) {
    return problem(fmt::format("'{}' has no attribute '{}'",
                               brief(document.elements()[element].tag), brief(name)));
  }
  const auto text = attribute_text(document, *it);
  if (!text) return problem(kBroken);
  return Found{it, *text};
}

// Where its indentation shows that each attribute is in a line, a new one is too.
std::string separator_of(const Document& document, std::uint32_t element) {
  const auto attributes = document.attributes(element);
  const std::string_view text = document.source()->text();
  if (attributes.size() < 2 || attributes.back().name.empty()) return " ";
  const auto last = indentation(text, offset_of(document, attributes.back().place));
  return last ? std::string(line_end_of(text)).append(*last) : " ";
}

}  // namespace

Result<TextEdit> set_attribute(const Document& document, std::uint32_t element,
                               std::string_view name, std::string_view value) {
  const std::string_view text = document.source()->text();
  TextEdit edit;
  if (document.find_attribute(element, name) == nullptr) {
    if (!is_xml_name(name)) return no_name(name);
    const auto tag = tag_text(document, element);
    if (!tag) return problem(kBroken);
    edit.insert(tag->inside_end,
                fmt::format("{}{}={}", separator_of(document, element), name, quoted(value)));
    return edit;
  }
  const auto found = find(document, element, name);
  if (!found) return tl::unexpected(found.error());
  const AttributeText& at = found->text;
  const std::string_view raw = text.substr(at.value_begin, at.value_end - at.value_begin);
  std::string changed = changed_value(raw, value, at.quote_in(text));
  if (changed != raw) edit.replace(at.value_begin, at.value_end, std::move(changed));
  return edit;
}

Result<TextEdit> rename_attribute(const Document& document, std::uint32_t element,
                                  std::string_view name, std::string_view new_name) {
  if (!is_xml_name(new_name)) return no_name(new_name);
  const auto found = find(document, element, name);
  if (!found) return tl::unexpected(found.error());
  if (name != new_name && document.find_attribute(element, new_name) != nullptr) {
    return problem(fmt::format("'{}' has an attribute '{}' already",
                               brief(document.elements()[element].tag), brief(new_name)));
  }
  TextEdit edit;
  edit.replace(found->text.begin, found->text.name_end, std::string(new_name));
  return edit;
}

}  // namespace lockstep::host
