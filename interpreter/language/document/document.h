// One XML file, parsed: elements in pre-order with their attributes, each with its exact place in
// the original bytes. The only folder that sees tinyxml2, which reads values with references. It
// knows XML, not trees.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "base/core/diagnostics.h"
#include "base/core/language.h"
#include "language/document/element.h"
#include "language/document/sources.h"

namespace lockstep::host {

class Document {
 public:
  // A longer text is refused.
  static constexpr std::size_t kMaxBytes = std::size_t{64} << 20;

  // Returns null, with an error, if the text is not readable XML. A mistake that leaves the
  // elements readable (text in an element, an unknown '&x;') is an error too, but returns the
  // document. In a text for BehaviorTree.CPP, what its reader accepts is no error. Messages call
  // the file `path`; `first` is the place of its first byte.
  static std::unique_ptr<Document> parse(std::string path, std::string text,
                                         Diagnostics& diagnostics, Place first = {});
  ~Document();

  const std::shared_ptr<const Source>& source() const;
  const LanguageRules& rules() const;  // of the language that it is in
  // Elements in pre-order; 0 is the root element.
  std::span<const Element> elements() const;
  std::span<const Attribute> attributes(std::uint32_t element) const;
  const Attribute* find_attribute(std::uint32_t element, std::string_view name) const;
  // Replaces an attribute's value; the document keeps the text.
  void set_value(const Attribute& attribute, std::string value);

 private:
  Document();
  struct Implementation;
  std::unique_ptr<Implementation> it_;
};

}  // namespace lockstep::host
