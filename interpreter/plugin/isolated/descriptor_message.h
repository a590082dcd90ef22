// The descriptors of a plugin as a message: written by the leafhost that has it loaded, read by the
// host, which gets descriptors of its own that are checked once more.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "lockstep/leaf.h"
#include "plugin/descriptor.h"
#include "plugin/isolated/message.h"

namespace lockstep {

void write_descriptors(const Descriptors& descriptors, MessageWriter& message);

// A plugin's tables with all that they point to. Functions that the plugin has are those of
// `functions`; the others are NULL.
struct OwnedDescriptors {
  lockstep_plugin plugin{};

  // False: the message makes no sense.
  bool read(MessageReader& message, const lockstep_plugin& plugin_functions,
            const lockstep_leaf_type& leaf_functions);

 private:
  const char* read_text(MessageReader& message);
  void read_port(MessageReader& message);
  bool read_leaf(MessageReader& message, const lockstep_leaf_type& functions);

  std::deque<std::string> texts_;  // none of these moves when another comes
  std::deque<lockstep_port> ports_;
  std::deque<std::vector<const lockstep_port*>> port_lists_;
  std::deque<lockstep_leaf_type> leaves_;
  std::vector<const lockstep_leaf_type*> leaf_list_;
};

}  // namespace lockstep
