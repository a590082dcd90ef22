// The source of a node, in the language of its plugin.
#pragma once

#include <string>
#include <vector>

#include "author/scaffold/languages.h"
#include "author/scaffold/new_port.h"

namespace lockstep::host {

struct NewNode {
  NewNodeKind kind = NewNodeKind::Action;
  std::string id;
  std::string doc;  // "": the words of the ID
  std::vector<NewPort> ports;
};

struct NodeText {
  std::string definition;
  std::string entry;  // in the plugin's list of nodes; "" where there is none
};

// A Problem if the language has no such nodes or ports.
Result<NodeText> node_text(const SourceLanguage& language, const NewNode& node);

}  // namespace lockstep::host
