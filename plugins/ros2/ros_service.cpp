#include "ros_service.hpp"

#include <cmath>
#include <memory>

#include "calling_leaf.hpp"
#include "condition.hpp"
#include "elements.hpp"
#include "leaf_functions.hpp"

namespace ros2 {
namespace {

enum Own : std::uint32_t { kType, kService, kOnFailure, kTimeout, kError, kCondition };

constexpr lockstep_port kOwnPorts[] = {
    input("type", LOCKSTEP_STRING, nullptr, "The type: std_srvs/srv/Trigger.", LOCKSTEP_FIXED),
    input("service", LOCKSTEP_STRING, nullptr, "The service's name: /clear_map.", LOCKSTEP_FIXED),
    kOnFailurePort,
    {sizeof(lockstep_port), LOCKSTEP_NUMBER, LOCKSTEP_INPUT, "timeout", "5", "s",
     "How long to wait for the service and its answer.", nullptr, 0, HUGE_VAL, nullptr, 0},
    {sizeof(lockstep_port), LOCKSTEP_STRING, LOCKSTEP_OUTPUT, "error", nullptr, nullptr,
     "Why it failed: no service, no answer, condition.", nullptr, 0, 0, nullptr, 0},
    condition_port("What the answer must be, an expression over response.FIELD: "
                   "response.success. Else the leaf fails."),
};

struct ServiceElement {
  ServiceElement(const ServiceType& of, const NamedLeaf* named)
      : type(of), ports(kOwnPorts, named) {}

  const ServiceType& type;
  std::string service;
  bool faults = false;
  Condition condition;
  PortList ports;
  FieldPorts request, response;
  lockstep_leaf_type leaf{};
};

class RosService : public CallingLeaf {
 public:
  RosService(const lockstep_host& host, const lockstep_caller* caller, void* /*run*/)
      : RosService(host, caller, element_of<ServiceElement>(host, caller)) {}

  void start() {
    auto request = make_request();
    began_ = now();
    if (read(element_.request, *request)) call(std::move(request), number(kTimeout));
  }

  lockstep_status tick() {
    const auto outcome = this->outcome();
    if (outcome == ServiceClient::Outcome::Open) return waits();
    if (outcome == ServiceClient::Outcome::Answered) {
      write(response_ports_, response());
      auto memory = element_.condition.memory();
      const bool holds = element_.condition.holds(response().get(), now() - began_, memory);
      if (holds) return LOCKSTEP_SUCCESS;
      const std::string words = " '" + element_.condition.text() + "'" +
                                element_.type.response_words.text(response().get());
      if (element_.faults) return end_without("condition", words);
      set_text(kError, "condition");  // that it is not true is no line of output
      say("the response of '" + element_.service + "' does not meet the condition" + words);
      return LOCKSTEP_FAILURE;
    }
    return end_without(words_of(outcome));
  }

 private:
  RosService(const lockstep_host& host, const lockstep_caller* caller,
             const ServiceElement& element)
      : CallingLeaf(host, caller, element.type, element.service),
        element_(element),
        response_ports_(given(element.response)) {}

  lockstep_status end_without(const std::string& why, const std::string& words = {}) {
    return failed(kError, "the service '" + element_.service + "'", why, element_.faults, words);
  }

  const ServiceElement& element_;
  const FieldPorts response_ports_;
  double began_ = 0;
};

constexpr const char* kDoc =
    "Calls a service of ROS 2, of any type, and succeeds when it has answered, whatever the answer "
    "says, unless it has a condition. The attributes request.FIELD are the request; response.FIELD "
    "are put into entries.";

lockstep_leaf_type base_type() {
  lockstep_leaf_type type = LeafFunctions<RosService>::type("RosService", kDoc);
  static const PortList ports(kOwnPorts);
  ports.give_to(type);
  return type;
}

std::unique_ptr<ServiceElement> make_element(const FixedTexts& texts, Refusal& refusal) {
  auto type = service_type(texts[kOwnPorts[kType]]);
  if (!type) {
    refusal = {&kOwnPorts[kType], type.problem()};
    return nullptr;
  }
  auto element = std::make_unique<ServiceElement>(**type, texts.named());
  element->service = texts[kOwnPorts[kService]];
  element->faults = texts[kOwnPorts[kOnFailure]] == "fault";
  if (!element->condition.read(texts, kOwnPorts[kCondition], "response.", element->type.response,
                               refusal)) {
    return nullptr;
  }
  element->request = element->ports.add("request.", element->type.request, LOCKSTEP_INPUT);
  element->response = element->ports.add("response.", element->type.response, LOCKSTEP_OUTPUT);
  element->leaf = base_type();
  element->ports.give_to(element->leaf);
  if (texts.named() != nullptr) element->leaf.id = texts.named()->id.c_str();
  return element;
}

const lockstep_leaf_type* describe(const lockstep_fixed* fixed, std::uint32_t count,
                                   lockstep_refusal* why) {
  return described<ServiceElement>(fixed, count, why, make_element);
}

}  // namespace

const lockstep_leaf_type& ros_service() {
  static const lockstep_leaf_type type = [] {
    lockstep_leaf_type base = base_type();
    base.more_ports = "request;request.*;response;response.*";
    base.describe = describe;
    return base;
  }();
  return type;
}

}  // namespace ros2
