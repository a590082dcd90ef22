// The types of attributes. A value is what parse_value reads, within the parameter's range or
// choices; or it contains ${…}, which is not known before the tree is loaded; or it is a {key}.
#include <fmt/format.h>

#include <cmath>

#include "describe/xsd.h"

namespace lockstep::host {
namespace {

// XSD compares single numbers only. What can be said of a list with a pattern is the range from 0
// to 1, which is that of barriers.
std::string list_facets(const Range& range) {
  if (range.min != 0 || range.max != 1) return {};
  const std::string_view fraction =
      range.min_excluded ? R"(0*\.0*[1-9][0-9]*)" : R"(0*\.[0-9]+|0+\.?)";
  const std::string number =
      fmt::format(R"(\+?({}|0*1(\.0*)?|([0-9]+\.?[0-9]*|\.[0-9]+)[eE][+\-]?[0-9]+))", fraction);
  return fmt::format(R"(<xs:pattern value="[\s;,]*({0}([\s;,]+{0})*)?[\s;,]*"/>)", number);
}

std::string number_facets(const Range& range) {
  std::string facets;
  if (std::isfinite(range.min)) {
    facets +=
        fmt::format("<xs:min{}clusive value=\"{}\"/>", range.min_excluded ? "Ex" : "In", range.min);
  }
  if (std::isfinite(range.max)) {
    facets += fmt::format("<xs:maxInclusive value=\"{}\"/>", range.max);
  }
  return facets;
}

std::string facets(const Parameter& parameter) {
  std::string facets;
  for (const std::string_view choice : parameter.choices) {
    facets += fmt::format("<xs:enumeration value=\"{}\"/>", xsd_escaped(choice));
  }
  if (!facets.empty()) return facets;
  switch (parameter.type) {
    case ValueType::Number:
    case ValueType::Int:
    case ValueType::Double:
      return number_facets(parameter.range);
    case ValueType::DoubleList:
      return list_facets(parameter.range);
    default:
      return {};
  }
}

}  // namespace

std::string xsd_type(const Parameter& parameter) {
  if (parameter.is_script) {
    return "<xs:simpleType><xs:restriction base=\"word\"/></xs:simpleType>";
  }
  const bool has_text = parameter.object == nullptr || parameter.object->has_from_text();
  if (parameter.direction != Direction::Input || !has_text) {
    return "<xs:simpleType><xs:union memberTypes=\"substituted key\"/></xs:simpleType>";
  }
  const std::string_view others = parameter.constant ? "substituted" : "substituted key";
  const std::string_view base = schema_type(parameter.type).name;
  const std::string limits = facets(parameter);
  if (limits.empty()) {
    return fmt::format("<xs:simpleType><xs:union memberTypes=\"{} {}\"/></xs:simpleType>", base,
                       others);
  }
  return fmt::format(
      "<xs:simpleType><xs:union memberTypes=\"{}\"><xs:simpleType><xs:restriction base=\"{}\">{}"
      "</xs:restriction></xs:simpleType></xs:union></xs:simpleType>",
      others, base, limits);
}

std::string xsd_escaped(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    switch (c) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      default:
        safe += c;
    }
  }
  return safe;
}

}  // namespace lockstep::host
