#include "service_client.hpp"

#include <rcl/error_handling.h>
#include <rcl/graph.h>

namespace ros2 {

ServiceClient::ServiceClient(const ServiceType& type, std::string service)
    : type_(type),
      service_(std::move(service)),
      client_(rcl_get_zero_initialized_client()),
      response_(std::make_unique<Message>(*type.response_message)),
      next_response_(std::make_unique<Message>(*type.response_message)) {}

ServiceClient::~ServiceClient() {
  if (is_made_ && rcl_client_fini(&client_, &Middleware::get().node()) != RCL_RET_OK) {
    rcl_reset_error();
  }
}

ServiceClient::Outcome ServiceClient::outcome(std::uint64_t activation) const {
  const std::uint64_t ended = ended_.load(std::memory_order_acquire);
  return ended >> 8 == activation ? static_cast<Outcome>(ended & 0xff) : Outcome::Open;
}

void ServiceClient::open() {
  const rcl_client_options_t options = rcl_client_get_default_options();
  is_made_ = rcl_client_init(&client_, &Middleware::get().node(), type_.support, service_.c_str(),
                             &options) == RCL_RET_OK;
  if (!is_made_) why_not_made_ = last_ros_error();
}

void ServiceClient::send(Call call) {
  call_ = std::move(call);
  is_open_ = true;
  is_sent_ = false;
  deadline_ = Clock::now() + lockstep::bounded(std::chrono::duration<double>(call_.timeout));
  if (!is_made_) {
    lines_.add("there is no client of '" + service_ + "': " + why_not_made_);
    return end(Outcome::Failed);
  }
  poll(Clock::now());
}

void ServiceClient::forget(std::uint64_t activation) {
  if (is_open_ && call_.activation == activation) end(Outcome::NoAnswer);
}

void ServiceClient::end(Outcome outcome) {
  is_open_ = false;
  ended_.store(call_.activation << 8 | static_cast<std::uint64_t>(outcome),
               std::memory_order_release);
  call_.request.reset();
}

bool ServiceClient::has_service() {
  bool is_there = false;
  if (rcl_service_server_is_available(&Middleware::get().node(), &client_, &is_there) !=
      RCL_RET_OK) {
    rcl_reset_error();
  }
  return is_there;
}

Ids ServiceClient::servers() {
  if (!has_service()) return {};
  Ids ids = servers_of(rcl_client_get_service_name(&client_));
  if (ids.empty()) ids.emplace();  // of a middleware that does not tell
  return ids;
}

bool ServiceClient::poll(Clock::time_point now) {
  if (!is_open_) return false;
  if (!is_sent_ && has_service()) {
    is_sent_ = true;
    sent_ = call_.activation;
    if (rcl_send_request(&client_, call_.request->get(), &number_) != RCL_RET_OK) {
      lines_.add("the request could not be sent: " + last_ros_error());
      end(Outcome::Failed);
    }
  } else if (now >= deadline_) {
    const std::string others = is_sent_ || has_told_ ? "" : other_services(service_, type_.name);
    has_told_ |= !others.empty();
    if (!others.empty()) lines_.add(others);
    end(is_sent_ ? Outcome::NoAnswer : Outcome::NoService);
  }
  return is_open_;
}

void ServiceClient::add_sizes(Sizes& sizes) const {
  if (is_made_) ++sizes.clients;
}

void ServiceClient::add_to(rcl_wait_set_t& set) {
  if (is_made_ && rcl_wait_set_add_client(&set, &client_, nullptr) != RCL_RET_OK) {
    rcl_reset_error();
  }
}

void ServiceClient::take(const rcl_wait_set_t& /*set*/) {
  while (is_made_) {
    rmw_request_id_t id{};
    next_response_->reset();
    if (rcl_take_response(&client_, &id, next_response_->get()) != RCL_RET_OK) break;
    if (!is_open_ || !is_sent_ || id.sequence_number != number_) continue;
    std::swap(response_, next_response_);
    end(Outcome::Answered);
  }
  rcl_reset_error();
}

const char* words_of(ServiceClient::Outcome outcome) {
  switch (outcome) {
    case ServiceClient::Outcome::NoService:
      return "no service";
    case ServiceClient::Outcome::NoAnswer:
      return "no answer";
    default:
      return "not sent";
  }
}

}  // namespace ros2
