// The source of a plugin, into which a node goes: no byte of what the author has written changes.
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

// The text of a node for it. A Problem if it has a node of this ID.
Result<NodeText> text_for(const PluginSource& source, const NewNode& node);
// The whole source with the node in it, in C++ or Python. A Problem also where no list of nodes is
// found.
Result<std::string> insert_node(const PluginSource& source, const NewNode& node);

}  // namespace lockstep::host
