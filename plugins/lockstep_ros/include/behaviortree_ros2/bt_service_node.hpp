// A call of a service of ROS 2 as a node: derive from RosServiceNode<ServiceT>, and write
// setRequest and onResponseReceived.
#pragma once

#include "behaviortree_ros2/lockstep/ros_work.hpp"

namespace BT {

enum ServiceNodeErrorCode {
  SERVICE_UNREACHABLE,
  SERVICE_TIMEOUT,
  INVALID_REQUEST,
  SERVICE_ABORTED
};

inline const char* toStr(const ServiceNodeErrorCode& code) {
  switch (code) {
    case SERVICE_UNREACHABLE:
      return "SERVICE_UNREACHABLE";
    case SERVICE_TIMEOUT:
      return "SERVICE_TIMEOUT";
    case INVALID_REQUEST:
      return "INVALID_REQUEST";
    case SERVICE_ABORTED:
      return "SERVICE_ABORTED";
  }
  return "";
}

template <class ServiceT>
class RosServiceNode
    : public lockstep_detail::RosNode<ActionNodeBase, lockstep_detail::ServiceName> {
 public:
  using ServiceType = ServiceT;
  using ServiceClient = rclcpp::Client<ServiceT>;
  using Request = typename ServiceT::Request;
  using Response = typename ServiceT::Response;

  RosServiceNode(const std::string& name, const NodeConfig& config, const RosNodeParams& params)
      : RosNode(name, config, params) {
    if (lockstep_has_name()) lockstep_open();
  }

  // False: the node fails with INVALID_REQUEST.
  virtual bool setRequest(typename Request::SharedPtr& request) = 0;
  virtual NodeStatus onResponseReceived(const typename Response::SharedPtr& response) = 0;
  virtual NodeStatus onFailure(ServiceNodeErrorCode /*code*/) { return NodeStatus::FAILURE; }

  // For lockstep: why it has failed, or what it waits for. A class may have its own.
  const std::string& reason() const { return lockstep_reason_; }

  void halt() override {
    lockstep_end();
    resetStatus();
  }
  NodeStatus tick() override {
    lockstep_work_.spin();
    if (lockstep_phase_ == Phase::Idle) {
      lockstep_open();
      lockstep_request_ = std::make_shared<Request>();
      if (!setRequest(lockstep_request_)) return lockstep_failed(INVALID_REQUEST);
      lockstep_phase_ = Phase::WaitsForServer;
      lockstep_say("waits for the service ");
      lockstep_work_.begin_wait(lockstep_work_.params().wait_for_server_timeout);
    }
    return lockstep_advance();
  }

 protected:
  std::string getServiceName() const { return lockstep_name_; }

 private:
  enum class Phase { Idle, WaitsForServer, IsSent };

  void lockstep_open() {
    if (!lockstep_takes_name()) return;
    lockstep_client_ = lockstep_work_.node()->template create_client<ServiceT>(
        lockstep_name_, rmw_qos_profile_services_default, lockstep_work_.group());
  }

  NodeStatus lockstep_advance() {
    if (lockstep_phase_ == Phase::WaitsForServer) {
      if (lockstep_client_->service_is_ready()) {
        lockstep_send();
      } else if (lockstep_work_.has_waited_long()) {
        return lockstep_failed(SERVICE_UNREACHABLE);
      }
      return NodeStatus::RUNNING;
    }
    if (lockstep_response_ != nullptr) {
      const auto response = lockstep_response_;
      lockstep_end();
      lockstep_reason_.clear();
      return lockstep_detail::completed(onResponseReceived(response), "onResponseReceived");
    }
    return lockstep_work_.has_waited_long() ? lockstep_failed(SERVICE_TIMEOUT)
                                            : NodeStatus::RUNNING;
  }

  void lockstep_send() {
    const unsigned sent = ++lockstep_sent_;
    lockstep_phase_ = Phase::IsSent;
    lockstep_say("waits for the response of ");
    lockstep_work_.begin_wait(lockstep_work_.params().server_timeout);
    lockstep_client_->async_send_request(lockstep_request_,
                                         [this, sent](typename ServiceClient::SharedFuture answer) {
                                           if (sent == lockstep_sent_)
                                             lockstep_response_ = answer.get();
                                         });
  }

  NodeStatus lockstep_failed(ServiceNodeErrorCode code) {
    lockstep_end();
    lockstep_say("the service ", ": ");
    lockstep_reason_ += toStr(code);
    return lockstep_detail::completed(onFailure(code), "onFailure");
  }

  void lockstep_end() {
    ++lockstep_sent_;
    lockstep_phase_ = Phase::Idle;
    lockstep_response_.reset();
  }

  typename ServiceClient::SharedPtr lockstep_client_;
  typename Request::SharedPtr lockstep_request_;
  typename Response::SharedPtr lockstep_response_;
  Phase lockstep_phase_ = Phase::Idle;
  unsigned lockstep_sent_ = 0;
};

}  // namespace BT
