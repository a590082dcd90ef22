#include "leaves/remote/shared_memory/descriptor_message.h"

namespace lockstep::host {
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
      (leaf.progress != nullptr ? 16 : 0) | (leaf.start_unreset != nullptr ? 32 : 0) |
      (leaf.set_pace != nullptr ? 64 : 0) | (leaf.restore != nullptr ? 128 : 0));
}

void keep_functions(lockstep_leaf_type& leaf, std::uint8_t present) {
  if ((present & 1) == 0) leaf.start = nullptr;
  if ((present & 2) == 0) leaf.halt = nullptr;
  if ((present & 4) == 0) leaf.pause = nullptr;
  if ((present & 8) == 0) leaf.resume = nullptr;
  if ((present & 16) == 0) leaf.progress = nullptr;
  if ((present & 32) == 0) leaf.start_unreset = nullptr;
  if ((present & 64) == 0) leaf.set_pace = nullptr;
  if ((present & 128) == 0) {
    leaf.save = nullptr;
    leaf.restore = nullptr;
  }
}

}  // namespace

void write_fixed(std::span<const FixedText> fixed, MessageWriter& message) {
  message.put(static_cast<std::uint32_t>(fixed.size()));
  for (const auto& [parameter, text] : fixed) {
    message.put_text(parameter);
    message.put_text(text);
  }
}

std::vector<FixedText> read_fixed(MessageReader& message) {
  std::vector<FixedText> fixed;
  const auto count = message.get<std::uint32_t>();
  for (std::uint32_t i = 0; i < count && message.good(); ++i) {
    const std::string_view parameter = message.text();
    fixed.push_back({parameter, message.text()});
  }
  return fixed;
}

void write_leaf(const lockstep_leaf_type& leaf, std::span<const Parameter> parameters,
                MessageWriter& message) {
  message.put(leaf.kind);
  message.put(leaf.flags);
  message.put(leaf.min_children);
  message.put(leaf.max_children);
  message.put(optional_functions(leaf));
  message.put_text_or_null(leaf.id);
  message.put_text_or_null(leaf.doc);
  message.put(leaf.port_count);
  for (std::uint32_t port = 0; port < leaf.port_count; ++port) {
    write_port(*leaf.ports[port], parameters[port].object, message);
  }
  message.put(leaf.behavior_count);
  for (std::uint32_t i = 0; i < leaf.behavior_count; ++i) {
    message.put_text(leaf.behavior[i].word);
    message.put_text(leaf.behavior[i].value);
  }
  message.put_text_or_null(leaf.more_ports);
}

void write_descriptors(const Descriptors& descriptors, MessageWriter& message) {
  const lockstep_plugin& plugin = descriptors.plugin;
  for (const char* text : {plugin.name, plugin.version, plugin.doc}) {
    message.put_text_or_null(text);
  }
  message.put(plugin.leaf_type_count);
  for (const auto& leaf : descriptors.leaves) write_leaf(leaf->type, leaf->parameters, message);
  const PluginWords words = words_of(plugin);
  message.put(static_cast<std::uint32_t>(words.size()));
  for (const auto& [word, number] : words) {
    message.put_text(word);
    message.put(number);
  }
}

const char* ReadDescriptors::text(MessageReader& message) {
  return message.has_text() ? tables_.keep(message.text()) : nullptr;
}

const lockstep_object_type* ReadDescriptors::read_object_type(MessageReader& message) {
  const char* const name = tables_.keep(message.text());
  const auto functions = message.get<std::uint8_t>();
  const bool has_from_text = (functions & kHasFromText) != 0;
  HostedObjectType& hosted = hosted_types_.emplace_back();
  hosted.struct_size = sizeof(lockstep_object_type);
  hosted.name = name;
  hosted.retain = hosted.release = HostedObjectType::mark;
  hosted.type = &object_types_.emplace_back(name, (functions & kHasBytes) != 0,
                                            has_from_text ? from_text_ : nullptr);
  return &hosted;
}

void ReadDescriptors::read_port(MessageReader& message) {
  lockstep_port& port = tables_.add_port();
  port.type = message.get<lockstep_type>();
  port.direction = message.get<lockstep_direction>();
  for (const char** it : {&port.name, &port.default_value, &port.unit, &port.doc, &port.choices}) {
    *it = text(message);
  }
  port.min = message.get<double>();
  port.max = message.get<double>();
  port.flags = message.get<std::uint64_t>();
  if (port.type == LOCKSTEP_OBJECT) port.object = read_object_type(message);
}

bool ReadDescriptors::read_leaf(MessageReader& message) {
  lockstep_leaf_type& leaf = tables_.add_leaf();
  leaf.kind = message.get<lockstep_leaf_kind>();
  leaf.flags = message.get<std::uint64_t>();
  leaf.min_children = message.get<std::uint32_t>();
  leaf.max_children = message.get<std::uint32_t>();
  keep_functions(leaf, message.get<std::uint8_t>());
  leaf.id = text(message);
  leaf.doc = text(message);
  const auto ports = message.get<std::uint32_t>();
  if (ports > kMostDescriptors) return false;
  for (std::uint32_t port = 0; port < ports && message.good(); ++port) read_port(message);
  const auto statements = message.get<std::uint32_t>();
  if (statements > kMostDescriptors) return false;
  for (std::uint32_t i = 0; i < statements && message.good(); ++i) {
    const std::string word(message.text());
    tables_.add_behavior(word, message.text());
  }
  if (message.has_text()) tables_.set_more_ports(message.text());
  return message.good();
}

bool ReadDescriptors::read_words(MessageReader& message) {
  const auto count = message.get<std::uint32_t>();
  for (std::uint32_t i = 0; i < count && message.good(); ++i) {
    std::string word(message.text());
    words_.emplace(std::move(word), message.get<double>());
  }
  return message.good();
}

const lockstep_leaf_type* ReadDescriptors::read_one(MessageReader& message,
                                                    RemoteObjectType::FromText from_text) {
  from_text_ = std::move(from_text);
  return read_leaf(message) ? tables_.plugin.leaf_types[0] : nullptr;
}

bool ReadDescriptors::read(MessageReader& message, RemoteObjectType::FromText from_text) {
  from_text_ = std::move(from_text);
  lockstep_plugin& plugin = tables_.plugin;
  for (const char** it : {&plugin.name, &plugin.version, &plugin.doc}) *it = text(message);
  const auto leaves = message.get<std::uint32_t>();
  if (leaves > kMostDescriptors) return false;
  for (std::uint32_t leaf = 0; leaf < leaves; ++leaf) {
    if (!read_leaf(message)) return false;
  }
  return read_words(message);
}

}  // namespace lockstep::host
