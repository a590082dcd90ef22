// The descriptors of a plugin as a message. The leafhost that loaded the plugin writes it. The host
// reads it and checks its copy of the descriptors again.
#pragma once

#include <deque>

#include "plugin/contract/descriptor.h"
#include "plugin/contract/object_type.h"
#include "remote/owned_descriptors.h"
#include "remote/shared_memory/message.h"
#include "remote/shared_memory/remote_object_type.h"

namespace lockstep {

void write_descriptors(const Descriptors& descriptors, MessageWriter& message);

class ReadDescriptors {
 public:
  // Returns false if the message is invalid. `from_text` is what types of objects have that have
  // texts.
  bool read(MessageReader& message, RemoteObjectType::FromText from_text);
  const lockstep_plugin& plugin() const { return tables_.plugin; }

 private:
  const char* text(MessageReader& message);
  const lockstep_object_type* read_object_type(MessageReader& message);
  void read_port(MessageReader& message);
  bool read_leaf(MessageReader& message);

  OwnedDescriptors tables_;
  RemoteObjectType::FromText from_text_;
  std::deque<RemoteObjectType> object_types_;  // elements do not move when one is added
  std::deque<HostedObjectType> hosted_types_;
};

}  // namespace lockstep
