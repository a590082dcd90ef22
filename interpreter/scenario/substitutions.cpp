#include "scenario/substitutions.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>

#include "base/core/wording.h"
#include "base/json/reader.h"
#include "language/document/document.h"
#include "language/document/file.h"

namespace lockstep::host {
namespace {

// A TestNodeConfig.
struct TestNode {
  std::string status = "SUCCESS";
  double delay_ms = 0;
  std::vector<std::string> scripts = {};
};

struct Rules {
  std::map<std::string, TestNode, std::less<>> nodes;
  std::vector<std::pair<std::string, std::string>> rules;  // a pattern, and what takes its place
};

TestNode read_node(JsonObject object) {
  TestNode node;
  object.each_field([&](std::string_view name, JsonValue value) {
    if (name == "return_status") {
      node.status = value.text();
    } else if (name == "async_delay") {
      node.delay_ms = value.number();
    } else if (name.ends_with("_script")) {
      std::string_view text;
      const bool is_text = value.get(text);
      if (!is_text) {
        value.skip();
      } else if (!text.empty()) {
        node.scripts.emplace_back(name);
      }
    } else {
      value.skip();
    }
  });
  return node;
}

Rules read_rules(std::string text) {
  Rules rules;
  JsonReader reader;
  reader.read(text, [&](JsonObject object) {
    object.each_field([&](std::string_view name, JsonValue value) {
      if (name == "TestNodeConfigs") {
        value.object().each_field([&](std::string_view id, JsonValue node) {
          rules.nodes[std::string(id)] = read_node(node.object());
        });
      } else if (name == "SubstitutionRules") {
        value.object().each_field([&](std::string_view pattern, JsonValue id) {
          rules.rules.emplace_back(pattern, id.text());
        });
      } else {
        value.skip();
      }
    });
  });
  return rules;
}

// The rule may mean a path, a name or an ID.
void add_rows(const std::string& pattern, const TestNode& node, Substitutions& into) {
  std::string status = node.status;
  std::ranges::transform(status, status.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  BindingRow row;
  row.restarts = row.has_result = row.may_lack = true;
  row.seconds = node.delay_ms / 1000;
  row.result = status == "failure"   ? Status::Failure
               : status == "skipped" ? Status::Skipped
               : status == "running" ? Status::Running
                                     : Status::Success;
  row.of = pattern;
  into.rows.push_back(row);
  row.of.clear();
  row.path = pattern;
  into.rows.push_back(row);
}

}  // namespace

Result<Substitutions> read_substitutions(const std::string& path) {
  auto text = read_file(path, Document::kMaxBytes);
  if (!text) return problem(fmt::format("'{}' cannot be read: {}", path, text.error().message));
  Rules rules;
  try {
    rules = read_rules(std::move(*text));
  } catch (const JsonError& error) {
    return problem(fmt::format("'{}' has no substitution rules: {}", path, error.what()));
  }
  Substitutions found;
  for (const auto& [pattern, id] : rules.rules) {
    const auto node = rules.nodes.find(id);
    if (node == rules.nodes.end()) {
      found.notes.push_back(fmt::format("'{}' is replaced by '{}', which is not a test node",
                                        brief(pattern), brief(id)));
      continue;
    }
    for (const std::string& script : node->second.scripts) {
      found.notes.push_back(fmt::format("'{}' of '{}' is left out", script, brief(id)));
    }
    add_rows(pattern, node->second, found);
  }
  return found;
}

}  // namespace lockstep::host
