// The files of a new project, plugin or tree, as texts: nothing is written here.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "author/scaffold/languages.h"

namespace lockstep::host {

struct NewFile {
  std::filesystem::path path;
  std::string text;
  bool is_executable = false;
};
using NewFiles = std::vector<NewFile>;

struct NewPlugin {
  std::string name;
  const SourceLanguage* language = nullptr;
  std::string leaf;  // "": Move and the name
};

struct NewTree {
  std::string name;
  bool is_btcpp = false;    // in the language of BehaviorTree.CPP
  std::string plugin = {};  // that it names; "": none. A program has its extension: "grip.py"
  std::filesystem::path folder = {};
};

// The ID of the leaf that a plugin begins with.
std::string first_leaf(const NewPlugin& plugin);

// A folder with the plugin, a tree and its scenarios, which is built on its own.
NewFiles plan_plugin(const NewPlugin& plugin, const std::filesystem::path& folder);
// The same in a project: the tree and its scenarios are in its folder of trees.
NewFiles plan_plugin_of_project(const NewPlugin& plugin, const std::filesystem::path& project);
// A project around such a plugin.
NewFiles plan_project(const NewPlugin& plugin, const std::filesystem::path& folder);
// A tree of built-in nodes, and its scenarios.
NewFiles plan_tree(const NewTree& tree);

}  // namespace lockstep::host
