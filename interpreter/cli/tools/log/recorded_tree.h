// The tree of a recording, loaded again with the arguments that it had. Its leaves are played: none
// of a plugin is asked.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "leaves/play/played_leaves.h"
#include "run/loading/load.h"

namespace lockstep::host {

struct RecordingHeader;

class RecordedTree {
 public:
  // `file`: the tree file; "": as the recording names it. The exit code is that of a failure, which
  // is reported. `look` sees what the tree is made of.
  RecordedTree(const RecordingHeader& header, const std::string& file, const PluginOptions& plugins,
               const std::function<void(const Loaded&)>& look = {});

  int code() const { return code_; }
  const std::string& file() const { return file_; }
  // The ID of the tree; "" if it is the one that the file names, or its only one.
  const std::string& main() const { return main_; }
  const Tree& tree() const { return runnable_.tree; }
  const std::vector<Property>& properties() const { return runnable_.properties; }

 private:
  std::string file_, main_;
  PlayedLeaves played_;
  Runnable runnable_;
  int code_;
};

}  // namespace lockstep::host
