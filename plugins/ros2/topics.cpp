#include "topics.hpp"

#include <rcl/error_handling.h>
#include <rmw/qos_profiles.h>

namespace ros2 {
namespace {
// The qualities of others are known some time after they are seen first.
constexpr auto kBetweenLooks = std::chrono::seconds(1);
}  // namespace

rmw_qos_profile_t qos_named(const std::string& name) {
  if (name == "sensor_data") return rmw_qos_profile_sensor_data;
  rmw_qos_profile_t qos = rmw_qos_profile_default;
  if (name != "latched") return qos;
  qos.depth = 1;
  qos.durability = RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL;
  return qos;
}

Publisher::Publisher(const MessageType& type, std::string topic, std::string qos)
    : type_(type),
      topic_(std::move(topic)),
      qos_(std::move(qos)),
      publisher_(rcl_get_zero_initialized_publisher()) {}

Publisher::~Publisher() {
  if (is_made_ && rcl_publisher_fini(&publisher_, &Middleware::get().node()) != RCL_RET_OK) {
    rcl_reset_error();
  }
}

void Publisher::open() {
  rcl_publisher_options_t options = rcl_publisher_get_default_options();
  options.qos = qos_named(qos_);
  is_made_ = rcl_publisher_init(&publisher_, &Middleware::get().node(), type_.support,
                                topic_.c_str(), &options) == RCL_RET_OK;
  if (!is_made_) lines_.add("there is no publisher of '" + topic_ + "': " + last_ros_error());
}

void Publisher::publish(const Message& message) {
  if (!is_made_) return;
  if (rcl_publish(&publisher_, message.get(), nullptr) != RCL_RET_OK) {
    lines_.add("nothing was published: " + last_ros_error());
  }
  look_who_receives(Clock::now());
}

Ids Publisher::receivers() const {
  return is_made_ ? receivers_of(rcl_publisher_get_topic_name(&publisher_)) : Ids();
}

void Publisher::look_who_receives(Clock::time_point now) {
  if (has_told_ || now < next_look_) return;
  next_look_ = now + kBetweenLooks;
  std::size_t count = 0;
  if (rcl_publisher_get_subscription_count(&publisher_, &count) != RCL_RET_OK) rcl_reset_error();
  if (count != 0) return;
  const std::string why =
      why_nobody_receives(rcl_publisher_get_topic_name(&publisher_), type_.name, qos_named(qos_));
  has_told_ = !why.empty();
  if (has_told_) lines_.add(why);
}

Subscription::Subscription(const MessageType& type, std::string topic, std::string qos, From from)
    : type_(type),
      topic_(std::move(topic)),
      qos_(std::move(qos)),
      from_(from),
      subscription_(rcl_get_zero_initialized_subscription()),
      received_([&] { return std::unique_ptr<Received>(new Received{Message(*type.members)}); }) {}

Subscription::~Subscription() {
  if (is_made_ && rcl_subscription_fini(&subscription_, &Middleware::get().node()) != RCL_RET_OK) {
    rcl_reset_error();
  }
}

void Subscription::open() {
  rcl_subscription_options_t options = rcl_subscription_get_default_options();
  options.qos = qos_named(qos_);
  options.rmw_subscription_options.ignore_local_publications = from_ == From::Others;
  is_made_ = rcl_subscription_init(&subscription_, &Middleware::get().node(), type_.support,
                                   topic_.c_str(), &options) == RCL_RET_OK;
  if (!is_made_) lines_.add("there is no subscription of '" + topic_ + "': " + last_ros_error());
  if (rcl_subscription_options_fini(&options) != RCL_RET_OK) rcl_reset_error();
  next_look_ = Clock::now() + kBetweenLooks;
}

bool Subscription::poll(Clock::time_point now) {
  if (!is_made_ || is_settled_) return false;
  if (now < next_look_) return !has_looked_;
  has_looked_ = true;
  next_look_ = now + kBetweenLooks;
  const std::string why = why_nothing_comes(rcl_subscription_get_topic_name(&subscription_),
                                            type_.name, qos_named(qos_));
  is_settled_ = !why.empty();
  if (is_settled_) lines_.add(why);
  return false;
}

void Subscription::add_sizes(Sizes& sizes) const {
  if (is_made_) ++sizes.subscriptions;
}

void Subscription::add_to(rcl_wait_set_t& set) {
  if (is_made_ && rcl_wait_set_add_subscription(&set, &subscription_, nullptr) != RCL_RET_OK) {
    rcl_reset_error();
  }
}

void Subscription::take(const rcl_wait_set_t& /*set*/) {
  while (is_made_) {
    Received& next = received_.back();
    next.message.reset();
    if (rcl_take(&subscription_, next.message.get(), nullptr, nullptr) != RCL_RET_OK) break;
    next.at = Clock::now();
    received_.publish();
    is_settled_ = true;
  }
  rcl_reset_error();
}

}  // namespace ros2
