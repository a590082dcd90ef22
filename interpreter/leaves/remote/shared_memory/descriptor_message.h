// The descriptors of a plugin as a message. The leafhost that loaded the plugin writes it. The host
// reads it and checks its copy of the descriptors again.
#pragma once

#include <deque>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "leaves/plugin/contract/descriptor.h"
#include "leaves/plugin/contract/object_type.h"
#include "leaves/plugin/contract/packed_object.h"
#include "leaves/plugin/contract/words.h"
#include "leaves/remote/owned_descriptors.h"
#include "leaves/remote/shared_memory/message.h"

namespace lockstep::host {

// The texts that an element gives to constant parameters. Those that are read are the message's.
void write_fixed(std::span<const FixedText> fixed, MessageWriter& message);
std::vector<FixedText> read_fixed(MessageReader& message);

void write_leaf(const lockstep_leaf_type& leaf, std::span<const Parameter> parameters,
                MessageWriter& message);
void write_descriptors(const Descriptors& descriptors, MessageWriter& message);

// A type of objects of an isolated plugin: here they are bytes, and texts are read there.
class RemoteObjectType final : public PackedType {
 public:
  using FromText = std::function<Result<Object>(const PackedType& type, std::string_view)>;

  // Without `from_text` it has none.
  RemoteObjectType(std::string name, bool has_bytes, FromText from_text)
      : PackedType(std::move(name)), has_bytes_(has_bytes), from_text_(std::move(from_text)) {}

  bool has_from_text() const override { return from_text_ != nullptr; }
  Result<Object> from_text(std::string_view text) const override { return from_text_(*this, text); }
  bool has_bytes() const override { return has_bytes_; }

 private:
  bool has_bytes_;
  FromText from_text_;
};

class ReadDescriptors {
 public:
  // Returns false if the message is invalid. `from_text` is what types of objects have that have
  // texts.
  bool read(MessageReader& message, RemoteObjectType::FromText from_text);
  // One leaf type alone; null if the message is invalid.
  const lockstep_leaf_type* read_one(MessageReader& message, RemoteObjectType::FromText from_text);
  const lockstep_plugin& plugin() const { return tables_.plugin; }
  const PluginWords& words() const { return words_; }

 private:
  const char* text(MessageReader& message);
  const lockstep_object_type* read_object_type(MessageReader& message);
  void read_port(MessageReader& message);
  bool read_leaf(MessageReader& message);
  bool read_words(MessageReader& message);

  OwnedDescriptors tables_;
  PluginWords words_;
  RemoteObjectType::FromText from_text_;
  std::deque<RemoteObjectType> object_types_;  // elements do not move when one is added
  std::deque<HostedObjectType> hosted_types_;
};

}  // namespace lockstep::host
