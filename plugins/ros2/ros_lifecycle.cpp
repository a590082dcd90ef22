#include "ros_lifecycle.hpp"

#include <rosidl_runtime_c/string_functions.h>

#include <cmath>
#include <memory>

#include "calling_leaf.hpp"
#include "elements.hpp"
#include "leaf_functions.hpp"

namespace ros2 {
namespace {

enum Own : std::uint32_t { kNode, kTransition, kOnFailure, kTimeout, kError };

constexpr lockstep_port kOwnPorts[] = {
    input("node", LOCKSTEP_STRING, nullptr, "The lifecycle node's name: /camera.", LOCKSTEP_FIXED),
    input("transition", LOCKSTEP_STRING, nullptr, "What the node is to do.", LOCKSTEP_FIXED,
          "configure;activate;deactivate;cleanup;shutdown"),
    kOnFailurePort,
    {sizeof(lockstep_port), LOCKSTEP_NUMBER, LOCKSTEP_INPUT, "timeout", "5", "s",
     "How long to wait for the node and its answer.", nullptr, 0, HUGE_VAL, nullptr, 0},
    {sizeof(lockstep_port), LOCKSTEP_STRING, LOCKSTEP_OUTPUT, "error", nullptr, nullptr,
     "Why it failed: no node, no answer, refused.", nullptr, 0, 0, nullptr, 0},
};

struct LifecycleElement {
  explicit LifecycleElement(const ServiceType& of) : type(of), ports(kOwnPorts) {}

  const ServiceType& type;
  const Field *id = nullptr, *label = nullptr, *success = nullptr;
  std::string node, transition;
  bool faults = false;
  PortList ports;
  lockstep_leaf_type leaf{};
};

// lifecycle_msgs/msg/Transition. The state decides which one a shutdown is, so only its label says
// it.
std::uint8_t id_of(const std::string& transition) {
  return transition == "configure"    ? 1
         : transition == "cleanup"    ? 2
         : transition == "activate"   ? 3
         : transition == "deactivate" ? 4
                                      : 0;
}

class RosLifecycle : public CallingLeaf {
 public:
  RosLifecycle(const lockstep_host& host, const lockstep_caller* caller, void* /*run*/)
      : RosLifecycle(host, caller, element_of<LifecycleElement>(host, caller)) {}

  void start() {
    auto request = make_request();
    *request->at<std::uint8_t>(element_.id->offset) = id_of(element_.transition);
    const bool is_made = rosidl_runtime_c__String__assignn(
        request->at<rosidl_runtime_c__String>(element_.label->offset), element_.transition.data(),
        element_.transition.size());
    if (!is_made) return fail("there is no memory");
    call(std::move(request), number(kTimeout));
  }

  lockstep_status tick() {
    const auto outcome = this->outcome();
    if (outcome == ServiceClient::Outcome::Open) return waits();
    const std::string why = what_is_wrong(outcome);
    if (why.empty()) return LOCKSTEP_SUCCESS;
    return failed(kError, element_.transition + " '" + element_.node + "'", why, element_.faults);
  }

 private:
  RosLifecycle(const lockstep_host& host, const lockstep_caller* caller,
               const LifecycleElement& element)
      : CallingLeaf(host, caller, element.type, element.node + "/change_state"),
        element_(element) {}

  // A node refuses what its state does not allow, and what its callback does not do.
  std::string what_is_wrong(ServiceClient::Outcome outcome) const {
    if (outcome == ServiceClient::Outcome::NoService) return "no node";
    if (outcome != ServiceClient::Outcome::Answered) return words_of(outcome);
    return number_in(*element_.success, response().get()) == 1 ? "" : "refused";
  }

  const LifecycleElement& element_;
};

lockstep_leaf_type base_type() {
  lockstep_leaf_type type = LeafFunctions<RosLifecycle>::type(
      "RosLifecycle",
      "Changes the state of a lifecycle node of ROS 2, and succeeds when the node says that it has "
      "done so.");
  static const PortList ports(kOwnPorts);
  ports.give_to(type);
  return type;
}

std::unique_ptr<LifecycleElement> make_element(const FixedTexts& texts, Refusal& refusal) {
  auto type = service_type("lifecycle_msgs/srv/ChangeState");
  if (!type) {
    refusal = {&kOwnPorts[kNode], type.problem()};
    return nullptr;
  }
  auto element = std::make_unique<LifecycleElement>(**type);
  element->id = find_field((*type)->request, "transition.id");
  element->label = find_field((*type)->request, "transition.label");
  element->success = find_field((*type)->response, "success");
  element->node = texts[kOwnPorts[kNode]];
  element->transition = texts[kOwnPorts[kTransition]];
  element->faults = texts[kOwnPorts[kOnFailure]] == "fault";
  element->leaf = base_type();
  element->ports.give_to(element->leaf);
  return element;
}

const lockstep_leaf_type* describe(const lockstep_fixed* fixed, std::uint32_t count,
                                   lockstep_refusal* why) {
  return described<LifecycleElement>(fixed, count, why, make_element);
}

}  // namespace

const lockstep_leaf_type& ros_lifecycle() {
  static const lockstep_leaf_type type = [] {
    lockstep_leaf_type base = base_type();
    base.more_ports = "";
    base.describe = describe;
    return base;
  }();
  return type;
}

}  // namespace ros2
