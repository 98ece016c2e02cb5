// How roscpp calls a service of ours: only requests whose bytes fit their definition are read. Private to ros_comm.
// C++17.
#pragma once

#include <ros/service_callback_helper.h>

#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "ros_comm/message_lengths.h"
#include "ros_comm/node.h"
#include "ros_comm/services/gate.h"

namespace ambf::ros_comm {

// Deserializes only a request that has the bytes that it claims. A refused one is answered by ROS's failure.
template <class Service>
class CheckedService final
    : public ros::ServiceCallbackHelperT<ros::ServiceSpec<typename Service::Request, typename Service::Response>> {
 public:
  using Spec = ros::ServiceSpec<typename Service::Request, typename Service::Response>;
  using Refused = std::function<void(const std::string& why)>;
  CheckedService(std::shared_ptr<Gate> gate, typename Spec::CallbackType callback, Refused refused)
      : ros::ServiceCallbackHelperT<Spec>(callback), gate_(std::move(gate)), refused_(std::move(refused)) {}

  bool call(ros::ServiceCallbackHelperCallParams& params) override {
    const ros::SerializedMessage& request = params.request;
    const auto before = static_cast<std::size_t>(request.message_start - request.buf.get());
    const std::string problem =
        problem_of_lengths<typename Service::Request>(request.message_start, request.num_bytes - before);
    if (problem.empty()) return ros::ServiceCallbackHelperT<Spec>::call(params);
    const Gate::Pass pass(*gate_);
    if (pass) refused_("malformed request from " + sender_in(params.connection_header) + ": " + problem);
    return false;
  }

 private:
  const std::shared_ptr<Gate> gate_;
  const Refused refused_;
};

}  // namespace ambf::ros_comm
