#include "ros_parameter.hpp"

#include <cmath>
#include <memory>

#include "calling_leaf.hpp"
#include "elements.hpp"
#include "leaf_functions.hpp"
#include "parameter.hpp"

namespace ros2 {
namespace {

enum Own : std::uint32_t { kNode, kParameter, kAs, kDo, kTimeout, kError, kValue };

constexpr lockstep_port kOwnPorts[] = {
    input("node", LOCKSTEP_STRING, nullptr, "The node's name: /controller.", LOCKSTEP_FIXED),
    input("parameter", LOCKSTEP_STRING, nullptr, "The parameter's name: max_speed.",
          LOCKSTEP_FIXED),
    input("as", LOCKSTEP_STRING, "double", "The type of the parameter.", LOCKSTEP_FIXED,
          "bool;int;double;string"),
    input("do", LOCKSTEP_STRING, "get", "get: value is an entry; set: value is what it becomes.",
          LOCKSTEP_FIXED, "get;set"),
    {sizeof(lockstep_port), LOCKSTEP_NUMBER, LOCKSTEP_INPUT, "timeout", "5", "s",
     "How long to wait for the node and its answer.", nullptr, 0, HUGE_VAL, nullptr, 0},
    {sizeof(lockstep_port), LOCKSTEP_STRING, LOCKSTEP_OUTPUT, "error", nullptr, nullptr,
     "Why it failed: no node, no answer, not set, not a double, or what the node says.", nullptr, 0,
     0, nullptr, 0},
};

struct ParameterElement {
  std::string node, parameter, as;
  bool sets = false;
  const ServiceType* type = nullptr;
  lockstep_port value{};
  const lockstep_port* ports[kValue + 1] = {};
  lockstep_leaf_type leaf{};

  std::string service() const { return node + (sets ? "/set_parameters" : "/get_parameters"); }
};

ParameterKind kind_of(const std::string& as) {
  return as == "bool" ? kBool : as == "int" ? kInt : as == "double" ? kDouble : kString;
}

lockstep_type type_of(const std::string& as) {
  return as == "bool"     ? LOCKSTEP_BOOL
         : as == "int"    ? LOCKSTEP_INT
         : as == "double" ? LOCKSTEP_DOUBLE
                          : LOCKSTEP_STRING;
}

class RosParameter : public CallingLeaf {
 public:
  RosParameter(const lockstep_host& host, const lockstep_caller* caller, void* /*run*/)
      : RosParameter(host, caller, element_of<ParameterElement>(host, caller)) {}

  void start() {
    auto request = make_request();
    const bool is_made =
        element_.sets ? make_set(*request) : ask_for_parameter(*request, element_.parameter);
    if (!is_made) return fail("there is no memory, or no value");
    call(std::move(request), number(kTimeout));
  }

  lockstep_status tick() {
    const auto outcome = this->outcome();
    if (outcome == ServiceClient::Outcome::Open) return waits();
    const std::string why = outcome == ServiceClient::Outcome::Answered    ? take_answer()
                            : outcome == ServiceClient::Outcome::NoService ? "no node"
                                                                           : words_of(outcome);
    if (why.empty()) return LOCKSTEP_SUCCESS;
    return failed(kError, "the parameter '" + element_.parameter + "'", why);
  }

 private:
  RosParameter(const lockstep_host& host, const lockstep_caller* caller,
               const ParameterElement& element)
      : CallingLeaf(host, caller, *element.type, element.service()), element_(element) {}

  bool make_set(Message& request) const {
    ParameterValue* const made = value_to_set(request, element_.parameter);
    if (made == nullptr) return false;
    ParameterValue& value = *made;
    value.type = kind_of(element_.as);
    const char* text = nullptr;
    std::size_t length = 0;
    switch (value.type) {
      case kBool:
        return host_.get_bool(caller_, kValue, &value.bool_value);
      case kInt:
        return host_.get_int(caller_, kValue, &value.integer_value);
      case kDouble:
        return host_.get_double(caller_, kValue, &value.double_value);
      default:
        return host_.get_string(caller_, kValue, &text, &length) &&
               put(value.string_value, {text, length});
    }
  }

  // "" or why there is no value.
  std::string take_answer() {
    if (element_.sets) return why_not_set(response());
    const ParameterValue* const found = value_in(response());
    return found == nullptr ? "not set" : take_value(*found);
  }

  std::string take_value(const ParameterValue& value) {
    if (value.type != kind_of(element_.as)) return "not a " + element_.as;
    switch (value.type) {
      case kBool:
        host_.set_bool(caller_, kValue, value.bool_value);
        break;
      case kInt:
        host_.set_int(caller_, kValue, value.integer_value);
        break;
      case kDouble:
        host_.set_double(caller_, kValue, value.double_value);
        break;
      default:
        set_text(kValue, {value.string_value.data, value.string_value.size});
    }
    return {};
  }

  const ParameterElement& element_;
};

lockstep_leaf_type base_type() {
  lockstep_leaf_type type = LeafFunctions<RosParameter>::type(
      "RosParameter", "Reads or sets a parameter of a node of ROS 2.");
  static const PortList ports(kOwnPorts);
  ports.give_to(type);
  return type;
}

std::unique_ptr<ParameterElement> make_element(const FixedTexts& texts, Refusal& refusal) {
  auto element = std::make_unique<ParameterElement>();
  element->sets = texts[kOwnPorts[kDo]] == "set";
  auto type = service_type(element->sets ? kSetParameters : kGetParameters);
  if (!type) {
    refusal = {&kOwnPorts[kNode], type.problem()};
    return nullptr;
  }
  element->type = *type;
  element->node = texts[kOwnPorts[kNode]];
  element->parameter = texts[kOwnPorts[kParameter]];
  element->as = texts[kOwnPorts[kAs]];
  element->value.struct_size = sizeof(lockstep_port);
  element->value.name = "value";
  element->value.type = type_of(element->as);
  element->value.direction = element->sets ? LOCKSTEP_INPUT : LOCKSTEP_OUTPUT;
  element->value.doc = element->sets ? "What it becomes." : "What it is.";
  for (std::uint32_t i = 0; i < kValue; ++i) element->ports[i] = &kOwnPorts[i];
  element->ports[kValue] = &element->value;
  element->leaf = base_type();
  element->leaf.ports = element->ports;
  element->leaf.port_count = kValue + 1;
  return element;
}

const lockstep_leaf_type* describe(const lockstep_fixed* fixed, std::uint32_t count,
                                   lockstep_refusal* why) {
  return described<ParameterElement>(fixed, count, why, make_element);
}

}  // namespace

const lockstep_leaf_type& ros_parameter() {
  static const lockstep_leaf_type type = [] {
    lockstep_leaf_type base = base_type();
    base.more_ports = "value";
    base.describe = describe;
    return base;
  }();
  return type;
}

}  // namespace ros2
