// The interface between comm and a middleware (ROS 1 is built in, others can follow): endpoints publish an object's
// state and forward its commands. A middleware decides by kind what it offers; comm itself names no kind. It reads
// frames and writes through abilities (state/abilities/), and never sees the physics. C++17.
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
  // Whether there are subscribers. Called for each frame on the publisher thread: must not lock or search.
  virtual bool has_subscribers() const = 0;
  // Publishes the object's part of `frame`; `slot` is its index in the frame's array of its kind (ignored by the
  // world). Publisher thread.
  virtual void publish(const state::Frame& frame, std::uint32_t slot) = 0;
  // Called for each frame, with or without subscribers, for watchdogs; `active`: a command is in force. Publisher
  // thread; must be cheap.
  virtual void watch(const state::Frame& frame, bool active) = 0;
  // 0: publish() is due at the object's rates. Else: for each step whose number is a multiple of this, because a
  // recorder requested it. Publisher thread; must be cheap.
  virtual std::uint32_t step_interval() const { return 0; }
  // Whether someone subscribed since the last publish(). Publisher thread.
  virtual bool has_newcomers() const { return false; }
};

class Middleware {
 public:
  virtual ~Middleware() = default;

  // Whether objects of this object's kind have endpoints here. Publisher thread.
  virtual bool serves(const state::ObjectInfo& object) const = 0;

  // Chooses the address (for ROS: topic) for an object's name; no two objects share one until release(). Called in the
  // order in which objects were loaded, so that the same scene always gets the same addresses. Publisher thread.
  virtual std::string reserve(const std::string& name) = 0;
  virtual void release(const std::string& address) = 0;

  // Opens the endpoint of an object, or of the world with its services, at the reserved address. Several advertising
  // threads at once; may take long. The world is opened before all objects. Null when it cannot be opened now: comm
  // tries again later.
  virtual std::unique_ptr<Endpoint> open(const state::ObjectInfo& object, const std::string& address) = 0;
  virtual std::unique_ptr<Endpoint> open_world(const std::string& address) = 0;

  // True while endpoints can be opened (for ROS: a master is there). Polled by the advertising threads; must be quick.
  virtual bool available() const = 0;

  // Whether the step_interval() of any endpoint is not 0. Called once in each iteration of the publisher thread: what
  // the call before returned is in force by then. Must be quick.
  virtual bool steps_wanted() { return false; }
  // Whether recorders have room for one more step; asked only where the simulation can wait for them.
  virtual bool room_for_step() { return true; }
  // A step was published to those that want it.
  virtual void step_published(const state::Frame&) {}
};

}  // namespace ambf::comm
