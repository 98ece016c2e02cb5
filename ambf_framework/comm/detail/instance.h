// The comm instance of one object or of the world: what the publisher and the advertising threads share of it. Private
// to comm. C++17.
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "comm/middleware.h"
#include "comm/publish_rate.h"
#include "state/kind_rows.h"

namespace ambf::comm {

struct Instance {
  Instance(std::optional<state::ObjectInfo> object_in, std::string address_in, PublishRate rate_in)
      : object(std::move(object_in)), address(std::move(address_in)), rate(rate_in) {}

  bool is_world() const { return !object; }
  // Whether a command is in force. Publisher thread.
  bool active(const state::Frame& frame) const {
    return is_world() ? frame.run.throttled : state::rows_of(object->kind).active(frame, slot);
  }
  std::unique_ptr<Endpoint> open(Middleware& middleware) const {
    return is_world() ? middleware.open_world(address) : middleware.open(*object, address);
  }
  // The endpoint once it is open, else null. Publisher thread.
  Endpoint* open_endpoint() const { return ready.load(std::memory_order_acquire) ? endpoint.get() : nullptr; }

  const std::optional<state::ObjectInfo> object;  // none: the world
  const std::string address;

  PublishRate rate;                   // publisher thread only
  std::uint32_t slot = state::kNone;  // publisher thread only: index in the present structure's array

  enum class Stage {
    waiting,
    opening,
    open,
    closing,
    closed
  } stage = Stage::waiting;            // guarded by the Advertiser's mutex
  bool gone = false;                   // likewise: to be closed
  std::unique_ptr<Endpoint> endpoint;  // set by the thread that opens it, before `ready`
  std::atomic<bool> ready{false};
};
using InstancePtr = std::shared_ptr<Instance>;

}  // namespace ambf::comm
