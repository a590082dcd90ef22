#include "dialect/btcpp/version_3.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/core/identifier.h"
#include "base/core/wording.h"
#include "dialect/btcpp/words.h"

namespace lockstep::host::btcpp {
namespace {

constexpr Renamed kNodes[] = {{"SequenceStar", "SequenceWithMemory"},
                              {"FallbackStar", "Fallback"},
                              {"RetryUntilSuccesful", "RetryUntilSuccessful"},
                              {"SubTreePlus", "SubTree"}};

constexpr std::string_view kSharedBlackboard = "__shared_blackboard";

constexpr Renamed kParallelPorts[] = {{"success_threshold", "success_count"},
                                      {"threshold", "success_count"},
                                      {"failure_threshold", "failure_count"}};

}  // namespace

std::string_view attribute_since_4(const NodeType& type, std::string_view name) {
  const bool is_built_in = type.leaf == nullptr && type.mock == nullptr;
  if (is_built_in && type.category == NodeCategory::SubTree && name == kSharedBlackboard) {
    return "_autoremap";
  }
  if (is_built_in && type.category == NodeCategory::SubTree && name == "__autoremap") {
    return "_autoremap";
  }
  if (!is_built_in || type.id != "Parallel") return name;
  const auto* const found = std::ranges::find(kParallelPorts, name, &Renamed::before);
  return found == std::end(kParallelPorts) ? name : found->since;
}

namespace {

// An attribute of a SubTree whose value named an entry outside, or was a text.
void check_outer(const Attribute& attribute, const Reporter& report) {
  if (!is_port_name(attribute.name) || attribute.name == "name" || attribute.name == "ID") return;
  if (attribute.value.empty() || !key_of(attribute.value, attribute.name).empty()) return;
  if (report.counted_only(Severity::Warning)) return;
  report.at_value("old-syntax"_code, attribute.place,
                  fmt::format("'{}' is a text here; before version 4 it could be an entry",
                              brief(attribute.value)),
                  fmt::format("for the entry write {}=\"{{{}}}\"", brief(attribute.name),
                              brief(attribute.value)),
                  Severity::Warning);
}

// "${key}" named an entry before version 3. With an <arg>, it has been replaced.
void check_dollar(Attribute& attribute, const Reporter& report) {
  const auto value = without_blanks_around(attribute.value);
  if (!value.starts_with("${") || !value.ends_with('}') || value.size() < 4) return;
  if (!is_port_name(attribute.name) || attribute.name == "name" || attribute.name == "ID") return;
  attribute.value = value.substr(1);  // as if it were written so
  if (report.counted_only(Severity::Error)) return;
  const auto key = value.substr(2, value.size() - 3);
  report.at_value("old-syntax"_code, attribute.place,
                  fmt::format("'{}' is not an entry", brief(value)),
                  fmt::format("since version 3 it is written {}=\"{{{}}}\"", brief(attribute.name),
                              brief(key)));
}

}  // namespace

std::span<const Renamed> renamed_nodes() {
  return kNodes;
}

std::string_view node_since_4(std::string_view id) {
  const auto* const found = std::ranges::find(kNodes, id, &Renamed::before);
  return found == std::end(kNodes) ? std::string_view() : found->since;
}

std::vector<Attribute> attributes_since_4(std::string_view tag,
                                          std::span<const Attribute> attributes,
                                          const NodeType& type, const Reporter& report) {
  std::vector<Attribute> since(attributes.begin(), attributes.end());
  // In a SubTreePlus a text was a text, as it is now.
  const bool is_subtree = type.category == NodeCategory::SubTree && tag != "SubTreePlus";
  for (Attribute& attribute : since) {
    const std::string_view before = attribute.name;
    attribute.name = attribute_since_4(type, before);
    if (before == kSharedBlackboard && attribute.name != before) {
      report.at("old-syntax"_code, attribute.place, "'__shared_blackboard' is read as '_autoremap'",
                "the difference: keys that begin with '_' are not shared", Severity::Note);
    }
    if (is_subtree) check_outer(attribute, report);
    check_dollar(attribute, report);
  }
  return since;
}

std::string_view hint_for_gone(std::string_view id) {
  const bool checks = id == "BlackboardCheckInt" || id == "BlackboardCheckDouble" ||
                      id == "BlackboardCheckBool" || id == "BlackboardCheckString";
  return checks ? "write _skipIf=\"…\" at its child, or a <Precondition if=\"…\">"
                : std::string_view();
}

bool is_old_name(std::string_view id) {
  return !node_since_4(id).empty() || !hint_for_gone(id).empty();
}

std::vector<std::string_view> old_names(const Document& document) {
  const Attribute* format = document.find_attribute(0, "BTCPP_format");
  std::vector<std::string_view> names;
  if (format != nullptr && format->value == "4") return names;
  for (const Renamed& it : kNodes) names.push_back(it.before);
  return names;
}

}  // namespace lockstep::host::btcpp
