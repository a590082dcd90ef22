// What a run assumes of its leaves: the leaf model of --watch-leaves, or that of the proof whose
// ticket is required.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cli/run/run_options.h"
#include "language/property/property.h"
#include "run/watched_leaves.h"

namespace lockstep::host {

class AssumedLeaves {
 public:
  // Reads the leaf model; the rate becomes that of it where none is given. False, with messages, if
  // it cannot be used.
  bool read(RunCommandOptions& options);
  // False, with messages, if the model is for another tree. `tree` must stay where it is.
  bool watch(const Tree& tree, std::span<const Property> properties);
  // Null: nothing is assumed.
  WatchedLeaves* watched() { return watched_ ? &*watched_ : nullptr; }

 private:
  bool is_given_ = false;
  std::vector<std::string> proved_properties_;  // what they compare is distinguished, too
  std::unique_ptr<LeafFile> file_;              // null: verify's assumptions of each leaf
  LeafModels models_;
  std::optional<WatchedLeaves> watched_;
};

}  // namespace lockstep::host
