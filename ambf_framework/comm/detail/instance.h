// One object's comm instance: what the publisher and the advertising threads share of it. Private to comm. C++17.
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <utility>

#include "comm/middleware.h"
#include "comm/publish_rate.h"

namespace ambf::comm {

struct Instance {
  Instance(state::ObjectInfo object_in, std::string address_in, const RateOverride& rates)
      : object(std::move(object_in)),
        address(std::move(address_in)),
        rate(object.rate_low_hz, object.rate_high_hz, rates) {}

  bool is_world() const { return object.kind == state::ObjectKind::world; }
  // The endpoint once it is open, else null. Publisher thread.
  Endpoint* open_endpoint() const { return ready.load(std::memory_order_acquire) ? endpoint.get() : nullptr; }

  const state::ObjectInfo object;
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
