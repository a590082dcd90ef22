#include "cli/tools/completion/value_words.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include "base/compression/decompressed.h"
#include "language/document/project.h"
#include "record/read/recording_reader.h"
#include "run/loading/plugin_directories.h"
#include "run/loading/plugins.h"
#include "tree/catalog.h"

namespace lockstep::host {
namespace {

void add_once(std::vector<std::string>& words, std::string_view word) {
  if (!word.empty() && std::ranges::find(words, word) == words.end()) words.emplace_back(word);
}

// These stand for a leaf in a tree, which the attribute ID names.
constexpr std::array<std::string_view, 2> kCompactForms{"Action", "Condition"};
// Elements that are no nodes.
constexpr std::array<std::string_view, 10> kFrame{"root",    "BehaviorTree",   "include", "arg",
                                                  "plugin",  "TreeNodesModel", "SubTree", "group",
                                                  "barrier", "property"};

void add_leaf(TreeWords& words, const Catalog& built_in, const Document& document,
              std::uint32_t element) {
  std::string_view id = document.elements()[element].tag;
  if (std::ranges::find(kFrame, id) != kFrame.end()) return;
  if (std::ranges::find(kCompactForms, id) != kCompactForms.end()) {
    const Attribute* named = document.find_attribute(element, "ID");
    id = named != nullptr ? named->value : std::string_view();
  }
  if (built_in.find(id) == nullptr) add_once(words.leaves, id);
}

void add_words(TreeWords& words, const Catalog& built_in, const Document& document) {
  const auto elements = document.elements();
  for (std::uint32_t i = 0; i < elements.size(); ++i) {
    const auto value_of = [&](std::string_view name) {
      const Attribute* attribute = document.find_attribute(i, name);
      return attribute != nullptr ? attribute->value : std::string_view();
    };
    if (elements[i].tag == "TreeNodesModel") {
      i = elements[i].end - 1;  // descriptions of nodes
      continue;
    }
    if (elements[i].tag == "BehaviorTree") add_once(words.trees, value_of("ID"));
    if (elements[i].tag == "arg") add_once(words.arguments, value_of("name"));
    for (const Attribute& attribute : document.attributes(i)) {
      const std::string_view value = attribute.value;
      if (value.size() > 2 && value.front() == '{' && value.back() == '}')
        add_once(words.keys, value.substr(1, value.size() - 2));
    }
    add_leaf(words, built_in, document, i);
  }
}

}  // namespace

TreeWords tree_words(const std::string& file) {
  TreeWords words;
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return words;
  Diagnostics diagnostics;
  const auto project = load_project(file, {}, diagnostics);
  if (project == nullptr) return words;
  const PluginSet none;
  const Catalog built_in = make_catalog(none, *project->rules);
  for (const auto& document : project->documents) add_words(words, built_in, *document);
  return words;
}

RecordingWords recording_words(const std::string& file) {
  RecordingWords words;
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return words;
  DecompressedFile text(file);
  if (!text.is_open()) return words;
  const RecordingReader reader(text.text(), file);
  for (const ShapeNode& node : reader.header().nodes) add_once(words.nodes, node.path);
  for (const ShapeEntry& entry : reader.header().entries) add_once(words.keys, entry.key);
  return words;
}

std::vector<std::string> plugin_names() {
  std::vector<std::string> names;
  for (const std::string& directory : plugin_directories({})) {
    std::error_code error;
    for (std::filesystem::directory_iterator it(directory, error), end; !error && it != end;
         it.increment(error)) {
      if (it->path().extension() == ".so") add_once(names, it->path().stem().string());
    }
  }
  std::ranges::sort(names);
  return names;
}

}  // namespace lockstep::host
