// Small changes of a tree file, each of which its scenarios should notice.
#pragma once

#include <string>
#include <vector>

namespace lockstep::host {

struct Mutation {
  std::string what;   // "Sequence 'open' is a Fallback"
  std::string place;  // "tree.xml:5:9"
  std::string text;   // the whole file, changed
};

// Those of the nodes in this file, in its order. Nothing if it is no tree file.
std::vector<Mutation> mutations_of(const std::string& path, const std::string& text);

}  // namespace lockstep::host
