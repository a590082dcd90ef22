#include "remote/shared_memory/descriptor_message.h"

namespace lockstep {
namespace {

// Both are checked again, against the same limit, by read_descriptors.
constexpr std::uint32_t kMostDescriptors = 4096;

// Which functions a type of objects has that are called in the plugin's process.
constexpr std::uint8_t kHasFromText = 1, kHasBytes = 2;

void write_object_type(const ObjectType& type, MessageWriter& message) {
  message.put_text(type.name());
  message.put(static_cast<std::uint8_t>((type.has_from_text() ? kHasFromText : 0) |
                                        (type.has_bytes() ? kHasBytes : 0)));
}

void write_port(const lockstep_port& declared, const ObjectType* object, MessageWriter& message) {
  const lockstep_port port = covered_copy(&declared, declared.struct_size);
  message.put(port.type);
  message.put(port.direction);
  for (const char* text : {port.name, port.default_value, port.unit, port.doc, port.choices}) {
    message.put_text_or_null(text);
  }
  message.put(port.min);
  message.put(port.max);
  message.put(port.flags);
  if (object != nullptr) write_object_type(*object, message);
}

// Which of the optional functions there are, a bit for each.
std::uint8_t optional_functions(const lockstep_leaf_type& leaf) {
  return static_cast<std::uint8_t>(
      (leaf.start != nullptr ? 1 : 0) | (leaf.halt != nullptr ? 2 : 0) |
      (leaf.pause != nullptr ? 4 : 0) | (leaf.resume != nullptr ? 8 : 0) |
      (leaf.progress != nullptr ? 16 : 0) | (leaf.start_unreset != nullptr ? 32 : 0));
}

void keep_functions(lockstep_leaf_type& leaf, std::uint8_t present) {
  if ((present & 1) == 0) leaf.start = nullptr;
  if ((present & 2) == 0) leaf.halt = nullptr;
  if ((present & 4) == 0) leaf.pause = nullptr;
  if ((present & 8) == 0) leaf.resume = nullptr;
  if ((present & 16) == 0) leaf.progress = nullptr;
  if ((present & 32) == 0) leaf.start_unreset = nullptr;
}

}  // namespace

void write_descriptors(const Descriptors& descriptors, MessageWriter& message) {
  const lockstep_plugin& plugin = descriptors.plugin;
  for (const char* text : {plugin.name, plugin.version, plugin.doc}) {
    message.put_text_or_null(text);
  }
  message.put(plugin.leaf_type_count);
  for (const auto& leaf : descriptors.leaves) {
    message.put(leaf->type.kind);
    message.put(leaf->type.flags);
    message.put(optional_functions(leaf->type));
    message.put_text_or_null(leaf->type.id);
    message.put_text_or_null(leaf->type.doc);
    message.put(leaf->type.port_count);
    for (std::uint32_t port = 0; port < leaf->type.port_count; ++port) {
      write_port(*leaf->type.ports[port], leaf->parameters[port].object, message);
    }
  }
}

const char* OwnedDescriptors::read_text(MessageReader& message) {
  if (!message.has_text()) return nullptr;
  return texts_.emplace_back(message.text()).c_str();
}

const lockstep_object_type* OwnedDescriptors::read_object_type(MessageReader& message) {
  const std::string& name = texts_.emplace_back(message.text());
  const auto functions = message.get<std::uint8_t>();
  const bool has_from_text = (functions & kHasFromText) != 0;
  HostedObjectType& hosted = hosted_types_.emplace_back();
  hosted.struct_size = sizeof(lockstep_object_type);
  hosted.name = name.c_str();
  hosted.retain = hosted.release = HostedObjectType::mark;
  hosted.type = &object_types_.emplace_back(name, (functions & kHasBytes) != 0,
                                            has_from_text ? from_text_ : nullptr);
  return &hosted;
}

void OwnedDescriptors::read_port(MessageReader& message) {
  lockstep_port port{};
  port.struct_size = sizeof port;
  port.type = message.get<lockstep_type>();
  port.direction = message.get<lockstep_direction>();
  for (const char** text :
       {&port.name, &port.default_value, &port.unit, &port.doc, &port.choices}) {
    *text = read_text(message);
  }
  port.min = message.get<double>();
  port.max = message.get<double>();
  port.flags = message.get<std::uint64_t>();
  if (port.type == LOCKSTEP_OBJECT) port.object = read_object_type(message);
  port_lists_.back().push_back(&ports_.emplace_back(port));
}

bool OwnedDescriptors::read_leaf(MessageReader& message, const lockstep_leaf_type& functions) {
  lockstep_leaf_type leaf = functions;
  leaf.struct_size = sizeof leaf;
  leaf.kind = message.get<lockstep_leaf_kind>();
  leaf.flags = message.get<std::uint64_t>();
  keep_functions(leaf, message.get<std::uint8_t>());
  leaf.id = read_text(message);
  leaf.doc = read_text(message);
  leaf.port_count = message.get<std::uint32_t>();
  if (leaf.port_count > kMostDescriptors) return false;
  port_lists_.emplace_back();
  for (std::uint32_t port = 0; port < leaf.port_count && message.good(); ++port) {
    read_port(message);
  }
  leaf.ports = port_lists_.back().data();
  leaf_list_.push_back(&leaves_.emplace_back(leaf));
  return message.good();
}

bool OwnedDescriptors::read(MessageReader& message, const lockstep_plugin& plugin_functions,
                            const lockstep_leaf_type& leaf_functions,
                            RemoteObjectType::FromText from_text) {
  from_text_ = std::move(from_text);
  plugin = plugin_functions;
  plugin.abi_major = LOCKSTEP_ABI_MAJOR;
  plugin.abi_minor = LOCKSTEP_ABI_MINOR;
  plugin.struct_size = sizeof plugin;
  for (const char** text : {&plugin.name, &plugin.version, &plugin.doc}) {
    *text = read_text(message);
  }
  plugin.leaf_type_count = message.get<std::uint32_t>();
  if (plugin.leaf_type_count > kMostDescriptors) return false;
  for (std::uint32_t leaf = 0; leaf < plugin.leaf_type_count; ++leaf) {
    if (!read_leaf(message, leaf_functions)) return false;
  }
  plugin.leaf_types = leaf_list_.data();
  return message.good();
}

}  // namespace lockstep
