#include "target.hpp"

#include <cmath>

#include "field_values.hpp"
#include "parameter.hpp"
#include "service_client.hpp"
#include "topics.hpp"

namespace ros2 {
namespace {

using namespace std::chrono_literals;

constexpr double kAnswerLimit = 1;  // s

class TopicTeller final : public Teller {
 public:
  TopicTeller(const Target& target, const char* qos)
      : target_(target),
        message_(std::make_shared<Message>(target.members())),
        publisher_(*target.message, target.name, qos) {
    if (std::string(qos) != "latched") return;
    others_ = std::make_shared<Subscription>(*target.message, target.name, qos,
                                             Subscription::From::Others);
  }
  void open() override {
    publisher_.open();
    opened_ = Clock::now();
    if (others_ == nullptr) return;
    others_->open();
    Middleware::get().add(others_);
  }
  void close() override { Middleware::get().remove(others_.get()); }
  Ids listeners() override { return publisher_.receivers(); }
  void use(std::shared_ptr<Message> message) override { message_ = std::move(message); }
  std::string tell(double value) override {
    set_number(*target_.field, message_->get(), value);
    publisher_.publish(*message_);
    std::string wrong;
    publisher_.lines().next(wrong);
    return wrong;
  }
  // What is kept for those who come late needs some time to come.
  bool is_looking(Clock::time_point now) override { return !found() && now < opened_ + 100ms; }
  std::optional<double> found() override {
    if (others_ != nullptr && others_->received().update()) {
      found_ = number_in(*target_.field, others_->received().front().message.get());
    }
    return found_;
  }

 private:
  const Target target_;
  std::shared_ptr<Message> message_;
  Publisher publisher_;
  std::shared_ptr<Subscription> others_;
  Clock::time_point opened_{};
  std::optional<double> found_;
};

// What a service says: "" or that it refuses.
std::string refusal(const ServiceType& type, const Message& response) {
  const Field* const success = find_field(type.response, "success");
  const auto value = success == nullptr ? std::nullopt : number_in(*success, response.get());
  return value == 0.0 ? "refused" : "";
}

// One service, and what it has answered to the last call.
class Caller {
 public:
  Caller(const ServiceType& type, const std::string& service)
      : client_(std::make_shared<ServiceClient>(type, service)) {}
  void open() {
    client_->open();
    Middleware::get().add(client_);
  }
  void close() { Middleware::get().remove(client_.get()); }
  Ids servers() { return client_->servers(); }
  void call(std::shared_ptr<Message> request) {
    client_->send({++calls_, std::move(request), kAnswerLimit});
  }
  bool is_open() const {
    return calls_ != 0 && client_->outcome(calls_) == ServiceClient::Outcome::Open;
  }
  const Message* response() const {
    const bool has_one =
        calls_ != 0 && client_->outcome(calls_) == ServiceClient::Outcome::Answered;
    return has_one ? &client_->response() : nullptr;
  }
  // As Teller::answer; `wrong` says what is wrong with a response.
  template <class Wrong>
  std::optional<std::string> answer(Wrong wrong) const {
    if (is_open()) return std::nullopt;
    return response() == nullptr ? kNoAnswer : wrong(*response());
  }

 private:
  std::shared_ptr<ServiceClient> client_;
  std::uint64_t calls_ = 0;
};

class ServiceTeller final : public Teller {
 public:
  explicit ServiceTeller(const Target& target)
      : target_(target),
        message_(std::make_shared<Message>(target.members())),
        caller_(*target.service, target.name) {}
  void open() override { caller_.open(); }
  void close() override { caller_.close(); }
  Ids listeners() override { return caller_.servers(); }
  void use(std::shared_ptr<Message> message) override { message_ = std::move(message); }
  std::string tell(double value) override {
    if (caller_.servers().empty()) return "there is no service '" + target_.name + "'";
    set_number(*target_.field, message_->get(), value);
    caller_.call(message_);
    return {};
  }
  std::optional<std::string> answer() override {
    return caller_.answer(
        [this](const Message& response) { return refusal(*target_.service, response); });
  }

