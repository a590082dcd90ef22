// A finding as files: a recording like that of any run, and the script of its leaves, with which
// `run --leaves` makes the same recording.
#pragma once

#include <string>

#include "leaves/play/played_leaves.h"
#include "verify/trace.h"
#include "verify/verdict.h"

namespace lockstep::host {

struct CounterExample {
  std::string recording, leaves;  // their names
  LeafScripts scripts = {};       // what the second one has
  // What the run of the recording does otherwise than the search, which is a bug in lockstep.
  std::string contradiction = {};
};

struct CounterExampleOptions {
  std::string stem;  // of the names of both files
  std::string tree_file;
  double rate = 10;
  std::map<std::string, std::string, std::less<>> arguments = {}, values = {};
};

// Whether a run of the tree with these scripts ends by itself. `played` are its leaves.
bool ends(const Tree& tree, const LeafScripts& scripts, PlayedLeaves& played, double rate);

// `played` are the leaves of the tree. The recording is that of a run from its beginning, without
// the states of the search, and must show the finding: each tick of it is compared. Nothing, and
// why, if a file cannot be written.
Result<CounterExample> write_counter_example(const Tree& tree, const Finding& finding,
                                             Tracer& tracer, PlayedLeaves& played,
                                             std::span<const Property> properties,
                                             const CounterExampleOptions& options);

}  // namespace lockstep::host
