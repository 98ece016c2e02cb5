// Whose turn it is. Meetings of meshes that together would cost more than one step may, take turns: first come, first served, whoever was
// served goes to the end of the queue. A step's work is bounded, and everybody is served as often as that allows. Costs are in some
// 5 ns (up to 15 ns on slow or busy processors). One world's physics thread; allocates only while the number of meetings grows.
// Private to physics/.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace ambf::physics::detail {

class Turns {
 public:
  static constexpr std::size_t kMostWork = 32000;  // in one step; the last meeting may exceed it
  // Likewise, while there are new meetings, for bodies may be falling: as often as this saving lasts, which comes back by a tenth of
  // kMostWork a step.
  static constexpr std::size_t kMostNewWork = 5 * kMostWork, kSaving = 100 * kMostWork;
  static constexpr std::size_t kCheap = 200;  // meetings that never wait, unless they alone are too many

  void begin_step();
  // Each meeting asks in each step. `ticket`: its place in the queue; `cost`: of its last look, 0: it had none.
  bool must_wait(std::uint64_t ticket, std::size_t cost);
  // It has looked, at this cost. Returns its new ticket.
  std::uint64_t served(std::size_t cost);
  std::uint64_t first_ticket() { return next_++; }

  // There are so many new meetings that each should take less than it would like to.
  bool in_haste() const { return spent_ > kMostWork; }
  std::size_t interval() const { return interval_; }  // about how many steps are between two looks
  // Whether anybody had to wait since this was last asked: then the pair is to be looked at again, though nothing may have moved.
  bool take_postponed() { return std::exchange(postponed_, false); }
  // Steps, ever, in which meetings were looked at so rarely that users may want to know.
  std::uint64_t overloads() const { return overloads_; }
  void restart();  // as if new; overloads stay counted

 private:
  struct Waiting {
    std::uint64_t ticket;
    std::size_t cost;
  };
  std::vector<Waiting> queue_;  // who asked in this step, but for the cheap
  std::size_t cheap_ = 0;       // what those cost together
  std::size_t spent_ = 0;       // in this step
  std::size_t saving_ = kSaving;
  std::uint64_t next_ = 0;  // ticket
  std::uint64_t last_served_ = kAll;
  bool cheap_wait_ = false;
  std::size_t interval_ = 1;
  bool postponed_ = false, overloaded_ = false;
  std::uint64_t overloads_ = 0;
  static constexpr std::uint64_t kAll = ~std::uint64_t{0};
};

}  // namespace ambf::physics::detail