 private:
  const Target target_;
  std::shared_ptr<Message> message_;
  Caller caller_;
};

class ParameterTeller final : public Teller {
 public:
  explicit ParameterTeller(const Target& target)
      : target_(target),
        get_(**service_type(kGetParameters), target.name + "/get_parameters"),
        set_(**service_type(kSetParameters), target.name + "/set_parameters") {}
  void open() override {
    get_.open();
    set_.open();
  }
  void close() override {
    get_.close();
    set_.close();
  }
  Ids listeners() override { return get_.servers().empty() ? Ids() : set_.servers(); }
  void look() override {
    auto request = std::make_shared<Message>(*(*service_type(kGetParameters))->request_message);
    if (ask_for_parameter(*request, target_.parameter)) get_.call(std::move(request));
  }
  bool is_looking(Clock::time_point /*now*/) override { return get_.is_open(); }
  std::optional<double> found() override {
    const Message* const response = get_.response();
    const ParameterValue* const value = response == nullptr ? nullptr : value_in(*response);
    if (value == nullptr || (value->type != kInt && value->type != kDouble)) return std::nullopt;
    kind_ = static_cast<ParameterKind>(value->type);
    return kind_ == kInt ? double(value->integer_value) : value->double_value;
  }
  std::string tell(double value) override {
    if (!found()) return "it is not a number";
    auto request = std::make_shared<Message>(*(*service_type(kSetParameters))->request_message);
    ParameterValue* const it = value_to_set(*request, target_.parameter);
    if (it == nullptr) return "there is no memory";
    it->type = kind_;
    it->double_value = value;
    it->integer_value = std::llround(value);
    // Slow is not none at all.
    if (it->integer_value == 0 && value != 0) it->integer_value = value < 0 ? -1 : 1;
    set_.call(std::move(request));
    return {};
  }
  std::optional<std::string> answer() override { return set_.answer(why_not_set); }

 private:
  const Target target_;
  Caller get_, set_;
  ParameterKind kind_ = kDouble;  // which the node gives it
};

// Numbers of a stamp or a duration are none that a robot is told.
bool is_part_of_time(const std::vector<Field>& fields, const Field& field) {
  const auto dot = field.path.rfind('.');
  if (dot == std::string::npos) return false;
  const Field* const whole = find_field(fields, field.path.substr(0, dot));
  return whole != nullptr &&
         (whole->kind == Field::Kind::Time || whole->kind == Field::Kind::Duration);
}

const Field* first_of(const std::vector<Field>& fields, const std::vector<Field::Kind>& kinds) {
  for (const Field::Kind kind : kinds) {
    for (const Field& field : fields) {
      if (field.kind == kind && !is_part_of_time(fields, field)) return &field;
    }
  }
  return nullptr;
}

}  // namespace

std::string Target::words() const {
  if (way == Way::Parameter) return "the parameter '" + parameter + "' of '" + name + "'";
  return (way == Way::Topic ? "the topic '" : "the service '") + name + "'";
}

const std::vector<Field>& Target::fields() const {
  static const std::vector<Field> none;
  return way == Way::Topic ? message->fields : way == Way::Service ? service->request : none;
}

std::optional<Target> target_named(const std::string& text) {
  const auto colon = text.find(':');
  if (colon == std::string::npos || colon + 1 == text.size()) return std::nullopt;
  const std::string way = text.substr(0, colon), name = text.substr(colon + 1);
  if (way == "topic") return Target{Target::Way::Topic, name};
  if (way == "service") return Target{Target::Way::Service, name};
  const auto slash = name.rfind('/');
  const bool has_both = slash != std::string::npos && slash != 0 && slash + 1 != name.size();
  if (way != "parameter" || !has_both) return std::nullopt;
  return Target{Target::Way::Parameter, name.substr(0, slash), name.substr(slash + 1)};
}

std::optional<Problem> find_type(Target& target, const std::string& type,
                                 const std::vector<Field::Kind>& kinds, const char* needs) {
  if (target.way == Target::Way::Parameter) {
    auto get = service_type(kGetParameters), set = service_type(kSetParameters);
    if (!get || !set) return get ? set.problem() : get.problem();
    return std::nullopt;
  }
  if (target.way == Target::Way::Topic) {
    auto found = message_type(type);
    if (!found) return found.problem();
    target.message = *found;
  } else {
    auto found = service_type(type);
    if (!found) return found.problem();
    target.service = *found;
  }
  target.field = first_of(target.fields(), kinds);
  if (target.field != nullptr) return std::nullopt;
  return Problem{"'" + type + "' has no " + needs};
}

std::shared_ptr<Teller> make_teller(const Target& target, const char* qos) {
  if (target.way == Target::Way::Topic) return std::make_shared<TopicTeller>(target, qos);
  if (target.way == Target::Way::Service) return std::make_shared<ServiceTeller>(target);
  return std::make_shared<ParameterTeller>(target);
}

}  // namespace ros2
