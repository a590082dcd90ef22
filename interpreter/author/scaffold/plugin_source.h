// The source of a plugin, into which a node is inserted: no byte of what the author has written
// changes.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "author/scaffold/languages.h"
#include "author/scaffold/node_text.h"

namespace lockstep::host {

struct PluginSource {
  std::filesystem::path path;
  const SourceLanguage* language = nullptr;
  std::string text;
};

// The one source of a plugin below `where`, a folder, or `where` itself, a file.
Result<PluginSource> find_plugin_source(const std::filesystem::path& where);

// The text with the node in it. A Problem if the plugin has a node of this ID, or no list of nodes
// where one is expected.
Result<std::string> insert_node(const PluginSource& source, const NewNode& node);

}  // namespace lockstep::host
