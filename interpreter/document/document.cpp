#include "document/document.h"

#include <fmt/format.h>

#include <deque>

#include "document/language_of.h"
#include "document/references.h"
#include "document/well_formed.h"

namespace lockstep {

struct Document::Implementation {
  std::shared_ptr<const Source> source;
  Language language = Language::Lockstep;
  std::vector<Element> elements;
  std::vector<Attribute> attributes;
  std::deque<std::string> values;  // those that are not as the text has them; never moved

  void report(XmlFault fault, Diagnostics& diagnostics) const {
    const auto location = source->locate(source->place_of(fault.offset));
    diagnostics.add({fault.is_warning ? Severity::Warning : Severity::Error, location,
                     std::move(fault.message), std::move(fault.hint),
                     source->excerpt(location.line, location.column)});
  }

  bool check(Diagnostics& diagnostics);
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
  language = language_of(text);
  auto written =
      check_well_formed(text, source->place_of(0),
                        language == Language::Lockstep ? Grammar::Strict : Grammar::Lenient);
  for (auto& fault : written.faults) report(std::move(fault), diagnostics);
  elements = std::move(written.elements);
  attributes = std::move(written.attributes);
  if (!written.readable) return false;
  for (const auto index : written.coded) {
    attributes[index].value = values.emplace_back(read_value(attributes[index].value));
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
  if (!it.check(diagnostics)) return nullptr;
  return document;
}

const std::shared_ptr<const Source>& Document::source() const {
  return it_->source;
}

Language Document::language() const {
  return it_->language;
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
