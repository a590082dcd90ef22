#include "document/document.h"

#include <fmt/format.h>
#include <tinyxml2.h>

#include <cassert>
#include <deque>

#include "core/utf8.h"
#include "document/places.h"
#include "document/references.h"
#include "document/well_formed.h"

namespace lockstep {
namespace {

constexpr std::size_t kExcerptBytes = 200;
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

}  // namespace

struct Document::Implementation {
  std::string path;
  std::string text;
  tinyxml2::XMLDocument xml;
  std::vector<Element> elements;
  std::vector<Attribute> attributes;
  std::deque<std::string> replaced;  // the values of set_value; a deque never moves them
  std::optional<Lines> lines;
  std::optional<Places> places;

  SourceLocation at(std::size_t offset) {
    if (!lines) lines.emplace(text);
    const auto [line, column] = lines->locate(offset);
    return {path, line, column};
  }

  std::string excerpt(std::uint32_t line) {
    if (!lines) lines.emplace(text);
    return std::string(utf8_front(lines->line(line), kExcerptBytes));
  }

  void report(XmlFault fault, Diagnostics& diagnostics) {
    const auto location = at(fault.offset);
    diagnostics.error(location, std::move(fault.message), std::move(fault.hint),
                      excerpt(location.line));
  }

  const Places& located() {
    if (!places) places.emplace(text);
    assert(places->elements.size() == elements.size());
    assert(places->attributes.size() == attributes.size());
    return *places;
  }

  const Places::AttributePlace* find_place(std::uint32_t element, std::string_view name) {
    const auto& [tag, end, first, count] = elements[element];
    for (auto i = first; i < first + count; ++i)
      if (attributes[i].name == name) return &located().attributes[i];
    return nullptr;
  }

  bool check(Diagnostics& diagnostics);
  bool read(Diagnostics& diagnostics);
  void flatten();
  void append(const tinyxml2::XMLElement& element);
};

bool Document::Implementation::check(Diagnostics& diagnostics) {
  if (text.size() > kMaxBytes) {
    diagnostics.error({path}, fmt::format("the file is larger than {} MiB", kMaxBytes >> 20u));
    return false;
  }
  if (text.starts_with(kByteOrderMark)) text.erase(0, kByteOrderMark.size());
  if (auto fault = check_encoding(text)) {
    report(std::move(*fault), diagnostics);
    return false;
  }
  auto found = check_well_formed(text);
  for (auto& fault : found.faults) report(std::move(fault), diagnostics);
  elements.reserve(found.elements);
  attributes.reserve(found.attributes);
  return found.readable;
}

bool Document::Implementation::read(Diagnostics& diagnostics) {
  if (xml.Parse(text.data(), text.size()) == tinyxml2::XML_SUCCESS) return true;
  const auto line = static_cast<std::uint32_t>(xml.ErrorLineNum());
  diagnostics.error({path, line}, fmt::format("not XML that can be read ({})", xml.ErrorName()), {},
                    excerpt(line));
  return false;
}

void Document::Implementation::append(const tinyxml2::XMLElement& element) {
  const auto first = static_cast<std::uint32_t>(attributes.size());
  for (const auto* a = element.FirstAttribute(); a; a = a->Next())
    attributes.push_back({a->Name(), a->Value()});
  const auto count = static_cast<std::uint32_t>(attributes.size()) - first;
  elements.push_back({element.Name(), 0, first, count});
}

void Document::Implementation::flatten() {
  std::vector<std::uint32_t> open;
  const tinyxml2::XMLElement* element = xml.RootElement();
  while (element) {
    open.push_back(static_cast<std::uint32_t>(elements.size()));
    append(*element);
    const auto* next = element->FirstChildElement();
    while (element && !next) {
      elements[open.back()].end = static_cast<std::uint32_t>(elements.size());
      open.pop_back();
      next = element->NextSiblingElement();
      if (!next) element = element->Parent()->ToElement();
    }
    element = next;
  }
}

Document::Document() : it_(std::make_unique<Implementation>()) {}
Document::~Document() = default;

std::unique_ptr<Document> Document::parse(std::string path, std::string text,
                                          Diagnostics& diagnostics) {
  std::unique_ptr<Document> document(new Document);
  auto& it = *document->it_;
  it.path = std::move(path);
  it.text = std::move(text);
  if (!it.check(diagnostics) || !it.read(diagnostics)) return nullptr;
  it.flatten();
  return document;
}

const std::string& Document::path() const {
  return it_->path;
}
std::string_view Document::text() const {
  return it_->text;
}
std::span<const Element> Document::elements() const {
  return it_->elements;
}

std::span<const Attribute> Document::attributes(std::uint32_t element) const {
  const auto& e = it_->elements[element];
  return std::span<const Attribute>(it_->attributes).subspan(e.first_attribute, e.attribute_count);
}

const Attribute* Document::find_attribute(std::uint32_t element, std::string_view name) const {
  for (const auto& attribute : attributes(element))
    if (attribute.name == name) return &attribute;
  return nullptr;
}

void Document::set_value(const Attribute& attribute, std::string value) {
  const auto index = &attribute - it_->attributes.data();
  it_->attributes[static_cast<std::size_t>(index)].value =
      it_->replaced.emplace_back(std::move(value));
}

SourceLocation Document::locate(std::uint32_t element) const {
  return it_->at(it_->located().elements[element]);
}

SourceLocation Document::locate_attribute(std::uint32_t element, std::string_view name) const {
  const auto* place = it_->find_place(element, name);
  return place ? it_->at(place->name) : locate(element);
}

SourceLocation Document::locate_value(std::uint32_t element, std::string_view name,
                                      std::size_t offset) const {
  const auto* place = it_->find_place(element, name);
  if (!place) return locate(element);
  const auto begin = static_cast<std::size_t>(place->value.data() - it_->text.data());
  return it_->at(begin + raw_offset(place->value, offset));
}

std::string Document::excerpt(const SourceLocation& location) const {
  return it_->excerpt(location.line);
}

}  // namespace lockstep
