// The plugins of this process: opened, checked against the contract in lockstep/leaf.h, and listed
// as node types. Nothing of a plugin runs until initialize().
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/core/diagnostics.h"
#include "base/core/node_type.h"
#include "leaves/plugin/contract/plugin_clock.h"
#include "leaves/plugin/contract/words.h"
#include "leaves/remote/isolation_options.h"
#include "leaves/remote/json_lines/hold.h"
#include "lockstep/leaf.h"

namespace lockstep::host {

// Isolated: the plugin runs in a separate process. See
// leaves/remote/shared_memory/isolated_plugin.h.
enum class Isolation : bool { InProcess, Isolated };

class RemotePlugin;

class PluginSet {
 public:
  PluginSet();
  // Deinitializes what was initialized, in reverse order. The shared objects stay mapped: a thread
  // or an atexit handler that a plugin left behind must not lose its code (docs/plugins.md).
  ~PluginSet();
  PluginSet(const PluginSet&) = delete;
  PluginSet& operator=(const PluginSet&) = delete;

  // How plugins are isolated, for those loaded from now on. `leafhost` is the program
  // lockstep-leafhost. A plugin that takes longer than `hang_limit` to return from a call is
  // killed.
  void set_isolation(IsolationOptions options);

  // Opens a shared object, or a program whose name is that of the file. On failure, returns false
  // with one error, and the set is unchanged. Opening the same file again does nothing, isolated or
  // not: the first call decides. `where` is the place in a tree that asked for it, if any.
  bool load_file(const std::string& path, Diagnostics& diagnostics, SourceLocation where = {},
                 Isolation isolation = Isolation::InProcess);

  // Opens <name>.so from the first of `directories` that has it, unless a plugin of this name is
  // there already: one opened by its path takes the place of one found by its name.
  bool load_named(std::string_view name, std::span<const std::string> directories,
                  Diagnostics& diagnostics, SourceLocation where = {},
                  Isolation isolation = Isolation::InProcess);

  // Opens the program `file` from the first of `directories` that has it, as a plugin named `name`,
  // unless a plugin of this name is there already. See
  // leaves/remote/json_lines/program_plugin.h.
  struct Program {
    std::string name, file;
    Hold hold = Hold::AsItSays;
  };
  bool load_program(const Program& program, std::span<const std::string> directories,
                    Diagnostics& diagnostics, SourceLocation where = {});

  // A plugin that is linked in; for tests. `origin` stands for its path in messages. The plugin and
  // all that it points to must outlive the set.
  bool add(const lockstep_plugin& plugin, std::string origin, Diagnostics& diagnostics,
           SourceLocation where = {});

  // Calls the init of each plugin that is not initialized yet. On failure, returns false with one
  // error that names the plugin. A plugin has one state per process: what several sets share is
  // initialized by the first and deinitialized by the last of them.
  bool initialize(Diagnostics& diagnostics);

  // The leaves of all plugins; `origin` and `leaf` are in full size whatever the plugin's age.
  // Valid as long as the set.
  std::vector<const NodeType*> types() const;

  // The words of all plugins that scripts know as numbers; of two of one name, the first.
  PluginWords words() const;

  // The clock of that name that a plugin of this process has. Null: none has it.
  const lockstep_clock* clock(std::string_view name) const;

  // The facts about each plugin, in the order of loading.
  struct Info {
    std::string name, version, doc, path;
    bool isolated = false;
    std::string descriptions = {};  // of elements, by a program: RemotePlugin
  };
  std::vector<Info> list() const;

 private:
  struct Plugin;
  struct Request {
    std::string origin;
    std::string_view expected_name;  // "" = any
    SourceLocation where;
    Isolation isolation = Isolation::InProcess;
  };
  bool open(const Request& request, Diagnostics& diagnostics);
  bool open_isolated(const Request& request, Diagnostics& diagnostics);
  bool open_program(const Request& request, Hold hold, Diagnostics& diagnostics);
  bool has(std::string_view name) const;
  // Takes what cannot be isolated away from a plugin: a part of it in this process. Null: an error.
  static std::unique_ptr<Plugin> split_off(Plugin& isolated, const Request& request,
                                           Diagnostics& diagnostics);
  static Diagnostic isolated_in_part(const Plugin& plugin, const Request& request);
  bool accept(std::unique_ptr<RemotePlugin> remote, const Request& request,
              Diagnostics& diagnostics);
  bool accept(std::unique_ptr<Plugin> plugin, std::size_t size, const Request& request,
              Diagnostics& diagnostics);

  IsolationOptions isolation_;
  std::vector<std::unique_ptr<Plugin>> plugins_;
};

}  // namespace lockstep::host
