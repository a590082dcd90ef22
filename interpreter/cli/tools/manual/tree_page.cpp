#include <fmt/format.h>

#include "cli/tools/manual/page.h"
#include "cli/tools/manual/pages.h"
#include "describe/node_reference.h"
#include "run/loading/plugins.h"

namespace lockstep::host {
namespace {

constexpr const char* kExample = R"(<root main_tree_to_execute="pull">
  <plugin name="motion"/>
  <BehaviorTree ID="pull">
    <ParallelAbsolute barriers="0.5">
      <MoveTimed name="arm" seconds="1"/>
      <MoveTimed name="base" seconds="2"/>
    </ParallelAbsolute>
  </BehaviorTree>
</root>)";

struct Part {
  const char* element;
  const char* about;
};
constexpr Part kParts[] = {
    {"root", "Holds everything. `main_tree_to_execute` names the tree that runs."},
    {"include",
     "Reads another file first: `path`, relative to this file. With `as=\"truck\"` its trees are "
     "`truck.ID`."},
    {"plugin", "Loads the leaves of a plugin: `name`, or `program` for a process plugin."},
    {"arg",
     "Declares a value that `--arg NAME=VALUE` gives: `name`, `default`. It is used as `${NAME}` "
     "in any attribute."},
    {"BehaviorTree", "A tree: its `ID`, and one node in it."},
    {"SubTree", "Runs another tree in this place: `ID`."},
};

void add_attributes(ManualPage& page, std::span<const CommonAttribute> attributes) {
  page.begin_list();
  for (const CommonAttribute& it : attributes) page.item(mdoc_word(it.name), it.doc);
  page.end_list();
}

void add_node(ManualPage& page, const NodeType& type) {
  page.item(mdoc_word(type.id), fmt::format("{} It has {}.", type.doc, children_text(type)));
  if (type.parameters.empty()) return;
  page.begin_list();
  for (const Parameter& it : type.parameters)
    page.item(mdoc_word(it.name), fmt::format("{} ({})", it.doc, facts_text(it)));
  page.end_list();
}

void add_nodes(ManualPage& page) {
  const PluginSet none;
  const Catalog catalog = make_catalog(none);
  for (const NodeGroup& group : node_groups()) {
    bool is_first = true;
    for (const NodeType* type : catalog.types()) {
      if (type->category != group.category) continue;
      if (is_first) page.subsection(group.heading);
      if (is_first) page.begin_list();
      is_first = false;
      add_node(page, *type);
    }
    if (!is_first) page.end_list();
  }
}

}  // namespace

ManualFile tree_page(std::string_view date) {
  ManualPage page("lockstep-tree", "5", date, "the files of behavior trees that lockstep runs");
  page.section("DESCRIPTION");
  page.text(
      "A tree file is XML. Elements below a BehaviorTree are nodes: control nodes and decorators, "
      "which are built in, and leaves, which come from plugins. A value in braces, as `{speed}`, "
      "is "
      "an entry of the blackboard.");
  page.paragraph();
  page.text("The elements that are not nodes:");
  page.begin_list();
  for (const Part& it : kParts) page.item(mdoc_word(it.element), it.about);
  page.end_list();
  page.subsection("Attributes of every node");
  add_attributes(page, common_attributes());
  add_attributes(page, script_attributes());
  page.subsection("Attributes of an action of a plugin");
  add_attributes(page, action_attributes());
  page.subsection("Attributes of a SubTree");
  add_attributes(page, subtree_attributes());
  add_nodes(page);
  page.section("EXAMPLES");
  page.literal(kExample);
  page.section("SEE ALSO");
  page.line(
      ".Xr lockstep 1 ,\n.Xr lockstep-check 1 ,\n.Xr lockstep-nodes 1 ,\n.Xr lockstep-run 1 ,\n"
      ".Xr lockstep-recording 5");
  return {"man5/lockstep-tree.5", page.roff()};
}

}  // namespace lockstep::host
