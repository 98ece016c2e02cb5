// Adds the time of a scope to a sum, where asked to. Private to physics/joints/.
#pragma once

#include <chrono>
#include <cstdint>

namespace ambf::physics {

class Stopwatch {
 public:
  Stopwatch(bool on, std::uint64_t& sum) : sum_(on ? &sum : nullptr) {
    if (sum_) start_ = std::chrono::steady_clock::now();
  }
  ~Stopwatch() {
    if (!sum_) return;
    const auto elapsed = std::chrono::steady_clock::now() - start_;
    *sum_ += static_cast<std::uint64_t>(std::chrono::duration_cast<std::chrono::nanoseconds>(elapsed).count());
  }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  std::uint64_t* sum_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace ambf::physics
