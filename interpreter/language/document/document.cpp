#include "language/document/document.h"

#include <fmt/format.h>
#include <tinyxml2.h>

#include <cstddef>
#include <deque>
#include <new>
#include <unordered_map>

#include "language/document/language_of.h"
#include "language/document/references.h"
#include "language/document/well_formed.h"

namespace lockstep::host {
namespace {

// An '&' that begins none is one of the value.
void append_with_known_references(std::string_view value, std::string& text) {
  for (auto at = value.find('&'); at != std::string_view::npos; at = value.find('&')) {
    text += value.substr(0, at + 1);
    value.remove_prefix(at);
    if (!read_reference(value)) text += "amp;";
    value.remove_prefix(1);
  }
  text += value;
}

std::string without_quotes(std::string_view value) {
  std::string text;
  for (const char c : value) {
    if (c == '"') {
      text += "&quot;";
    } else {
      text += c;
    }
  }
  return text;
}

// A program that links lockstep::runtime may have another version of tinyxml2 in it, whose
// functions are then called with this object: it has room for a document of any version, and
// functions of theirs that are in a header or virtual are not called.
class AnyTinyxml2 {
 public:
  AnyTinyxml2() : document_(new (room_) tinyxml2::XMLDocument) {}
  ~AnyTinyxml2() { document_->tinyxml2::XMLDocument::~XMLDocument(); }
  AnyTinyxml2(const AnyTinyxml2&) = delete;
  AnyTinyxml2& operator=(const AnyTinyxml2&) = delete;
  tinyxml2::XMLDocument* operator->() { return document_; }

 private:
  alignas(std::max_align_t) std::byte room_[8 * sizeof(tinyxml2::XMLDocument)];
  tinyxml2::XMLDocument* document_;
};

}  // namespace

struct Document::Implementation {
  std::shared_ptr<const Source> source;
  const LanguageRules* rules = &kLockstepRules;
  std::vector<Element> elements;
  std::vector<Attribute> attributes;
  std::vector<std::uint32_t> coded;  // attributes whose values have references or line ends
  std::deque<std::string> values;    // those that are not as the text has them; never moved

  void report(XmlFault fault, Diagnostics& diagnostics) const {
    const auto location = source->locate(source->place_of(fault.offset));
    diagnostics.add({fault.is_warning ? Severity::Warning : Severity::Error, location,
                     std::move(fault.message), std::move(fault.hint),
                     source->excerpt(location.line, location.column), "xml-syntax"_code});
  }

  bool check(Diagnostics& diagnostics);
  bool read_coded(Diagnostics& diagnostics);
};

bool Document::Implementation::check(Diagnostics& diagnostics) {
  const std::string_view text = source->text();
  if (text.size() > kMaxBytes) {
    diagnostics.error("too-large"_code, {source->path()},
                      fmt::format("the file is larger than {} MiB", kMaxBytes >> 20u));
    return false;
  }
  if (auto fault = check_encoding(text)) {
    report(std::move(*fault), diagnostics);
    return false;
  }
  rules = &language_of(text);
  auto written = check_well_formed(text, source->place_of(0),
                                   rules->lenient_xml ? Grammar::Lenient : Grammar::Strict);
  for (auto& fault : written.faults) report(std::move(fault), diagnostics);
  elements = std::move(written.elements);
  attributes = std::move(written.attributes);
  coded = std::move(written.coded);
  return written.readable;
}

// All of them at once, equal ones once, as the attributes of a text that is made for it.
bool Document::Implementation::read_coded(Diagnostics& diagnostics) {
  if (coded.empty()) return true;
  std::string text = "<r>";
  std::unordered_map<std::string_view, std::uint32_t> numbers;
  std::vector<std::uint32_t> number_of;  // of each in `coded`
  number_of.reserve(coded.size());
  for (const auto index : coded) {
    const std::string_view value = attributes[index].value;
    const auto [number, is_new] = numbers.try_emplace(value, numbers.size());
    number_of.push_back(number->second);
    if (!is_new) continue;
    const bool is_text = attributes[index].name.empty();  // which may have both quotes in it
    const char quote = is_text ? '"' : value.data()[-1];
    (text += "<a v=") += quote;
    append_with_known_references(is_text ? without_quotes(value) : value, text);
    (text += quote) += "/>";
  }
  text += "</r>";
  AnyTinyxml2 xml;
  if (xml->Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
    diagnostics.error("xml-syntax"_code, {source->path()}, "values that cannot be read");
    return false;
  }
  const auto* read = xml->FirstChildElement()->FirstChildElement();
  for (std::size_t i = 0; i < numbers.size(); ++i, read = read->NextSiblingElement()) {
    values.emplace_back(read->Attribute("v"));
  }
  for (std::size_t i = 0; i < coded.size(); ++i) {
    attributes[coded[i]].value = values[number_of[i]];
  }
  return true;
}

Document::Document() : it_(std::make_unique<Implementation>()) {}
Document::~Document() = default;

std::unique_ptr<Document> Document::parse(std::string path, std::string text,
                                          Diagnostics& diagnostics, Place first) {
  std::unique_ptr<Document> document(new Document);
  auto& it = *document->it_;
  it.source = std::make_shared<const Source>(std::move(path), std::move(text), first);
  if (!it.check(diagnostics) || !it.read_coded(diagnostics)) return nullptr;
  return document;
}

const std::shared_ptr<const Source>& Document::source() const {
  return it_->source;
}

const LanguageRules& Document::rules() const {
  return *it_->rules;
}

std::span<const Element> Document::elements() const {
  return it_->elements;
}

std::span<const Attribute> Document::attributes(std::uint32_t element) const {
  const auto& e = it_->elements[element];
  return std::span<const Attribute>(it_->attributes).subspan(e.first_attribute, e.attribute_count);
}

const Attribute* Document::find_attribute(std::uint32_t element, std::string_view name) const {
  return lockstep::host::find_attribute(attributes(element), name);
}

void Document::set_value(const Attribute& attribute, std::string value) {
  const auto index = &attribute - it_->attributes.data();
  it_->attributes[static_cast<std::size_t>(index)].value =
      it_->values.emplace_back(std::move(value));
}

}  // namespace lockstep::host
