#include <cmath>
#include <limits>

#include "condition.hpp"
#include "kept_objects.hpp"
#include "leaf_functions.hpp"
#include "ros_topics.hpp"
#include "topic_element.hpp"
#include "topics.hpp"

namespace ros2 {
namespace {

enum Own : std::uint32_t { kTake = kQos + 1, kMaxAge, kTimeout, kCondition, kDefault };

constexpr lockstep_port kPorts[] = {
    kTypePort,
    kTopicPort,
    kQosPort,
    input("take", LOCKSTEP_STRING, "newest",
          "newest: the last message, if there is one already; next: one that comes after the leaf "
          "has begun.",
          LOCKSTEP_FIXED, "newest;next"),
    {sizeof(lockstep_port), LOCKSTEP_NUMBER, LOCKSTEP_INPUT, "max_age", nullptr, "s",
     "How long ago the message may have come; any time when left out.", nullptr, 0, HUGE_VAL,
     nullptr, LOCKSTEP_OPTIONAL},
    {sizeof(lockstep_port), LOCKSTEP_NUMBER, LOCKSTEP_INPUT, "timeout", nullptr, "s",
     "After this time without a message the leaf fails; when left out, it waits.", nullptr, 0,
     HUGE_VAL, nullptr, LOCKSTEP_OPTIONAL},
    condition_port("What the message must be, an expression over message.FIELD: "
                   "message.percentage > 0.2. Others are passed over."),
    input("default", LOCKSTEP_STRING, nullptr,
          "What the texts of the message are when none has come in time: the leaf succeeds then.",
          LOCKSTEP_OPTIONAL),
};

struct ReceiveElement : TopicElement {
  using TopicElement::TopicElement;
  bool takes_next = false;
  Condition condition;
};

class RosReceive : public LeafBase {
 public:
  RosReceive(const lockstep_host& host, const lockstep_caller* caller, void* /*run*/)
      : LeafBase(host, caller),
        element_(element_of<ReceiveElement>(host, caller)),
        subscription_(std::make_shared<Subscription>(element_.type, element_.topic, element_.qos)),
        fields_(given(element_.fields)) {
    Middleware::get().post([subscription = subscription_] {
      subscription->open();
      Middleware::get().add(subscription);
    });
  }
  ~RosReceive() {
    log_lines(*subscription_);
    Middleware::get().post([subscription = std::move(subscription_)] {
      Middleware::get().remove(subscription.get());
    });
  }

  void start() {
    began_ = Clock::now();
    memory_ = element_.condition.memory();
    timeout_ = limit(kTimeout);
    max_age_ = limit(kMaxAge);
  }

  lockstep_status tick() {
    log_lines(*subscription_);
    if (subscription_->received().update()) {
      has_some_ = true;
      objects_.forget();
    }
    const auto now = Clock::now();
    const Lack lack = has_some_ ? lack_of(subscription_->received().front(), now) : Lack::Message;
    if (lack == Lack::Nothing) {
      objects_.write(host_, caller_, fields_, subscription_->received().front().message);
      return LOCKSTEP_SUCCESS;
    }
    if (seconds(now - began_) < timeout_) {
      return waits(static_cast<int>(lack), [&] { return words_of(lack); });
    }
    if (write_default()) return LOCKSTEP_SUCCESS;
    say(words_of(lack) + (lack == Lack::Condition ? last_message() : ""));
    return LOCKSTEP_FAILURE;
  }

 private:
  static double seconds(Clock::duration time) {
    return std::chrono::duration<double>(time).count();
  }

  double limit(std::uint32_t port) const {
    double value = std::numeric_limits<double>::infinity();
    host_.get_double(caller_, port, &value);
    return value;
  }

  // What the leaf waits for.
  enum class Lack { Nothing, Message, Next, Age, Condition };

  Lack lack_of(const Subscription::Received& received, Clock::time_point now) {
    if (element_.takes_next && received.at < began_) return Lack::Next;
    if (seconds(now - received.at) > max_age_) return Lack::Age;
    const bool holds =
        element_.condition.holds(received.message.get(), seconds(now - began_), memory_);
    return holds ? Lack::Nothing : Lack::Condition;
  }

  std::string words_of(Lack lack) const {
    const std::string of = " on '" + element_.topic + "'";
    switch (lack) {
      case Lack::Next:
        return "no message" + of + " since it began";
      case Lack::Age:
        return "the last message" + of + " is older than max_age";
      case Lack::Condition:
        return "the last message" + of + " does not meet the condition '" +
               element_.condition.text() + "'";
      default:
        return "no message" + of + " yet";
    }
  }
  std::string last_message() {
    const std::string text =
        text_of(*element_.type.members, subscription_->received().front().message.get());
    return text.empty() ? "" : ": " + text;
  }

  // False: the tree gives none.
  bool write_default() {
    const char* text = nullptr;
    std::size_t length = 0;
    if (!is_given(host_, caller_, kDefault)) return false;
    if (!host_.get_string(caller_, kDefault, &text, &length)) return false;
    const std::string kept(text, length);  // setting a port ends the text of another
    for (const auto& [port, field] : fields_) {
      if (field->kind == Field::Kind::String) set_text(port, kept);
    }
    return true;
  }

  const ReceiveElement& element_;
  std::shared_ptr<Subscription> subscription_;
  const FieldPorts fields_;
  KeptObjects objects_;  // of the newest message
  bool has_some_ = false;
  Clock::time_point began_{};
  double timeout_ = 0, max_age_ = 0;
  Expression::Memory memory_;
};

std::unique_ptr<ReceiveElement> make_element(const FixedTexts& texts, Refusal& refusal) {
  auto element =
      make_topic_element<ReceiveElement>(texts, refusal, kPorts, LOCKSTEP_OUTPUT, ros_receive());
  if (element == nullptr) return nullptr;
  element->takes_next = texts[kPorts[kTake]] == "next";
  const bool is_good =
      element->condition.read(texts, kPorts[kCondition], "message.", element->type.fields, refusal);
  return is_good ? std::move(element) : nullptr;
}

const lockstep_leaf_type* describe(const lockstep_fixed* fixed, std::uint32_t count,
                                   lockstep_refusal* why) {
  return described<ReceiveElement>(fixed, count, why, make_element);
}

}  // namespace

const lockstep_leaf_type& ros_receive() {
  static const PortList ports(kPorts);
  static const lockstep_leaf_type type = [] {
    lockstep_leaf_type base = LeafFunctions<RosReceive>::type(
        "RosReceive",
        "Waits for a message on a topic of ROS 2, of any type, and succeeds when it has one. The "
        "attributes message.FIELD are put into entries.");
    base.more_ports = "message;message.*";
    base.describe = describe;
    ports.give_to(base);
    return base;
  }();
  return type;
}

}  // namespace ros2
