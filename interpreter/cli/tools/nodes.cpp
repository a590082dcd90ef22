#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iterator>
#include <vector>

#include "base/core/language.h"
#include "base/core/suggest.h"
#include "cli/checks.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "cli/load/catalog_loading.h"
#include "cli/load/load_options.h"
#include "describe/node_reference.h"
#include "run/shape_of.h"

namespace lockstep::host {
namespace {

struct NodesOptions {
  PluginOptions plugins;
  std::string id;
  std::string format = "text";
};

// Editors have the built-in nodes of BehaviorTree.CPP.
std::string models(NodeTypes types) {
  std::vector<const NodeType*> unknown_there;
  for (const NodeType* type : types) {
    const bool is_extension =
        type->category == NodeCategory::Control && type->synchronization != Synchronization::None;
    if (is_extension || !type->plugin.empty()) unknown_there.push_back(type);
  }
  return nodes_as_models(unknown_there);
}

// A node with this name that another language has; null: none.
const NodeType* find_elsewhere(std::string_view id) {
  for (const LanguageRules* const rules : languages()) {
    const auto types = built_in_types(*rules);
    const auto it = std::ranges::find(types, id, &NodeType::id);
    if (it != types.end()) return *it;
  }
  return nullptr;
}

std::string as_text(const NodesOptions& options, NodeTypes types) {
  if (options.format == "json") return nodes_as_json(types);
  if (options.format == "btcpp") return models(types);
  std::vector<const NodeType*> of_plugins;
  if (options.id.empty() && !options.plugins.plugins.empty()) {  // the others are known
    std::ranges::copy_if(types, std::back_inserter(of_plugins),
                         [](const NodeType* type) { return !type->plugin.empty(); });
    types = of_plugins;
  }
  if (options.format == "markdown") return nodes_as_markdown(types);
  return options.id.empty() ? nodes_as_text(types) : node_as_text(*types.front());
}

int nodes(const NodesOptions& options) {
  PluginSet plugins;
  Catalog catalog;
  if (const int code = load_catalog(options.plugins, plugins, catalog); code != kExitSuccess) {
    return code;
  }
  if (options.id.empty()) return write_results(as_text(options, catalog.types()));
  const NodeType* type = catalog.find(options.id);
  if (type == nullptr) type = find_elsewhere(options.id);
  if (type == nullptr) {
    std::string hint = did_you_mean(options.id, catalog.ids());
    if (hint.empty())
      hint = "load the plugin that provides it with --plugin, as a file or by its name";
    print_error(fmt::format("unknown node '{}'", options.id), hint);
    return kExitUsage;
  }
  return write_results(as_text(options, {&type, 1}));
}

std::function<int()> define_nodes(CLI::App& app) {
  const auto options = std::make_shared<NodesOptions>();
  app.add_option("id", options->id, "Only this node")->type_name("ID");
  app.add_option("--format", options->format,
                 "text, json: an array of objects, markdown, or btcpp: a TreeNodesModel of the "
                 "nodes that editors for BehaviorTree.CPP do not know")
      ->check(one_of({"text", "json", "markdown", "btcpp"}))
      ->capture_default_str();
  add_plugin_options(app, options->plugins);
  add_program_option(app, options->plugins);
  return [options] { return nodes(*options); };
}

}  // namespace

extern const Command kNodesCommand{
    "nodes", "List the nodes that trees are made of, with their parameters or ports",
    "Exit code: 0 listed, 2 unknown node or usage, 4 plugin refused,\n"
    "6 a plugin crashed or hung.\n"
    "With --plugin, text and markdown have the leaves of these plugins only; json and btcpp have "
    "all. The list is of lockstep's own language; a node of BehaviorTree.CPP is shown by its "
    "name.\n"
    "\n"
    "Examples:\n"
    "  lockstep nodes\n"
    "  lockstep nodes ParallelAbsolute\n"
    "  lockstep nodes --plugin motion --format json",
    define_nodes};

}  // namespace lockstep::host
