// Where a robot is told a number or a yes and no: by a topic, a service, or a parameter of a node.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "graph.hpp"
#include "middleware.hpp"
#include "result.hpp"
#include "types.hpp"

namespace ros2 {

struct Target {
  enum class Way { Topic, Service, Parameter };
  Way way = Way::Topic;
  std::string name = {};                 // of the topic, of the service, or of the node
  std::string parameter = {};            // of a Parameter
  const MessageType* message = nullptr;  // of a Topic
  const ServiceType* service = nullptr;  // of a Service
  const Field* field = nullptr;          // where the value goes; null: of a Parameter

  // "the topic '/speed'"
  std::string words() const;
  // "": of a Parameter.
  const std::string& type() const {
    static const std::string none;
    return way == Way::Topic ? message->name : way == Way::Service ? service->name : none;
  }
  // Of the message or the request. A Parameter has neither.
  const Members& members() const {
    return way == Way::Topic ? *message->members : *service->request_message;
  }
  const std::vector<Field>& fields() const;
};

// "topic:NAME", "service:NAME", "parameter:NODE/NAME", without a type. Nothing: `text` is none.
std::optional<Target> target_named(const std::string& text);
// Finds its type, and the field: the first of the kinds, in their order. `needs`: "a bool".
std::optional<Problem> find_type(Target& target, const std::string& type,
                                 const std::vector<Field::Kind>& kinds, const char* needs);

constexpr const char* kNoAnswer = "no answer";

// The thread of ROS calls all functions.
class Teller {
 public:
  virtual ~Teller() = default;
  virtual void open() = 0;
  virtual void close() {}
  // Who hears it. Another one than before: one has come, or come back.
  virtual Ids listeners() = 0;
  // The other fields of what it tells.
  virtual void use(std::shared_ptr<Message> /*message*/) {}
  // "" or what is wrong.
  virtual std::string tell(double value) = 0;
  // "" or what is wrong with what was told last, kNoAnswer too; nothing: that is not known yet.
  virtual std::optional<std::string> answer() { return std::string(); }

  // Begins to read what the robot has now.
  virtual void look() {}
  virtual bool is_looking(Clock::time_point /*now*/) { return false; }
  // Nothing: it cannot be read.
  virtual std::optional<double> found() { return std::nullopt; }
};
std::shared_ptr<Teller> make_teller(const Target& target, const char* qos);

}  // namespace ros2
