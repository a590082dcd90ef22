// Ensures that a command does not overwrite a file that it reads, even under another name: a link,
// another path.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "run/loading/load.h"
#include "run/loading/plugin_set.h"

namespace lockstep::host {

struct NamedFile {
  std::string name;  // as the user knows it
  std::string path;
};

// A file that the command line names; - is stdin.
NamedFile named_file(const std::string& path);
// The files that were read to load a tree: these documents and its plugins.
std::vector<NamedFile> inputs_of(std::span<const std::string> documents, const PluginSet& plugins);
// The same of a tree that was loaded, with others that the command line names; "": none.
std::vector<NamedFile> inputs_of(const Loaded& loaded, std::vector<std::string> others);
// The two that a command writes to anyway.
std::vector<NamedFile> standard_outputs();

// Returns true, and reports it, if `output`, the value of `option`, is one of `used`, or a project
// file. A device cannot be overwritten.
bool would_overwrite(std::string_view option, const std::string& output,
                     std::span<const NamedFile> used);

}  // namespace lockstep::host
