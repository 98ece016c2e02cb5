// The laws that hold bodies, and what each source did to each body in the last step. Rows of a body are chained in the
// order of their sources. Physics thread; allocates in reserve() only. For use inside model/ only.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "math/types.h"
#include "model/law.h"
#include "state/ids.h"

namespace ambf::model {

struct LiveBody;

// Where a body's shares of a step begin; a member of LiveBody.
struct SharesOfBody {
  std::uint64_t step = 0;  // of Laws; of another one: there are none
  std::uint32_t first = state::kNone;
};

class Laws {
 public:
  // After a swap: makes room for one law and one share of each body, and base::kSpareLaws more. Loses nothing.
  void reserve(std::size_t bodies);

  // One law for each (body, source): a new one replaces the old one. False: there is no room.
  bool hold(LiveBody& body, state::Source source, Law& law);
  void let_go(const LiveBody& body, state::Source source);
  void end_of(const LiveBody& body);  // it leaves the world

  // All laws act on their bodies, in the order in which they were first held.
  using Cut = std::function<void(LiveBody&, state::Source)>;
  void act(double h_s, const Cut& cut);
  // One law acts, within its CommandBound: `cut(body, source)` is called where that cuts. Frozen bodies feel none.
  void act(LiveBody& body, state::Source source, Law& law, double h_s, const Cut& cut);

  // Adds to the source's share; beyond the room it is only counted.
  void add_share(LiveBody& body, state::Source source, const math::Wrench& wrench_world);
  // Forgets all shares: a step begins, or there is no last one any more.
  void forget_shares();
  // visit(source, wrench) for each share of the body, by source.
  template <class Visit>
  void each_share(const SharesOfBody& body, Visit&& visit) const {
    if (body.step != step_) return;
    for (std::uint32_t row = body.first; row != state::kNone; row = rows_[row].next)
      visit(rows_[row].source, rows_[row].wrench_world);
  }
  std::uint32_t shares_without_room() const { return lost_; }

 private:
  struct Held {
    LiveBody* body;
    state::Source source;
    Law* law;
  };
  struct Row {
    state::Source source;
    math::Wrench wrench_world;
    std::uint32_t next;  // of the same body; kNone: the last one
  };

  std::vector<Held> held_;
  std::vector<Row> rows_;
  std::size_t room_ = 0;    // for each of both
  std::uint64_t step_ = 1;  // + 1 whenever shares are forgotten
  std::uint32_t lost_ = 0;  // shares without room
};

}  // namespace ambf::model
