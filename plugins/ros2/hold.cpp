#include "hold.hpp"

#include <rcl/error_handling.h>
#include <rcl/graph.h>

namespace ros2 {
namespace {

void set_flag(const Hold& hold, Message& message, bool held) {
  *message.at<bool>(hold.type->flag.offset) = held;
}

class HoldTopic final : public HoldSignal {
 public:
  explicit HoldTopic(const Hold& hold) : hold_(hold), message_(*hold.type->message) {}
  ~HoldTopic() override {
    if (is_made_ && rcl_publisher_fini(&publisher_, &Middleware::get().node()) != RCL_RET_OK) {
      rcl_reset_error();
    }
  }
  void open() override {
    rcl_publisher_options_t options = rcl_publisher_get_default_options();
    is_made_ =
        rcl_publisher_init(&publisher_, &Middleware::get().node(),
                           static_cast<const rosidl_message_type_support_t*>(hold_.type->support),
                           hold_.name.c_str(), &options) == RCL_RET_OK;
    if (!is_made_) rcl_reset_error();
  }
  std::string tell(bool held) override {
    if (!is_made_) return "there is no publisher of '" + hold_.name + "': the robot goes on";
    set_flag(hold_, message_, held);
    const auto code = rcl_publish(&publisher_, message_.get(), nullptr);
    return code == RCL_RET_OK ? "" : last_ros_error();
  }

 private:
  const Hold hold_;
  Message message_;
  rcl_publisher_t publisher_ = rcl_get_zero_initialized_publisher();
  bool is_made_ = false;
};

class HoldService final : public HoldSignal, public Waitable {
 public:
  explicit HoldService(const Hold& hold)
      : hold_(hold), request_(*hold.type->message), response_(*hold.type->response) {}
  ~HoldService() override {
    if (is_made_ && rcl_client_fini(&client_, &Middleware::get().node()) != RCL_RET_OK) {
      rcl_reset_error();
    }
  }
  void open() override {
    const rcl_client_options_t options = rcl_client_get_default_options();
    is_made_ =
        rcl_client_init(&client_, &Middleware::get().node(),
                        static_cast<const rosidl_service_type_support_t*>(hold_.type->support),
                        hold_.name.c_str(), &options) == RCL_RET_OK;
    if (!is_made_) rcl_reset_error();
  }
  std::string tell(bool held) override {
    bool is_there = false;
    if (is_made_ && rcl_service_server_is_available(&Middleware::get().node(), &client_,
                                                    &is_there) != RCL_RET_OK) {
      rcl_reset_error();
    }
    if (!is_there) {
      return "there is no service '" + hold_.name +
             "': " + (held ? "the robot goes on" : "the robot is not told to go on");
    }
    set_flag(hold_, request_, held);
    std::int64_t call = 0;
    const auto code = rcl_send_request(&client_, request_.get(), &call);
    return code == RCL_RET_OK ? "" : last_ros_error();
  }
  Waitable* waitable() override { return this; }
  void add_sizes(Sizes& sizes) const override { sizes.clients += is_made_ ? 1 : 0; }
  void add_to(rcl_wait_set_t& set) override {
    if (is_made_ && rcl_wait_set_add_client(&set, &client_, nullptr) != RCL_RET_OK) {
      rcl_reset_error();
    }
  }
  void take(const rcl_wait_set_t& /*set*/) override {
    rmw_request_id_t id{};
    do {
      response_.reset();
    } while (is_made_ && rcl_take_response(&client_, &id, response_.get()) == RCL_RET_OK);
    rcl_reset_error();
  }
  bool poll(Clock::time_point /*now*/) override { return false; }

 private:
  const Hold hold_;
  Message request_, response_;
  rcl_client_t client_ = rcl_get_zero_initialized_client();
  bool is_made_ = false;
};

bool starts_with(const std::string& text, const std::string& begin) {
  return text.rfind(begin, 0) == 0;
}

}  // namespace

Result<Hold> read_hold(const std::string& text, const std::string& type) {
  if (text.empty()) return Hold{};
  if (text == "nothing") return Hold{Hold::Way::Nothing};
  if (text == "cancel") return Hold{Hold::Way::Cancel};
  const std::string service = "service:", topic = "topic:";
  const bool is_service = starts_with(text, service), is_topic = starts_with(text, topic);
  const std::string name = text.substr(is_service ? service.size() : is_topic ? topic.size() : 0);
  if ((!is_service && !is_topic) || name.empty()) {
    return Problem{"'" + text + "' is no way to hold a robot",
                   "write cancel (the goal is canceled and sent again), service:NAME or topic:NAME "
                   "(which tell the robot), or nothing (the robot goes on)"};
  }
  const std::string usual = is_service ? "std_srvs/srv/SetBool" : "std_msgs/msg/Bool";
  auto found = flag_type(type.empty() ? usual : type, is_service ? "srv" : "msg");
  if (!found) return found.problem();
  return Hold{is_service ? Hold::Way::Service : Hold::Way::Topic, name, *found};
}

std::shared_ptr<HoldSignal> make_hold_signal(const Hold& hold) {
  if (hold.way == Hold::Way::Topic) return std::make_shared<HoldTopic>(hold);
  if (hold.way != Hold::Way::Service) return nullptr;
  return std::make_shared<HoldService>(hold);
}

}  // namespace ros2
