// The plugins of this process: opened, checked against the contract in lockstep/leaf.h, and listed
// as node types. Nothing of a plugin runs until initialize().
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnostics.h"
#include "core/node_type.h"
#include "lockstep/leaf.h"

namespace lockstep {

class PluginSet {
 public:
  PluginSet();
  // Deinitializes what was initialized, in reverse order. The shared objects stay mapped: a thread
  // or an atexit handler that a plugin left behind must not lose its code (docs/plugins.md).
  ~PluginSet();
  PluginSet(const PluginSet&) = delete;
  PluginSet& operator=(const PluginSet&) = delete;

  // Opens a shared object. On false, one error tells why; the set is as before. Opening the same
  // file again does nothing. `where` is the place in a tree that asked for it, if any.
  bool load_file(const std::string& path, Diagnostics& diagnostics, SourceLocation where = {});

  // Opens <name>.so from the first of `directories` that has it.
  bool load_named(std::string_view name, std::span<const std::string> directories,
                  Diagnostics& diagnostics, SourceLocation where = {});

  // A plugin that is linked in; for tests. `origin` stands for its path in messages.
  bool add(const lockstep_plugin& plugin, std::string origin, Diagnostics& diagnostics,
           SourceLocation where = {});

  // Calls each plugin's init once. On false, one error tells which refused.
  bool initialize(Diagnostics& diagnostics);

  // The leaves of all plugins. Valid as long as the set.
  std::vector<const NodeType*> types() const;

  // name, version, doc and path of each plugin, in the order of loading.
  struct Info {
    std::string name, version, doc, path;
  };
  std::vector<Info> list() const;

 private:
  struct Plugin;
  std::vector<std::unique_ptr<Plugin>> plugins_;
};

}  // namespace lockstep
