#include "scenario/scenario_xsd.h"

#include <fmt/format.h>

#include "describe/words_xsd.h"
#include "scenario/scenario_words.h"

namespace lockstep::host {
namespace {

// A value may contain what a row gives: ${NAME}.
constexpr std::string_view kOfRow = R"(.*[$]\{.*)";

std::string xsd_element(const scenario_words::Tag& tag) {
  const bool has_text = tag.name == "expect";
  std::string text =
      fmt::format("  <xs:element name=\"{}\">\n    {}\n    <xs:complexType{}>\n", tag.name,
                  xsd_documented(tag.doc), has_text ? " mixed=\"true\"" : "");
  for (const auto& word : tag.words) text += xsd_attribute(word, kOfRow);
  // A leaf has out.PORT, and an expectation has in.PORT: XSD cannot say how a name begins.
  if (tag.name == "leaf" || tag.name == "expect") {
    text += "      <xs:anyAttribute namespace=\"##local\" processContents=\"skip\"/>\n";
  }
  return text + "    </xs:complexType>\n  </xs:element>\n";
}

std::string choice(std::string_view more) {
  std::string text = "      <xs:choice minOccurs=\"0\" maxOccurs=\"unbounded\">\n";
  for (const auto& tag : scenario_words::kTags) {
    text += fmt::format("        <xs:element ref=\"{}\"/>\n", tag.name);
  }
  return text + fmt::format("        <xs:element ref=\"{}\"/>\n      </xs:choice>\n", more);
}

}  // namespace

std::string make_scenario_xsd() {
  std::string text = R"xsd(<?xml version="1.0" encoding="UTF-8"?>
<!-- Scenarios of trees: NAME.test.xml. Made by `lockstep schema`, which has an option for it; do not edit. -->
<xs:schema xmlns:xs="http://www.w3.org/2001/XMLSchema" elementFormDefault="unqualified">
  <xs:element name="scenarios">
    <xs:complexType>
)xsd";
  text += choice("scenario");
  for (const auto& word : scenario_words::kScenarios) text += xsd_attribute(word);
  text += "    </xs:complexType>\n  </xs:element>\n  <xs:element name=\"scenario\">\n    " +
          xsd_documented("A tree, what its leaves do, and the expected results.") +
          "\n    <xs:complexType>\n";
  text += choice(scenario_words::kRow);
  for (const auto& word : scenario_words::kScenario) text += xsd_attribute(word, kOfRow);
  text += "    </xs:complexType>\n  </xs:element>\n";
  for (const auto& tag : scenario_words::kTags) text += xsd_element(tag);
  text += fmt::format(
      "  <xs:element name=\"{}\">\n    {}\n    <xs:complexType><xs:anyAttribute "
      "namespace=\"##local\" processContents=\"skip\"/></xs:complexType>\n  </xs:element>\n",
      scenario_words::kRow,
      xsd_documented("The scenario is played once for each row; ${name} stands for its value."));
  return text + "</xs:schema>\n";
}

}  // namespace lockstep::host
