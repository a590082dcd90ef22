// The words that a value could be, read from the tree file or the recording that the line names.
#pragma once

#include <string>
#include <vector>

namespace lockstep::host {

// In the order of the file, each once. What cannot be read has none.
struct TreeWords {
  std::vector<std::string> trees;      // IDs of BehaviorTrees
  std::vector<std::string> arguments;  // names of <arg>
  std::vector<std::string> keys;       // of the blackboard
  std::vector<std::string> leaves;     // IDs of nodes that are not built in
};
TreeWords tree_words(const std::string& file);

struct RecordingWords {
  std::vector<std::string> nodes;  // paths
  std::vector<std::string> keys;
};
RecordingWords recording_words(const std::string& file);

// The plugins that are installed, or in LOCKSTEP_PLUGIN_PATH.
std::vector<std::string> plugin_names();

}  // namespace lockstep::host
