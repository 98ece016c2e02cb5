#include "physics/meshes/detail/contact_budget.h"

#include <algorithm>

namespace ambf::physics::detail {

// Decides from what pairs asked for in the last step which of them are served in this one.
void ContactBudget::begin_step() {
  if (overloaded_) ++overloaded_steps_;
  overloaded_ = false;
  std::size_t total = cheap_wait_ ? 0 : cheap_;  // cheap ones that wait are in the queue
  for (const Waiting& waiting : queue_) total += waiting.cost;
  interval_ = total / kStepBudget + 1;
  last_served_ = kAll;
  if (total > kStepBudget) {
    std::sort(queue_.begin(), queue_.end(), [](const Waiting& a, const Waiting& b) { return a.ticket < b.ticket; });
    std::size_t sum = cheap_wait_ ? 0 : cheap_;
    for (const Waiting& waiting : queue_) {
      sum += waiting.cost;
      if (sum > kStepBudget && last_served_ != kAll) break;
      last_served_ = waiting.ticket;
    }
  }
  cheap_wait_ = cheap_ > kStepBudget / 2;
  queue_.clear();
  const std::size_t excess = spent_ > kStepBudget ? spent_ - kStepBudget : 0;
  reserve_ -= std::min(reserve_, excess);
  if (excess == 0) reserve_ = std::min(reserve_ + kStepBudget / 10, kBudgetReserve);
  cheap_ = spent_ = 0;
}

bool ContactBudget::must_wait(std::uint64_t ticket, std::size_t cost) {
  const bool is_new = cost == 0, cheap = !is_new && cost <= kCheapCost;
  if (cheap && !cheap_wait_) return false;
  const bool wait =
      is_new ? spent_ > (reserve_ > 0 ? kNewPairBudget : kStepBudget) : ticket > last_served_ || spent_ > kStepBudget;
  if (!wait) return false;
  queue_.push_back({ticket, is_new ? kNewPairCost : cost});
  if (cheap) cheap_ += cost;
  overloaded_ = overloaded_ || interval_ > kMaxUnreportedInterval;
  return postponed_ = true;
}

std::uint64_t ContactBudget::charge(std::size_t cost) {
  const std::uint64_t ticket = next_ticket_++;
  spent_ += cost;
  if (cost <= kCheapCost) cheap_ += cost;
  if (cost > kCheapCost || cheap_wait_) queue_.push_back({ticket, cost});
  return ticket;
}

void ContactBudget::restart() {
  queue_.clear();
  cheap_ = spent_ = 0;
  reserve_ = kBudgetReserve;
  next_ticket_ = 0;
  last_served_ = kAll;
  cheap_wait_ = postponed_ = overloaded_ = false;
  interval_ = 1;
}

}  // namespace ambf::physics::detail
