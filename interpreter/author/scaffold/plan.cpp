#include "author/scaffold/plan.h"

#include "author/scaffold/names.h"
#include "author/scaffold/render.h"

namespace lockstep::host {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLockstepRoot = "lockstep=\"1\"";
constexpr const char* kBtcppRoot = "BTCPP_format=\"4\"";

bool is(const NewPlugin& plugin, std::string_view language) {
  return plugin.language->name == language;
}

std::string source_name(const NewPlugin& plugin) {
  return plugin.name + std::string(plugin.language->extension);
}

Values plugin_values(const NewPlugin& plugin) {
  const std::string leaf = first_leaf(plugin), lower = as_lower_name(leaf);
  const bool is_program = is(plugin, "python"), is_rust = is(plugin, "rust");
  Values values;
  values.texts = {{"plugin", plugin.name},
                  {"leaf", leaf},
                  {"lower", lower},
                  {"UPPER", as_upper(lower)},
                  {"source", source_name(plugin)},
                  {"program", is_program ? source_name(plugin) : ""},
                  {"python", is_program ? "yes" : ""},
                  {"rust", is_rust ? "yes" : ""},
                  {"btcpp", is(plugin, "btcpp") ? "yes" : ""},
                  {"compiles", is_program || is_rust ? "" : "yes"},
                  {"root", is(plugin, "btcpp") ? kBtcppRoot : kLockstepRoot}};
  return values;
}

void add_source(const NewPlugin& plugin, const Values& values, const fs::path& folder,
                NewFiles& files) {
  const std::string name = "plugin/" + std::string(plugin.language->name);
  // In a project, the build writes what leaves a program has; a program alone needs no build.
  const bool is_alone = is(plugin, "python") && !values.texts.contains("project");
  if (!is_alone)
    files.push_back({folder / "CMakeLists.txt", render("plugin/CMakeLists.txt", values)});
  files.push_back({folder / source_name(plugin), render(name, values), is(plugin, "python")});
  if (is(plugin, "rust"))
    files.push_back({folder / "lockstep.rs", render("plugin/lockstep.rs", {})});
  if (is_alone) {  // after the program: an older file is out of date
    files.push_back(
        {folder / (plugin.name + ".leaves.json"), render(name + ".leaves.json", values)});
  }
}

// Names of ROS packages are in lower case.
NewFile colcon_package(const std::string& name, const fs::path& folder) {
  Values values;
  values.texts = {{"name", as_lower_name(name)}};
  return {folder / "package.xml", render("plugin/package.xml", values)};
}

// NAME.xml and NAME.test.xml.
void add_tree(Values values, const fs::path& folder, const std::string& name, NewFiles& files) {
  values.texts["tree"] = name + ".xml";
  files.push_back({folder / (name + ".xml"), render("tree/tree.xml", values)});
  files.push_back({folder / (name + ".test.xml"), render("tree/tree.test.xml", values)});
}

}  // namespace

std::string first_leaf(const NewPlugin& plugin) {
  return plugin.leaf.empty() ? "Move" + as_class_name(plugin.name) : plugin.leaf;
}

NewFiles plan_plugin(const NewPlugin& plugin, const fs::path& folder) {
  const Values values = plugin_values(plugin);
  NewFiles files;
  add_source(plugin, values, folder, files);
  add_tree(values, folder, "tree", files);
  files.push_back({folder / "README.md", render("plugin/README.md", values)});
  if (!is(plugin, "python")) files.push_back(colcon_package(plugin.name, folder));
  return files;
}

NewFiles plan_plugin_of_project(const NewPlugin& plugin, const fs::path& project) {
  Values values = plugin_values(plugin);
  values.texts["project"] = "yes";
  NewFiles files;
  add_source(plugin, values, project / "plugins" / plugin.name, files);
  add_tree(values, project / "trees", plugin.name, files);
  return files;
}

NewFiles plan_project(const NewPlugin& plugin, const fs::path& folder) {
  Values values = plugin_values(plugin);
  values.texts["project"] = plugin.name;
  NewFiles files{{folder / "CMakeLists.txt", render("project/CMakeLists.txt", values)}};
  for (NewFile& file : plan_plugin_of_project(plugin, folder)) files.push_back(std::move(file));
  files.push_back({folder / "README.md", render("project/README.md", values)});
  files.push_back(
      {folder / "lockstep.project.xml", render("project/lockstep.project.xml", values)});
  files.push_back(colcon_package(plugin.name, folder));
  files.push_back({folder / ".gitignore", render("project/gitignore", values)});
  files.push_back({folder / ".github/workflows/test.yml", render("project/test.yml", values)});
  return files;
}

NewFiles plan_tree(const NewTree& tree) {
  Values values;
  values.texts = {{"root", tree.is_btcpp ? kBtcppRoot : kLockstepRoot},
                  {"wait", tree.is_btcpp ? "Sleep" : "Wait"},
                  {"wait_time", tree.is_btcpp ? "msec" : "seconds"},
                  {"short", tree.is_btcpp ? "1000" : "1"},
                  {"long", tree.is_btcpp ? "2000" : "2"},
                  {"plugin", fs::path(tree.plugin).stem().string()},
                  {"program", fs::path(tree.plugin).has_extension() ? tree.plugin : ""}};
  NewFiles files;
  add_tree(values, tree.folder, tree.name, files);
  return files;
}

}  // namespace lockstep::host
