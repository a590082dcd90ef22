#include "describe/words_xsd.h"

#include <fmt/format.h>

#include "describe/xsd.h"

namespace lockstep::host {

std::string xsd_documented(std::string_view text) {
  return fmt::format("<xs:annotation><xs:documentation>{}</xs:documentation></xs:annotation>",
                     xsd_escaped(text));
}

// A regular expression of XSD has no anchors, and \. and \- mean what they mean here.
std::string xsd_attribute(const leaf_words::Word& word, std::string_view or_else) {
  std::string pattern(word.pattern);
  if (!pattern.empty() && !or_else.empty()) pattern.append("|").append(or_else);
  const std::string facet = pattern.empty()
                                ? std::string("<xs:minLength value=\"1\"/>")
                                : fmt::format("<xs:pattern value=\"{}\"/>", xsd_escaped(pattern));
  return fmt::format(
      "      <xs:attribute name=\"{}\"{}>\n        {}\n        <xs:simpleType><xs:restriction "
      "base=\"xs:string\">{}</xs:restriction></xs:simpleType>\n      </xs:attribute>\n",
      word.name, word.required ? " use=\"required\"" : "", xsd_documented(word.doc), facet);
}

}  // namespace lockstep::host
