// The XML schema of leaf files, from the table that their reader uses.
#include <fmt/format.h>

#include "describe/words_xsd.h"
#include "describe/xsd.h"
#include "leaves/leaf_words.h"

namespace lockstep::host {
namespace {

using leaf_words::Tag;
using leaf_words::Word;

std::string element(const Tag& tag) {
  std::string text = fmt::format("        <xs:element name=\"{}\">\n    {}\n    <xs:complexType>\n",
                                 tag.name, xsd_documented(tag.doc));
  for (const Word& word : tag.words) text += xsd_attribute(word);
  // A leaf has attributes out.PORT. XSD cannot say how a name begins.
  if (tag.name == "leaf") {
    text += "      <xs:anyAttribute namespace=\"##local\" processContents=\"skip\"/>\n";
  }
  return text + "    </xs:complexType>\n  </xs:element>\n";
}

}  // namespace

std::string make_leaf_xsd() {
  std::string text = R"xsd(<?xml version="1.0" encoding="UTF-8"?>
<!-- What the leaves of a tree may do: NAME.leaves.xml. Made by `lockstep schema`, which has an option for it; do not edit. -->
<xs:schema xmlns:xs="http://www.w3.org/2001/XMLSchema" elementFormDefault="unqualified">
  <xs:element name="leaves">
    <xs:complexType>
      <xs:choice minOccurs="0" maxOccurs="unbounded">
)xsd";
  for (const Tag& tag : leaf_words::kTags) text += element(tag);
  text += "      </xs:choice>\n";
  for (const Word& word : leaf_words::kRoot) text += xsd_attribute(word);
  return text + "    </xs:complexType>\n  </xs:element>\n</xs:schema>\n";
}

}  // namespace lockstep::host
