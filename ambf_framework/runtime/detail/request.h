// What other threads ask of the physics thread: one object a request, made and destroyed off the physics thread.
#pragma once

#include <memory>

namespace ambf::runtime {

class RequestScope;  // request_scope.h: what a request may do

enum class Progress { done, again };

class Request {
 public:
  virtual ~Request() = default;
  // Physics thread, at the beginning of an iteration, in every mode; called again each iteration until it returns done.
  // Must not block, and allocates only where the design exempts it (structural swap, snapshot, restore).
  virtual Progress run(RequestScope& scope) = 0;
  // Whether it runs steps: such requests are served one after the other.
  virtual bool takes_steps() const { return false; }
  // Whether the loader made it: then it gets a place however many requests are in flight.
  virtual bool from_loader() const { return false; }
  // Physics thread, once the frame that shows the effect is published. For what somebody waits for at this very moment:
  // a thread less to be woken on the way. Must not block, allocate or free. Returns whether that was the answer: then
  // nobody waits for answer(true).
  virtual bool shown() { return false; }
  // Answering thread, once the frame that shows the effect is published, or with ran = false when the simulation
  // stopped before. May block. The request is destroyed after it.
  virtual void answer(bool ran) = 0;
};

using RequestPtr = std::unique_ptr<Request>;

}  // namespace ambf::runtime
