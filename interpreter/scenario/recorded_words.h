// The deeds of each leaf in a recording, as words that it can do again.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "engine/tree.h"
#include "leaves/leaf_script.h"
#include "record/read/recording_reader.h"

namespace lockstep::host {

struct RecordedWords : LeafScripts {
  RecordingOutcome outcome;  // of reading it
  std::string result;        // of the run; "": it is cut
  std::string tree_file;     // as its user named it
  std::string tick;          // of the run: "" or kExactlyOnce
  std::map<std::string, std::string, std::less<>> arguments;
  // A change that came into an entry from outside: nobody in the tree writes it.
  struct Change {
    std::string key, value;
    std::uint64_t tick;
  };
  std::vector<Change> changes;
  bool lacks_ticks = false;  // what leaves did in them is guessed
  // How many fewer the scenario may take: on the wall clock, a Wait may take a tick more.
  std::uint64_t spare_ticks = 0;
  // A tick that took so long that deadlines were skipped.
  struct Late {
    std::uint64_t tick;
    Nanoseconds by;
  };
  std::vector<Late> late;
  std::vector<std::string> notes;  // what the words do not have of the run
};

// Words write to the ports of leaves in `tree`.
RecordedWords read_recorded_words(const std::string& path, const Tree& tree);

}  // namespace lockstep::host
