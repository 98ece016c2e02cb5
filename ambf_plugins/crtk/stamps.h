// What clients call time: the system's clock, or simulated time. C++17.
#pragma once

#include <atomic>
#include <cstdint>

#include "state/frame.h"

namespace ambf::crtk {

class Stamps {
 public:
  explicit Stamps(bool simulated) : simulated_(simulated) {}

  bool simulated() const { return simulated_; }
  // Of a frame, ns. Simulated time never goes back: after a reset of the world it goes on from where it was. One
  // thread.
  std::int64_t of(const state::Frame& frame);
  // Of what happens now. Any thread.
  std::int64_t now() const;

 private:
  const bool simulated_;
  std::uint64_t epoch_ = 0;
  std::int64_t offset_ns_ = 0;  // the reader's own, as is epoch_
  std::atomic<std::int64_t> newest_ns_{0};
};

}  // namespace ambf::crtk
