// The descriptors of a plugin as a message. The leafhost that loaded the plugin writes it. The host
// reads it and checks its copy of the descriptors again.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "lockstep/leaf.h"
#include "plugin/contract/descriptor.h"
#include "plugin/contract/object_type.h"
#include "remote/shared_memory/message.h"
#include "remote/shared_memory/remote_object_type.h"

namespace lockstep {

void write_descriptors(const Descriptors& descriptors, MessageWriter& message);

// A plugin's tables with everything that they point to. Functions that the plugin has are taken
// from `functions`; the others are NULL.
struct OwnedDescriptors {
  lockstep_plugin plugin{};

  // Returns false if the message is invalid. `from_text` is what types of objects have that have
  // texts.
  bool read(MessageReader& message, const lockstep_plugin& plugin_functions,
            const lockstep_leaf_type& leaf_functions, RemoteObjectType::FromText from_text);

 private:
  const char* read_text(MessageReader& message);
  const lockstep_object_type* read_object_type(MessageReader& message);
  void read_port(MessageReader& message);
  bool read_leaf(MessageReader& message, const lockstep_leaf_type& functions);

  std::deque<std::string> texts_;  // elements do not move when one is added
  RemoteObjectType::FromText from_text_;
  std::deque<RemoteObjectType> object_types_;
  std::deque<HostedObjectType> hosted_types_;
  std::deque<lockstep_port> ports_;
  std::deque<std::vector<const lockstep_port*>> port_lists_;
  std::deque<lockstep_leaf_type> leaves_;
  std::vector<const lockstep_leaf_type*> leaf_list_;
};

}  // namespace lockstep
