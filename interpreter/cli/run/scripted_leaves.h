// --leaves: what the leaves do is read from a file, and no plugin is asked. A script says it tick
// by tick; a leaf file says what they may do, and the seed of the run chooses.
#pragma once

#include <memory>
#include <optional>

#include "cli/run/run_options.h"
#include "leaves/play/played_leaves.h"

namespace lockstep::host {

class GivenLeaves {
 public:
  // Reads the file, and what it says of the run where the command line says nothing. False, with a
  // message, if it cannot be used.
  bool read(RunCommandOptions& options);
  // All leaves of the definition are played from now on.
  void take_over(Definition& definition) { played_.take_over(definition); }
  // False, with messages, if the file is for another tree.
  bool give(const RunCommandOptions& options, const Tree& tree);

 private:
  bool read_scripts(RunCommandOptions& options, std::string_view text);

  PlayedLeaves played_;
  LeafScripts scripts_;
  std::unique_ptr<LeafFile> file_;  // null: scripts
  LeafModels models_;
};

}  // namespace lockstep::host
