// The plugins of open files, kept while their texts change. They live in other processes: whatever
// they do while they are loaded harms only those.
#pragma once

#include <list>
#include <string>

#include "run/loading/load.h"

namespace lockstep::host {

class PluginCache {
 public:
  // Loads what `project` asks for, or takes what was loaded before, if no file of it has changed.
  const LoadedPlugins& get(const Project* project, const LoadOptions& options);

 private:
  // Those of many files that are open at once.
  static constexpr std::size_t kMost = 16;
  struct Kept {
    std::string stamp;   // of the files
    std::string places;  // where the project asks for them
    LoadedPlugins plugins;
  };
  std::list<Kept> kept_;  // what was used last comes first
};

}  // namespace lockstep::host
