#include "definition/plugin_requests.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "core/pre_order.h"
#include "core/value.h"
#include "core/wording.h"
#include "document/reporter.h"

namespace lockstep {
namespace {

std::optional<PluginRequest> read_plugin(const Document& document, std::uint32_t index,
                                         const Reporter& report) {
  const Element& element = document.elements()[index];
  if (element.end > index + 1) {
    report.at(document.elements()[index + 1].place, "'plugin' cannot contain elements");
  }
  std::optional<PluginRequest> request;
  bool isolated = false;
  for (const auto& [name, value, place] : document.attributes(index)) {
    if (name == "name") {
      request = PluginRequest{std::string(value), place};
    } else if (name == "isolate") {
      const auto isolate = parse_value(ValueType::Bool, value);
      isolated = isolate == Value(true);
      if (isolate) continue;
      report.at_value(
          place, fmt::format("'{}' is not true or false, which 'isolate' must be", brief(value)));
    } else {
      report.at(place, fmt::format("'plugin' has no attribute '{}'", brief(name)),
                "attributes of 'plugin': name (a tree names plugins, never paths) and isolate");
    }
  }
  if (request) {
    request->isolate = isolated;
  } else {
    report.at(element.place, "'plugin' needs the attribute 'name'", "write <plugin name=\"…\"/>");
  }
  return request;
}

}  // namespace

std::vector<PluginRequest> requested_plugins(const Project& project, Diagnostics& diagnostics) {
  const Reporter report(project.sources, diagnostics);
  std::vector<PluginRequest> requests;
  for (const auto& document : project.documents) {
    const auto elements = document->elements();
    for (const std::uint32_t child : children_in(elements, 0)) {
      if (elements[child].tag != "plugin") continue;
      const auto request = read_plugin(*document, child, report);
      if (!request) continue;
      const auto known = std::ranges::find(requests, request->name, &PluginRequest::name);
      if (known == requests.end()) {
        if (requests.size() == kMaxPlugins) {
          report.at(elements[child].place, fmt::format("more than {} plugins", kMaxPlugins));
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
