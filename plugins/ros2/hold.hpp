// The ways in which a robot is held while a synchronized node withholds ticks from its leaf.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "middleware.hpp"
#include "result.hpp"
#include "types.hpp"

namespace ros2 {

struct Hold {
  enum class Way { Undecided, Nothing, Cancel, Service, Topic };
  Way way = Way::Undecided;
  std::string name = {};           // of the service or topic
  const FlagType* type = nullptr;  // of it
};

// hold="cancel", "service:NAME", "topic:NAME", "nothing"; `type` is that of the service or topic,
// "" for the usual one.
Result<Hold> read_hold(const std::string& text, const std::string& type);

// Tells a robot by a service or topic. All functions but the constructor are called by the thread
// of ROS.
class HoldSignal {
 public:
  virtual ~HoldSignal() = default;
  virtual void open() = 0;
  // "" or what is wrong.
  virtual std::string tell(bool held) = 0;
  virtual Waitable* waitable() { return nullptr; }
};
// Null for the other ways.
std::shared_ptr<HoldSignal> make_hold_signal(const Hold& hold);

}  // namespace ros2
