// The bodies that input devices hold: takes set-points, shares axes between devices (EQUATIONS 7), keeps the sum of all
// gains on a body stable, has each law act, and moves the jaws. Physics thread; allocates nothing, snapshots excepted.
// For use inside model/ only.
//
// A reset or a restore moves bodies away from their references, so it ends what holds them (a restore brings back what
// was saved); a device holds them again with set-points of the new epoch. Frozen bodies are held by nobody.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "model/detail/live_objects.h"
#include "model/effectors/effector_law.h"
#include "model/effectors/effector_table.h"
#include "model/effectors/saved_effectors.h"
#include "state/frame.h"

namespace ambf::inputs {
class Channel;  // inputs/recorder.h
}

namespace ambf::model {

struct LiveEffector {
  LiveBody* body = nullptr;
  SavedEffector is;  // all that a snapshot keeps
  EffectorLaw law;
  double since_s = 0.0;    // watchdog's clock at its last set-point
  int slot = -1;           // of the table; -1: a snapshot brought it
  std::uint64_t hold = 0;  // of that slot
  bool waiting = false;    // no step has obeyed its newest set-point yet
  std::int64_t applied_ns = 0;
  std::uint32_t first_step = 0;
};

class LiveEffectors {
 public:
  LiveEffectors(LiveTables& tables, double watchdog_s);
  EffectorTable& table() { return table_; }
  void record_to(inputs::Channel* channel) { record_ = channel; }

  // Once an iteration, before its steps: newest set-points. `steps` of h_s will follow, in which references move.
  // True when a frame would show a difference.
  bool take(const state::Structure& structure, std::uint64_t epoch, double watchdog_s, std::uint64_t steps, double h_s);
  // Before each step: ends those that let go or fell silent.
  bool end_silent(double watchdog_s);

  // Each step, before commands act: references move, gains are cut to what is stable together with the body's
  // controller (LiveBody::gain_scale), jaws are commanded. `cut(body)` is called for each body whose gains are cut.
  template <class Cut>
  void prepare(const state::Structure& structure, std::uint32_t step, double h_s, Cut&& cut) {
    each_body([&](std::span<LiveEffector> of_body) {
      advance(of_body);
      share_axes(of_body);
      if (bound_gains(of_body, h_s)) cut(*of_body.front().body);
      drive_jaw(structure, of_body);
    });
    obey_waiting(step);
  }
  // visit(effector) of those that may exert something, by body and source.
  template <class Visit>
  void each_pulling(Visit&& visit) {
    for (LiveEffector& effector : held_)
      if (effector.is.set_point.pulls) visit(effector);
  }

  void end_of(const LiveBody& body);
  void end_all();
  void fill(std::vector<state::EffectorState>& rows) const;

  std::vector<SavedEffector> save() const;
  void restore(const std::vector<SavedEffector>& saved, const state::Structure& structure);

 private:
  template <class Visit>
  void each_body(Visit&& visit) {
    for (std::size_t first = 0, last = 0; first < held_.size(); first = last) {
      while (last < held_.size() && held_[last].body == held_[first].body) ++last;
      visit(std::span(held_).subspan(first, last - first));
    }
  }
  // visit(joint) of the joints that open and close with the jaw of a body.
  template <class Visit>
  void each_jaw_joint(const state::Structure& structure, const LiveBody& body, Visit&& visit) const {
    for (const std::uint32_t number : structure.bodies[body.body->user_index()].joints) {
      LiveJoint& live = tables_.joints()[number];
      const auto& limits = live.joint->limits();
      if (live.joint->has_coordinate() && limits && (*limits)[1] > (*limits)[0] && !live.joint->frozen()) visit(live);
    }
  }
  LiveEffector* find_or_make(const state::Structure& structure, const PostedSetPoint& posted);
  void accept(LiveEffector& effector, const state::SetPoint& set_point, std::uint64_t steps, double h_s);
  template <class Ends>
  bool end_if(Ends&& ends);
  static void advance(std::span<LiveEffector> of_body);
  static void share_axes(std::span<LiveEffector> of_body);
  static bool bound_gains(std::span<LiveEffector> of_body, double h_s);
  void obey_waiting(std::uint32_t step);

  // live_jaws.cpp
  void choose_leader(const state::Structure& structure, std::span<LiveEffector> of_body);
  void drive_jaw(const state::Structure& structure, std::span<LiveEffector> of_body);
  void command_jaw(const state::Structure& structure, const LiveBody& body, double opening);
  std::optional<double> opening(const state::Structure& structure, const LiveBody& body) const;
  bool taken_over(const state::Structure& structure, const LiveBody& body) const;

  LiveTables& tables_;
  EffectorTable table_;
  std::vector<LiveEffector> held_;  // by body and source; room for kMaxEffectors
  const double watchdog_s_;
  double watchdog_now_s_ = 0.0;
  inputs::Channel* record_ = nullptr;
};

}  // namespace ambf::model
