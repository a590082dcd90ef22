// A leaf whose activation is one call of a service.
#pragma once

#include <memory>
#include <string>

#include "leaf_base.hpp"
#include "service_client.hpp"

namespace ros2 {

class CallingLeaf : public LeafBase {
 public:
  void halt() {
    Middleware::get().post([client = client_, it = activation_] { client->forget(it); });
  }

 protected:
  CallingLeaf(const lockstep_host& host, const lockstep_caller* caller, const ServiceType& type,
              const std::string& service)
      : LeafBase(host, caller),
        type_(type),
        service_(service),
        client_(std::make_shared<ServiceClient>(type, service)) {
    Middleware::get().post([client = client_] {
      client->open();
      Middleware::get().add(client);
    });
  }
  ~CallingLeaf() {
    Middleware::get().post(
        [client = std::move(client_)] { Middleware::get().remove(client.get()); });
  }

  std::shared_ptr<Message> make_request() const {
    return std::make_shared<Message>(*type_.request_message);
  }
  void call(std::shared_ptr<Message> request, double timeout) {
    const ServiceClient::Call call{++activation_, std::move(request), timeout};
    Middleware::get().post([client = client_, call] { client->send(call); });
  }
  ServiceClient::Outcome outcome() {
    log_lines(*client_);
    return client_->outcome(activation_);
  }
  // The call is open.
  lockstep_status waits() {
    const bool is_sent = client_->is_sent(activation_);
    return LeafBase::waits(is_sent ? 1 : 0, [&] {
      return (is_sent ? "waits for the response of '" : "waits for the service '") + service_ + "'";
    });
  }
  const Message& response() const { return client_->response(); }

 private:
  const ServiceType& type_;
  const std::string service_;
  std::shared_ptr<ServiceClient> client_;
  std::uint64_t activation_ = 0;
};

}  // namespace ros2
