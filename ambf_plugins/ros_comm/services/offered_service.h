// A service that the node registers again with a new master. A request is deserialized only when it has the bytes that
// it claims, and handled only while the gate is open; else ROS answers with a failure. Throws when ROS does not accept
// the name. Private to ros_comm. C++17.
#pragma once

#include <ros/ros.h>

#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "ros_comm/message_lengths.h"
#include "ros_comm/node.h"
#include "ros_comm/services/gate.h"

namespace ambf::ros_comm {

// Of any type, for lists of them.
class Offered {
 public:
  virtual ~Offered() = default;
};

// Handlers run on the node's service threads. The owner closes the gate before what they use goes.
template <class Service>
class OfferedService final : public Offered {
 public:
  using Request = typename Service::Request;
  using Response = typename Service::Response;
  using Handler = std::function<bool(Request&, Response&)>;

  OfferedService(Node& node, const std::string& name, const std::shared_ptr<Gate>& gate, Handler handler)
      : registered_(node, {Registration::Kind::service, name, {}}) {
    const auto answer_one = [gate, handler = std::move(handler)](Request& request, Response& response) {
      const Gate::Pass pass(*gate);
      return pass && handler(request, response);
    };
    ros::AdvertiseServiceOptions options;
    options.init<Request, Response>(name, answer_one);
    options.helper = boost::make_shared<Helper>(
        gate, answer_one, [&node, name](const std::string& why) { node.traffic().refuse(name, why); });
    options.callback_queue = &node.services();
    server_ = node.handle().advertiseService(options);
    if (!server_) throw std::runtime_error("ROS does not take the service " + name);
  }
  ~OfferedService() override { server_.shutdown(); }
  OfferedService(const OfferedService&) = delete;
  OfferedService& operator=(const OfferedService&) = delete;

 private:
  using Spec = ros::ServiceSpec<Request, Response>;

  class Helper final : public ros::ServiceCallbackHelperT<Spec> {
   public:
    using Refused = std::function<void(const std::string& why)>;
    Helper(std::shared_ptr<Gate> gate, typename Spec::CallbackType callback, Refused refused)
        : ros::ServiceCallbackHelperT<Spec>(callback), gate_(std::move(gate)), refused_(std::move(refused)) {}

    bool call(ros::ServiceCallbackHelperCallParams& params) override {
      const ros::SerializedMessage& request = params.request;
      const auto before = static_cast<std::size_t>(request.message_start - request.buf.get());
      const std::string problem = problem_of_lengths<Request>(request.message_start, request.num_bytes - before);
      if (problem.empty()) return ros::ServiceCallbackHelperT<Spec>::call(params);
      const Gate::Pass pass(*gate_);
      if (pass) refused_("malformed request from " + sender_in(params.connection_header) + ": " + problem);
      return false;
    }

   private:
    const std::shared_ptr<Gate> gate_;
    const Refused refused_;
  };

  const Registered registered_;
  ros::ServiceServer server_;
};

}  // namespace ambf::ros_comm
