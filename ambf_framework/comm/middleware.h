// What comm needs from a middleware (ROS 1 is built in, others can follow): endpoints that publish an object's state and pass its
// commands on. A middleware never sees the physics; it reads frames and writes through abilities (state/abilities/). C++17.
#pragma once

#include <memory>
#include <string>

#include "state/frame.h"
#include "state/structure.h"

namespace ambf::comm {

// The State/Command pair of one object or of the world. Destruction closes it: its topics disappear.
class Endpoint {
 public:
  virtual ~Endpoint() = default;
  // Whether anybody listens. Called for each frame on the publisher thread: must not lock or search.
  virtual bool has_subscribers() const = 0;
  // Publishes the object's part of `frame`; `slot` is its index in the frame's array of its kind (ignored by the world). Publisher thread.
  virtual void publish(const state::Frame& frame, std::uint32_t slot) = 0;
  // Called for each frame, whether or not anybody listens, for watchdogs; `active`: a command is in force. Publisher thread; must be cheap.
  virtual void watch(const state::Frame& frame, bool active) = 0;
};

class Middleware {
 public:
  virtual ~Middleware() = default;

  // Decides under which address (for ROS: topic) an object is offered; no two objects share one until release(). Called in the order in
  // which objects were loaded, so that the same scene always gets the same addresses. Publisher thread.
  virtual std::string reserve(const state::ObjectInfo& object) = 0;
  virtual void release(const std::string& address) = 0;

  // Opens an object's endpoint (the world's with its services) at the address reserved for it. Several advertising threads at once; may
  // take long. The world is opened before all others. Null when it cannot be had now: asked again later.
  virtual std::unique_ptr<Endpoint> open(const state::ObjectInfo& object, const std::string& address) = 0;

  // True while endpoints can be opened (for ROS: a master is there). Polled by the advertising threads; must be quick.
  virtual bool available() const = 0;
};

}  // namespace ambf::comm
