#include "leaf_functions.hpp"
#include "ros_topics.hpp"
#include "topic_element.hpp"
#include "topics.hpp"

namespace ros2 {
namespace {

constexpr lockstep_port kPorts[] = {kTypePort, kTopicPort, kQosPort};

struct PublishElement : TopicElement {
  using TopicElement::TopicElement;
};

class RosPublish : public LeafBase {
 public:
  RosPublish(const lockstep_host& host, const lockstep_caller* caller, void* /*run*/)
      : LeafBase(host, caller),
        element_(element_of<PublishElement>(host, caller)),
        publisher_(std::make_shared<Publisher>(element_.type, element_.topic, element_.qos)) {
    Middleware::get().post([publisher = publisher_] { publisher->open(); });
  }
  ~RosPublish() {
    log_lines(*publisher_);
    Middleware::get().post([publisher = std::move(publisher_)] {});
  }

  lockstep_status tick() {
    log_lines(*publisher_);
    auto message = std::make_shared<Message>(*element_.type.members);
    if (!read(element_.fields, *message)) return LOCKSTEP_FAILURE;
    Middleware::get().post(
        [publisher = publisher_, message = std::move(message)] { publisher->publish(*message); });
    return LOCKSTEP_SUCCESS;
  }

 private:
  const PublishElement& element_;
  std::shared_ptr<Publisher> publisher_;
};

const lockstep_leaf_type* describe(const lockstep_fixed* fixed, std::uint32_t count,
                                   lockstep_refusal* why) {
  return described<PublishElement>(fixed, count, why,
                                   [](const FixedTexts& texts, Refusal& refusal) {
                                     return make_topic_element<PublishElement>(
                                         texts, refusal, kPorts, LOCKSTEP_INPUT, ros_publish());
                                   });
}

}  // namespace

const lockstep_leaf_type& ros_publish() {
  static const PortList ports(kPorts);
  static const lockstep_leaf_type type = [] {
    lockstep_leaf_type base = LeafFunctions<RosPublish>::type(
        "RosPublish",
        "Publishes a message on a topic of ROS 2, of any type, and succeeds at once. The "
        "attributes message.FIELD are the message.");
    base.flags |= LOCKSTEP_AT_ONCE;
    base.more_ports = "message;message.*";
    base.describe = describe;
    ports.give_to(base);
    return base;
  }();
  return type;
}

}  // namespace ros2
