// Round-robin budget for pairs of meshes whose contacts together would cost more than a step may: a pair over budget
// waits for a later step, first come, first served; a pair that was served goes to the end of the queue. One world's
// physics thread; allocates only while the number of pairs grows. Private to physics/meshes/.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "physics/meshes/detail/constants.h"

namespace ambf::physics::detail {

class ContactBudget {
 public:
  void begin_step();
  // Each pair asks in each step. `ticket`: its place in the queue; `cost`: of its last update, 0: it had none.
  bool must_wait(std::uint64_t ticket, std::size_t cost);
  // The pair was updated at this cost. Returns its new ticket.
  std::uint64_t charge(std::size_t cost);
  std::uint64_t first_ticket() { return next_ticket_++; }

  // There are so many new pairs that each should cost less than it would like to.
  bool hurried() const { return spent_ > kStepBudget; }
  std::size_t interval() const { return interval_; }  // about how many steps are between two updates of a pair
  // Whether a pair had to wait since the last call: then it must be updated although nothing may have moved.
  bool take_postponed() { return std::exchange(postponed_, false); }
  // Steps so far in which pairs were updated so rarely that users may want to know.
  std::uint64_t overloaded_steps() const { return overloaded_steps_; }
  void restart();  // as if new; overloaded steps stay counted

 private:
  struct Waiting {
    std::uint64_t ticket;
    std::size_t cost;
  };
  static constexpr std::uint64_t kAll = ~std::uint64_t{0};

  std::vector<Waiting> queue_;  // pairs that asked in this step, except the cheap
  std::size_t cheap_ = 0;       // cost of the cheap ones together
  std::size_t spent_ = 0;       // in this step
  std::size_t reserve_ = kBudgetReserve;
  std::uint64_t next_ticket_ = 0;
  std::uint64_t last_served_ = kAll;  // ticket
  bool cheap_wait_ = false;
  std::size_t interval_ = 1;
  bool postponed_ = false, overloaded_ = false;
  std::uint64_t overloaded_steps_ = 0;
};

}  // namespace ambf::physics::detail
