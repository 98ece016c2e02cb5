#include "physics/meshes/detail/turns.h"

#include <algorithm>

namespace ambf::physics::detail {

namespace {

constexpr std::size_t kNew = Turns::kMostWork / 8;  // what a first look may cost
constexpr std::size_t kUnnoticed = 4;               // steps between two looks that nobody is told of

}  // namespace

// Decides from what was asked for in the last step who is served in this one.
void Turns::begin_step() {
  if (overloaded_) ++overloads_;
  overloaded_ = false;
  std::size_t total = cheap_wait_ ? 0 : cheap_;  // those that wait are in the queue
  for (const Waiting& waiting : queue_) total += waiting.cost;
  interval_ = total / kMostWork + 1;
  last_served_ = kAll;
  if (total > kMostWork) {
    std::sort(queue_.begin(), queue_.end(), [](const Waiting& a, const Waiting& b) { return a.ticket < b.ticket; });
    std::size_t sum = cheap_wait_ ? 0 : cheap_;
    for (const Waiting& waiting : queue_) {
      sum += waiting.cost;
      if (sum > kMostWork && last_served_ != kAll) break;
      last_served_ = waiting.ticket;
    }
  }
  cheap_wait_ = cheap_ > kMostWork / 2;
  queue_.clear();
  const std::size_t beyond = spent_ > kMostWork ? spent_ - kMostWork : 0;
  saving_ -= std::min(saving_, beyond);
  if (beyond == 0) saving_ = std::min(saving_ + kMostWork / 10, kSaving);
  cheap_ = spent_ = 0;
}

bool Turns::must_wait(std::uint64_t ticket, std::size_t cost) {
  const bool is_new = cost == 0, cheap = !is_new && cost <= kCheap;
  if (cheap && !cheap_wait_) return false;
  const bool wait =
      is_new ? spent_ > (saving_ > 0 ? kMostNewWork : kMostWork) : ticket > last_served_ || spent_ > kMostWork;
  if (!wait) return false;
  queue_.push_back({ticket, is_new ? kNew : cost});
  if (cheap) cheap_ += cost;
  overloaded_ = overloaded_ || interval_ > kUnnoticed;
  return postponed_ = true;
}

std::uint64_t Turns::served(std::size_t cost) {
  const std::uint64_t ticket = next_++;
  spent_ += cost;
  if (cost <= kCheap) cheap_ += cost;
  if (cost > kCheap || cheap_wait_) queue_.push_back({ticket, cost});
  return ticket;
}

void Turns::restart() {
  queue_.clear();
  cheap_ = spent_ = 0;
  saving_ = kSaving;
  next_ = 0;
  last_served_ = kAll;
  cheap_wait_ = postponed_ = overloaded_ = false;
  interval_ = 1;
}

}  // namespace ambf::physics::detail
