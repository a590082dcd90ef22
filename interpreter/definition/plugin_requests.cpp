#include "definition/plugin_requests.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "core/value.h"
#include "core/wording.h"
#include "document/reporter.h"

namespace lockstep {
namespace {

std::optional<PluginRequest> read_plugin(const Document& document, std::uint32_t element,
                                         Diagnostics& diagnostics) {
  const Reporter report(document, diagnostics);
  if (document.elements()[element].end > element + 1) {
    report.at_element(element + 1, "'plugin' takes no elements inside");
  }
  PluginRequest request{.name = {}, .document = &document, .element = element};
  for (const Attribute& attribute : document.attributes(element)) {
    if (attribute.name == "name") {
      request.name = attribute.value;
    } else if (attribute.name == "isolate") {
      const auto isolate = parse_value(ValueType::Bool, attribute.value);
      if (isolate) {
        request.isolate = std::get<bool>(*isolate);
      } else {
        report.at_value(element, "isolate",
                        fmt::format("'{}' is not true or false, which 'isolate' must be",
                                    brief(attribute.value)));
      }
    } else {
      report.at_attribute(
          element, attribute.name,
          fmt::format("'plugin' has no attribute '{}'", brief(attribute.name)),
          "attributes of 'plugin': name (a tree names plugins, never paths) and isolate");
    }
  }
  if (document.find_attribute(element, "name") != nullptr) return request;
  report.at_element(element, "'plugin' needs the attribute 'name'", "write <plugin name=\"…\"/>");
  return std::nullopt;
}

}  // namespace

std::vector<PluginRequest> requested_plugins(const Project& project, Diagnostics& diagnostics) {
  std::vector<PluginRequest> requests;
  for (const auto& document : project.documents) {
    const auto elements = document->elements();
    for (std::uint32_t child = 1; child < elements[0].end; child = elements[child].end) {
      if (elements[child].tag != "plugin") continue;
      const auto request = read_plugin(*document, child, diagnostics);
      if (!request) continue;
      const auto known = std::ranges::find(requests, request->name, &PluginRequest::name);
      if (known == requests.end()) {
        if (requests.size() == kMaxPlugins) {
          Reporter(*document, diagnostics)
              .at_element(child, fmt::format("more than {} plugins", kMaxPlugins));
          return requests;
        }
        requests.push_back(*request);
      } else {
        known->isolate |= request->isolate;
      }
    }
  }
  return requests;
}

}  // namespace lockstep
