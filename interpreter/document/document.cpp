#include "document/document.h"

#include <fmt/format.h>
#include <tinyxml2.h>

#include <deque>

#include "document/well_formed.h"

namespace lockstep {
struct Document::Implementation {
  std::shared_ptr<const Source> source;
  std::vector<Element> elements;
  std::vector<Attribute> attributes;
  std::vector<std::uint32_t> coded;      // attributes whose values the reader has to read
  std::vector<std::string_view> unread;  // parts of the text that the reader must not see
  std::deque<std::string> values;        // those that are not as the text has them; never moved

  void report(XmlFault fault, Diagnostics& diagnostics) const {
    const auto location = source->locate(source->place_of(fault.offset));
    diagnostics.error(location, std::move(fault.message), std::move(fault.hint),
                      source->excerpt(location.line, location.column));
  }

  bool check(Diagnostics& diagnostics);
  bool read(Diagnostics& diagnostics);
  std::string without_unread() const;
  void read_values(const tinyxml2::XMLElement* root);
};

bool Document::Implementation::check(Diagnostics& diagnostics) {
  const std::string_view text = source->text();
  if (text.size() > kMaxBytes) {
    diagnostics.error({source->path()},
                      fmt::format("the file is larger than {} MiB", kMaxBytes >> 20u));
    return false;
  }
  if (auto fault = check_encoding(text)) {
    report(std::move(*fault), diagnostics);
    return false;
  }
  auto written = check_well_formed(text, source->place_of(0));
  for (auto& fault : written.faults) report(std::move(fault), diagnostics);
  elements = std::move(written.elements);
  attributes = std::move(written.attributes);
  coded = std::move(written.coded);
  unread = std::move(written.unread);
  return written.readable;
}

// Blanks are where it was: they are not part of any value.
std::string Document::Implementation::without_unread() const {
  const std::string_view text = source->text();
  std::string blanked(text);
  for (const auto part : unread) {
    const auto offset = static_cast<std::size_t>(part.data() - text.data());
    blanked.replace(offset, part.size(), part.size(), ' ');
  }
  return blanked;
}

// The reader's own document takes several times the memory of the elements: it is gone before
// anything is made from them.
bool Document::Implementation::read(Diagnostics& diagnostics) {
  tinyxml2::XMLDocument xml;
  const std::string blanked = unread.empty() ? std::string() : without_unread();
  const std::string_view readable = unread.empty() ? source->text() : blanked;
  if (xml.Parse(readable.data(), readable.size()) == tinyxml2::XML_SUCCESS) {
    read_values(xml.RootElement());
    return true;
  }
  const auto line = static_cast<std::uint32_t>(xml.ErrorLineNum());
  diagnostics.error({source->path(), line},
                    fmt::format("not XML that can be read ({})", xml.ErrorName()), {},
                    source->excerpt(line));
  return false;
}

const tinyxml2::XMLElement* next_in_pre_order(const tinyxml2::XMLElement* element) {
  if (const auto* child = element->FirstChildElement()) return child;
  while (element && !element->NextSiblingElement()) element = element->Parent()->ToElement();
  return element ? element->NextSiblingElement() : nullptr;
}

// References and line ends are the reader's; all other values are as they are written.
void Document::Implementation::read_values(const tinyxml2::XMLElement* root) {
  const auto* from = root;
  std::uint32_t element = 0;
  for (const auto attribute : coded) {
    for (; attribute >= elements[element].first_attribute + elements[element].attribute_count;
         ++element)
      from = next_in_pre_order(from);
    const auto* read = from->FirstAttribute();
    for (auto i = elements[element].first_attribute; i < attribute; ++i) read = read->Next();
    attributes[attribute].value = values.emplace_back(read->Value());
  }
}

Document::Document() : it_(std::make_unique<Implementation>()) {}
Document::~Document() = default;

std::unique_ptr<Document> Document::parse(std::string path, std::string text,
                                          Diagnostics& diagnostics, Place first) {
  std::unique_ptr<Document> document(new Document);
  auto& it = *document->it_;
  it.source = std::make_shared<const Source>(std::move(path), std::move(text), first);
  if (!it.check(diagnostics) || !it.read(diagnostics)) return nullptr;
  return document;
}

const std::shared_ptr<const Source>& Document::source() const {
  return it_->source;
}

std::span<const Element> Document::elements() const {
  return it_->elements;
}

std::span<const Attribute> Document::attributes(std::uint32_t element) const {
  const auto& e = it_->elements[element];
  return std::span<const Attribute>(it_->attributes).subspan(e.first_attribute, e.attribute_count);
}

const Attribute* Document::find_attribute(std::uint32_t element, std::string_view name) const {
  return lockstep::find_attribute(attributes(element), name);
}

void Document::set_value(const Attribute& attribute, std::string value) {
  const auto index = &attribute - it_->attributes.data();
  it_->attributes[static_cast<std::size_t>(index)].value =
      it_->values.emplace_back(std::move(value));
}

}  // namespace lockstep
