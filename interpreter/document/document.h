// One XML file, parsed: elements in pre-order with their attributes, and the exact place of each in
// the original bytes. The only folder that sees tinyxml2. It knows XML, not trees.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/diagnostics.h"
#include "document/element.h"

namespace lockstep {

class Document {
 public:
  // A longer text is refused.
  static constexpr std::size_t kMaxBytes = std::size_t{64} << 20;

  // Null when the text is not XML that can be read; an error then says where and why. A fault that
  // leaves the elements readable (text in an element, an unknown '&x;') is an error too, but the
  // document is there. `path` is how messages name the file.
  static std::unique_ptr<Document> parse(std::string path, std::string text,
                                         Diagnostics& diagnostics);
  ~Document();

  const std::string& path() const;
  std::string_view text() const;  // without a byte order mark
  // Elements in pre-order; 0 is the root element.
  std::span<const Element> elements() const;
  std::span<const Attribute> attributes(std::uint32_t element) const;
  const Attribute* find_attribute(std::uint32_t element, std::string_view name) const;
  // Replaces an attribute's value; the document keeps the text.
  void set_value(const Attribute& attribute, std::string value);

  // Places; lines are counted when the first is asked for.
  // An element without such an attribute stands for it.
  SourceLocation locate(std::uint32_t element) const;                                   // its '<'
  SourceLocation locate_attribute(std::uint32_t element, std::string_view name) const;  // its name
  // Inside the quotes, at byte `offset` of the value as it was parsed (before set_value).
  SourceLocation locate_value(std::uint32_t element, std::string_view name,
                              std::size_t offset = 0) const;
  // The whole line that a location is on, without its newline; cut to 200 bytes.
  std::string excerpt(const SourceLocation& location) const;

 private:
  Document();
  struct Implementation;
  std::unique_ptr<Implementation> it_;
};

}  // namespace lockstep
