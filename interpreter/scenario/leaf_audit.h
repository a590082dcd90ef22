// Where the leaves of a recording did what their leaf file does not allow: then what verify has
// proved does not hold for them.
#pragma once

#include <string>
#include <vector>

#include "leaves/models.h"
#include "record/read/recording_reader.h"

namespace lockstep::host {

struct LeafBreach {
  std::string path;
  std::uint64_t tick = 0;
  std::string message;  // "took 7 ticks, the leaf model says 2 to 5"
};

// Reads to the end; then check reader.error(). At most `most` of each leaf.
std::vector<LeafBreach> audit_leaves(RecordingReader& reader, const Tree& tree,
                                     const LeafModels& models, std::size_t most = 3);

}  // namespace lockstep::host
