// The elements of RosPublish and RosReceive.
#pragma once

#include <memory>

#include "elements.hpp"
#include "leaf_base.hpp"
#include "types.hpp"

namespace ros2 {

// The ports that both have first.
enum TopicPort : std::uint32_t { kType, kTopic, kQos };
constexpr lockstep_port kTypePort =
    input("type", LOCKSTEP_STRING, nullptr, "The type: std_msgs/msg/String.", LOCKSTEP_FIXED);
constexpr lockstep_port kTopicPort =
    input("topic", LOCKSTEP_STRING, nullptr, "The topic's name: /status.", LOCKSTEP_FIXED);
constexpr lockstep_port kQosPort =
    input("qos", LOCKSTEP_STRING, "default",
          "default: reliable; sensor_data: messages may be lost; latched: who comes late gets the "
          "last one.",
          LOCKSTEP_FIXED, "default;sensor_data;latched");

struct TopicElement {
  template <std::size_t Count>
  TopicElement(const MessageType& of, const lockstep_port (&own)[Count], const NamedLeaf* named)
      : type(of), ports(own, named) {}

  const MessageType& type;
  std::string topic, qos;
  PortList ports;
  FieldPorts fields;
  lockstep_leaf_type leaf{};
};

// `Element` is a TopicElement; `base` is the leaf type without the ports of fields.
template <class Element, std::size_t Count>
std::unique_ptr<Element> make_topic_element(const FixedTexts& texts, Refusal& refusal,
                                            const lockstep_port (&own)[Count],
                                            lockstep_direction direction,
                                            const lockstep_leaf_type& base) {
  auto type = message_type(texts[kTypePort]);
  if (!type) {
    refusal = {&kTypePort, type.problem()};
    return nullptr;
  }
  auto element = std::make_unique<Element>(**type, own, texts.named());
  element->topic = texts[kTopicPort];
  element->qos = texts[kQosPort];
  element->fields = element->ports.add("message.", element->type.fields, direction);
  element->leaf = base;
  element->leaf.more_ports = nullptr;
  element->leaf.describe = nullptr;
  element->ports.give_to(element->leaf);
  if (texts.named() != nullptr) element->leaf.id = texts.named()->id.c_str();
  return element;
}

}  // namespace ros2
