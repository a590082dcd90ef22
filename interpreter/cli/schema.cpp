#include <CLI/CLI.hpp>

#include "cli/catalog_loading.h"
#include "cli/command.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "definition/xsd.h"

namespace lockstep {
namespace {

int schema(const PluginOptions& options) {
  PluginSet plugins;
  Catalog catalog;
  if (const int code = load_catalog(options, plugins, catalog); code != kExitSuccess) return code;
  return write_results(make_xsd(catalog.types()));
}

std::function<int()> define_schema(CLI::App& app) {
  const auto options = std::make_shared<PluginOptions>();
  add_plugin_options(app, *options);
  return [options] { return schema(*options); };
}

}  // namespace

const Command kSchemaCommand{
    "schema", "Print the XML schema (XSD 1.0) of the tree language, for editors and xmllint",
    "Leaves of plugins that are not loaded may stand in trees with any attributes.\n"
    "Exit code: 0 printed, 2 usage, 4 plugin refused.\n"
    "\n"
    "Examples:\n"
    "  lockstep schema > lockstep.xsd\n"
    "  lockstep schema --plugin motion > lockstep-motion.xsd\n"
    "  xmllint --noout --schema lockstep.xsd trees/door_pulling.xml",
    define_schema};

}  // namespace lockstep
