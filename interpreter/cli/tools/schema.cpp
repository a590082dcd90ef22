#include <CLI/CLI.hpp>

#include "cli/command.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "cli/load/catalog_loading.h"
#include "cli/load/load_options.h"
#include "describe/xsd.h"
#include "scenario/scenario_xsd.h"

namespace lockstep::host {
namespace {

struct SchemaOptions {
  PluginOptions plugins;
  bool strict = false;
  bool leaves = false;
  bool tests = false;
};

int schema(const SchemaOptions& options) {
  if (options.leaves) return write_results(make_leaf_xsd());
  if (options.tests) return write_results(make_scenario_xsd());
  PluginSet plugins;
  Catalog catalog;
  const int code = load_catalog(options.plugins, plugins, catalog);
  if (code != kExitSuccess) return code;
  const auto unknown = options.strict ? UnknownNodes::Refused : UnknownNodes::Allowed;
  return write_results(make_xsd(catalog.types(), unknown));
}

std::function<int()> define_schema(CLI::App& app) {
  const auto options = std::make_shared<SchemaOptions>();
  app.add_flag("--strict", options->strict,
               "Reject unknown nodes; name every plugin of the trees with --plugin");
  app.add_flag("--leaves", options->leaves,
               "The schema of leaf models instead, which `lockstep verify --leaves` takes");
  app.add_flag("--tests", options->tests,
               "The schema of scenarios instead, which `lockstep test` plays");
  add_plugin_options(app, options->plugins);
  add_program_option(app, options->plugins);
  return [options] { return schema(*options); };
}

}  // namespace

extern const Command kSchemaCommand{
    "schema", "Print the XML schema (XSD 1.0) of the tree language, for editors and xmllint",
    "Leaves of plugins that are not loaded may have any attributes, so a mistyped tag is\n"
    "accepted as one of them, except with --strict.\n"
    "Exit code: 0 printed, 2 usage, 4 plugin refused, 6 a plugin crashed or hung.\n"
    "\n"
    "Examples:\n"
    "  lockstep schema > lockstep.xsd\n"
    "  lockstep schema --strict --plugin motion > lockstep-motion.xsd\n"
    "  xmllint --noout --schema lockstep.xsd tree.xml",
    define_schema};

}  // namespace lockstep::host
