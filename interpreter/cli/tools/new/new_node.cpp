#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>

#include "author/scaffold/names.h"
#include "author/scaffold/new_files.h"
#include "author/scaffold/plugin_source.h"
#include "base/system/replace_text.h"
#include "cli/checks.h"
#include "cli/console.h"
#include "cli/exit_code.h"
#include "cli/tools/new/new.h"

namespace lockstep::host {
namespace {

struct NodeOptions {
  std::string id;
  std::string kind;
  std::string doc;
  std::vector<std::string> ports;
  std::string where = ".";
  bool is_dry_run = false;
  bool prints = false;
};

NewNodeKind kind_named(const std::string& name) {
  for (const NewNodeKind kind : {NewNodeKind::Condition, NewNodeKind::Threaded,
                                 NewNodeKind::Control, NewNodeKind::Decorator}) {
    if (to_string(kind) == name) return kind;
  }
  return NewNodeKind::Action;
}

Result<NewNode> request_of(const NodeOptions& options) {
  NewNode node{kind_named(options.kind), options.id, options.doc, {}};
  for (const auto& checked : {check_node_id(options.id), check_not_built_in(options.id)}) {
    if (!checked) return tl::unexpected(checked.error());
  }
  for (const std::string& text : options.ports) {
    const auto port = parse_port(text);
    if (!port) return tl::unexpected(port.error());
    node.ports.push_back(*port);
  }
  return node;
}

// As a tree has it.
std::string tag_of(const NewNode& node) {
  std::string tag = '<' + node.id;
  for (const NewPort& port : node.ports) {
    const bool is_entry = port.direction != PortDirection::Input;
    const bool is_required = !port.default_text && port.direction != PortDirection::Output;
    if (is_entry || is_required)
      tag += fmt::format(" {}=\"{}\"", port.name, is_entry ? '{' + port.name + '}' : "…");
  }
  const bool has_children =
      node.kind == NewNodeKind::Control || node.kind == NewNodeKind::Decorator;
  return tag + (has_children ? ">…</" + node.id + '>' : "/>");
}

std::vector<std::string> next_steps(const PluginSource& source, const NewNode& node) {
  std::vector<std::string> next;
  const std::string path = source.path.string();
  const SourceLanguage& language = *source.language;
  if (!language.entry_place.empty()) {
    next.push_back(fmt::format("put this into {}, {},", path, language.definition_place));
    next.push_back(fmt::format("and its last line {}", language.entry_place));
  }
  const bool is_built = std::filesystem::exists(source.path.parent_path() / "CMakeLists.txt");
  next.push_back(is_python(language) && !is_built
                     ? fmt::format("{} plugin check --list --save ./{}", program_word(), path)
                     : "cmake --build build");
  next.push_back("and in a tree: " + tag_of(node));
  return next;
}

int print(const PluginSource& source, const NewNode& node, bool is_asked_for) {
  const auto text = is_asked_for ? node_text(*source.language, node) : text_for(source, node);
  if (!text) return refuse(text.error());
  const int code =
      write_results(text->definition + (text->entry.empty() ? "" : '\n' + text->entry + '\n'));
  if (code == kExitSuccess && !is_asked_for) print_next(next_steps(source, node));
  return code;
}

int insert(const NodeOptions& options, const NewNode& node, const PluginSource& source) {
  const auto text = insert_node(source, node);
  if (!text) return refuse(text.error());
  if (!options.is_dry_run) {
    if (const auto done = replace_text(source.path.string(), source.text, *text); !done)
      return refuse(done.error());
  }
  const int code = write_results(source.path.string() + '\n');
  if (code == kExitSuccess && !options.is_dry_run) print_next(next_steps(source, node));
  return code;
}

int new_node(const NodeOptions& options) {
  const auto node = request_of(options);
  if (!node) return refuse(node.error());
  const auto source = find_plugin_source(options.where);
  if (!source) return refuse(source.error());
  const bool is_inserted = source->language->entry_place.empty();
  if (options.prints || !is_inserted) return print(*source, *node, options.prints);
  return insert(options, *node, *source);
}

void add_options(CLI::App& app, NodeOptions& options, const std::vector<std::string>& kinds) {
  app.add_option("id", options.id, "Its ID: the tag in trees")->type_name("ID")->required();
  app.add_option("--kind", options.kind, "What it is")->check(one_of(kinds))->capture_default_str();
  app.add_option("--port", options.ports,
                 "A port: NAME:TYPE or NAME:TYPE=DEFAULT, with out: or inout: in front of an "
                 "output or an inout; "
                 "TYPE is bool, int, double, string, number, or 'list of' one of the first four; "
                 "may be repeated")
      ->type_name("PORT");
  app.add_option("--doc", options.doc,
                 "A sentence that describes the node (default: the words of its ID)")
      ->type_name("TEXT");
  app.add_option("--in", options.where,
                 "The source of the plugin, or a folder with one such source")
      ->type_name("FILE|DIR")
      ->capture_default_str();
  app.add_flag("--print", options.prints, "Print the source of the node, and change nothing");
  add_dry_run(app, options.is_dry_run);
}

NewPart define(CLI::App& app, const char* name, const char* summary,
               const std::vector<std::string>& kinds, const char* footer) {
  const auto options = std::make_shared<NodeOptions>();
  options->kind = kinds.front();
  CLI::App* command = app.add_subcommand(name, summary);
  add_options(*command, *options, kinds);
  command->footer(footer);
  return {command, [options] { return new_node(*options); }};
}

}  // namespace

NewPart define_new_leaf(CLI::App& app) {
  return define(
      app, "leaf", "A leaf for the source of a plugin", {"action", "condition", "threaded"},
      "A threaded action may block: it is done in a separate thread (C++ only).\n"
      "It is inserted into a source in C++ or Python: nothing that you wrote changes. For "
      "others\nit is printed, with where it goes.\n\n"
      "Example: lockstep new leaf OpenDoor --port goal:string --port out:angle:double");
}

NewPart define_new_node(CLI::App& app) {
  return define(app, "node", "A control node or a decorator for the source of a plugin",
                {"control", "decorator"},
                "Plugins in C++, C and for BehaviorTree.CPP have such nodes. In C++ it is inserted "
                "into the\nsource; for others it is printed, with where it goes.\n\n"
                "Example: lockstep new node TryAll --kind control --port times:int=3");
}

}  // namespace lockstep::host
