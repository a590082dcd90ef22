#include "tree/check/plugin_requests.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "base/core/audience.h"
#include "base/core/pre_order.h"
#include "base/core/value.h"
#include "base/core/wording.h"
#include "language/document/reporter.h"

namespace lockstep::host {
namespace {

constexpr std::string_view kHolds[] = {"signal", "message", "none"};

// A tree names files, never paths: they are searched.
bool is_file_name(std::string_view name) {
  return !name.empty() && name.front() != '.' && name.find('/') == name.npos;
}

void check_same(const PluginRequest& known, const PluginRequest& request, const Reporter& report) {
  if (known.program == request.program && known.hold == request.hold) return;
  report.at_value("plugin-conflict"_code, request.place,
                  fmt::format("plugin '{}' is a different one elsewhere", brief(request.name)),
                  "give all elements of a plugin the same program and hold");
}

class RequestReader {
 public:
  RequestReader(const Document& document, std::uint32_t index, const Reporter& report)
      : document_(document), index_(index), report_(report) {}

  std::optional<PluginRequest> read() {
    const Element& element = document_.elements()[index_];
    if (element.end > index_ + 1) {
      report_.at("unexpected-element"_code, document_.elements()[index_ + 1].place,
                 "'plugin' cannot contain elements");
    }
    for (const auto& attribute : document_.attributes(index_)) {
      read_attribute(attribute.name, attribute.value, attribute.place);
    }
    if (!request_.hold.empty() && request_.program.empty()) {
      report_.at(
          "bad-attributes"_code, element.place, "'hold' is for programs",
          "name the program: program=\"…\"; leaves of a shared object have a pause function");
    }
    if (!is_valid_) return std::nullopt;
    if (has_name_) return request_;
    report_.at("missing-attribute"_code, element.place, "'plugin' needs the attribute 'name'",
               "write <plugin name=\"…\"/>");
    return std::nullopt;
  }

 private:
  void read_attribute(std::string_view name, std::string_view value, Place place) {
    if (name == "name") {
      has_name_ = true;
      request_.name = value;
      request_.place = place;
    } else if (name == "isolate") {
      read_isolate(value, place);
    } else if (name == "program") {
      read_program(value, place);
    } else if (name == "hold") {
      read_hold(value, place);
    } else {
      report_.at("unknown-attribute"_code, place,
                 fmt::format("'plugin' has no attribute '{}'", brief(name)),
                 "attributes of 'plugin': name (a tree names plugins, never paths), isolate, "
                 "program and hold");
    }
  }

  void read_isolate(std::string_view value, Place place) {
    const auto isolate = parse_value(ValueType::Bool, value);
    request_.isolate = isolate == Value(true);
    if (isolate) return;
    report_.at_value(
        "bad-value"_code, place,
        fmt::format("'{}' is not true or false, which 'isolate' must be", brief(value)));
  }

  void read_program(std::string_view value, Place place) {
    request_.program = value;
    is_valid_ = is_file_name(value);
    if (is_valid_) return;
    report_.at_value("bad-value"_code, place,
                     fmt::format("'{}' is not the name of a file", brief(value)),
                     fmt::format("a program is searched where plugins are{}: a tree never names a "
                                 "path",
                                 worded(" (--plugin-path)", "")));
  }

  void read_hold(std::string_view value, Place place) {
    request_.hold = value;
    if (std::ranges::find(kHolds, value) != std::end(kHolds)) return;
    report_.at_value("bad-value"_code, place,
                     fmt::format("'{}' is not a way to hold a process plugin", brief(value)),
                     "signal (its process is stopped), message or none");
  }

  const Document& document_;
  const std::uint32_t index_;
  const Reporter& report_;
  PluginRequest request_;
  bool has_name_ = false;
  bool is_valid_ = true;
};

}  // namespace

std::vector<PluginRequest> requested_plugins(const Project& project, Diagnostics& diagnostics) {
  const Reporter report(project.sources, diagnostics);
  std::vector<PluginRequest> requests;
  for (const auto& document : project.documents) {
    const auto elements = document->elements();
    for (const std::uint32_t child : children_in(elements, 0)) {
      if (elements[child].tag != "plugin") continue;
      const auto request = RequestReader(*document, child, report).read();
      if (!request) continue;
      const auto known = std::ranges::find(requests, request->name, &PluginRequest::name);
      if (known == requests.end()) {
        if (requests.size() == kMaxPlugins) {
          report.at("too-large"_code, elements[child].place,
                    fmt::format("more than {} plugins", kMaxPlugins));
          return requests;
        }
        requests.push_back(*request);
      } else {
        known->isolate |= request->isolate;
        check_same(*known, *request, report);
      }
    }
  }
  return requests;
}

}  // namespace lockstep::host
