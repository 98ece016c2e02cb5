// Where hundreds of moving bodies are at one place, each near all others, the pairs of the crowd that are met are
// bounded: otherwise memory and time grow with the square of their number (1000 boxes: 3.6 GB, minutes a step). Each
// body then pushes itself free of a few others first, and meets the next ones as these leave. Pairs with a static body,
// and with one that is near few others, are always met; so are pairs that were met in the step before. Scenes without a
// crowd pay one comparison a step, and their contacts are those without it. Physics thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "physics/detail/body_data.h"

namespace ambf::physics::detail {

class CrowdLimit {
 public:
  // Once bounding boxes and pairs are those of this step.
  void begin_step(btOverlappingPairCache& cache, int moving_bodies);
  // Whether the n-th pair of the cache may be met in this step.
  bool admits(int pair) const { return !crowded_ || admitted_[static_cast<std::size_t>(pair)] != 0; }

  // Of the last step in which pairs were left out: the body that was near most others, and how many.
  struct Crowd {
    const BodyData* body = nullptr;  // null: there was none, or it is gone
    std::size_t near_bodies = 0;
    std::uint64_t steps = 0;  // so far in which pairs were left out
  };
  const Crowd& crowd() const { return crowd_; }
  void forget(const BodyData& body) {
    if (crowd_.body == &body) crowd_.body = nullptr;
  }

 private:
  bool crowded_ = false;
  std::vector<std::uint8_t> admitted_;  // by pair, while crowded_
  Crowd crowd_;
};

}  // namespace ambf::physics::detail
