#include "document/document.h"

#include <fmt/format.h>
#include <tinyxml2.h>

#include <deque>

#include "core/utf8.h"
#include "document/lines.h"
#include "document/references.h"
#include "document/well_formed.h"

namespace lockstep {
namespace {

constexpr std::size_t kExcerptBytes = 200;
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

// As written, between the quotes, of the attribute whose name ends at `offset`.
std::string_view value_after(std::string_view text, std::size_t offset) {
  const auto open = text.find_first_of("\"'", offset);
  return text.substr(open + 1, text.find(text[open], open + 1) - open - 1);
}

}  // namespace

struct Document::Implementation {
  std::string path;
  std::string text;
  std::vector<Element> elements;
  std::vector<Attribute> attributes;
  std::vector<std::uint32_t> coded;      // attributes whose values the reader has to read
  std::vector<std::string_view> unread;  // parts of the text that the reader must not see
  std::deque<std::string> values;        // those that are not as the text has them; never moved
  std::optional<Lines> lines;

  std::size_t offset_of(std::string_view part) const {
    return static_cast<std::size_t>(part.data() - text.data());
  }

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

  bool check(Diagnostics& diagnostics);
  bool read(Diagnostics& diagnostics);
  std::string without_unread() const;
  void read_values(const tinyxml2::XMLElement* root);
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
  auto written = check_well_formed(text);
  for (auto& fault : written.faults) report(std::move(fault), diagnostics);
  elements = std::move(written.elements);
  attributes = std::move(written.attributes);
  coded = std::move(written.coded);
  unread = std::move(written.unread);
  return written.readable;
}

// Blanks are where it was: they are not part of any value.
std::string Document::Implementation::without_unread() const {
  std::string blanked = text;
  for (const auto part : unread) blanked.replace(offset_of(part), part.size(), part.size(), ' ');
  return blanked;
}

// The reader's own document takes several times the memory of the elements: it is gone before
// anything is made from them.
bool Document::Implementation::read(Diagnostics& diagnostics) {
  tinyxml2::XMLDocument xml;
  const std::string blanked = unread.empty() ? std::string() : without_unread();
  const std::string& readable = unread.empty() ? text : blanked;
  if (xml.Parse(readable.data(), readable.size()) == tinyxml2::XML_SUCCESS) {
    read_values(xml.RootElement());
    return true;
  }
  const auto line = static_cast<std::uint32_t>(xml.ErrorLineNum());
  diagnostics.error({path, line}, fmt::format("not XML that can be read ({})", xml.ErrorName()), {},
                    excerpt(line));
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
                                          Diagnostics& diagnostics) {
  std::unique_ptr<Document> document(new Document);
  auto& it = *document->it_;
  it.path = std::move(path);
  it.text = std::move(text);
  if (!it.check(diagnostics) || !it.read(diagnostics)) return nullptr;
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
      it_->values.emplace_back(std::move(value));
}

SourceLocation Document::locate(std::uint32_t element) const {
  return it_->at(it_->offset_of(it_->elements[element].tag) - 1);
}

SourceLocation Document::locate_attribute(std::uint32_t element, std::string_view name) const {
  const auto* attribute = find_attribute(element, name);
  return attribute ? it_->at(it_->offset_of(attribute->name)) : locate(element);
}

SourceLocation Document::locate_value(std::uint32_t element, std::string_view name,
                                      std::size_t offset) const {
  const auto* attribute = find_attribute(element, name);
  if (!attribute) return locate(element);
  const auto raw = value_after(it_->text, it_->offset_of(attribute->name) + attribute->name.size());
  return it_->at(it_->offset_of(raw) + raw_offset(raw, offset));
}

std::string Document::excerpt(const SourceLocation& location) const {
  return it_->excerpt(location.line);
}

}  // namespace lockstep
