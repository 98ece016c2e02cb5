// One arm: its control, its object in the simulation, its topics. C++17.
#pragma once

#include <atomic>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "adf/crtk_arms.h"
#include "base/log.h"
#include "comm/publish_rate.h"
#include "crtk/arm_commands.h"
#include "crtk/arm_control.h"
#include "crtk/arm_joints.h"
#include "crtk/endoscope_camera.h"
#include "crtk/motion_judge.h"
#include "crtk/stamps.h"
#include "state/abilities/abilities.h"

namespace ambf::crtk {

class ArmTopics;

class ServedArm {
 public:
  // `stamps` must outlive it.
  ServedArm(const adf::CrtkArm& arm, const state::Abilities& simulation, const Stamps& stamps, base::Log& log);
  ~ServedArm();
  ServedArm(const ServedArm&) = delete;
  ServedArm& operator=(const ServedArm&) = delete;

  // A frame newer than the last one, and its stamp. One thread.
  // `viewer`: the arm named in its description's `view`, updated with this frame already; null: none.
  void update(const state::Frame& frame, std::int64_t stamp_ns, const ServedArm* viewer);
  // Whether its joints have been found, but it has no topics yet. Any thread.
  bool wants_topics() const { return found_ && !open_; }
  // May take long; another thread than update(). Throws when ROS does not take a topic.
  void open(ros_comm::Node& node, const std::string& name_space);
  // Whether serve() has something to do. Any thread.
  bool has_work() const { return has_work_; }
  // Judges whether the model moves as described, and gives it the tool that a client has asked for, if one has. May
  // take a second; the thread of open().
  void serve(const std::atomic<bool>& stopping);
  void close();
  const std::string& name() const { return name_; }
  const std::string& view() const { return view_; }
  // Its base and its tip in its frame, for tf; nothing while they are not known. Any thread.
  struct Frames {
    std::string frame;
    math::Pose T_frame_base, T_frame_tip;
    std::int64_t stamp_ns = 0;
  };
  std::optional<Frames> frames();

 private:
  // The model that the arm is loaded as; written when requests are done, on other threads.
  struct Loaded {
    std::mutex mutex;
    bool pending = false;
    std::string model, problem;
  };

  std::optional<math::Pose> T_world_base(const state::Frame& frame) const;
  std::optional<math::Pose> T_world_view(const state::Frame& frame) const;
  void search(const state::Frame& frame);
  std::uint32_t find_object(const state::Structure& structure, std::uint32_t base);
  void load(const state::Structure& structure);
  Measured read(const state::Frame& frame, std::int64_t stamp_ns) const;
  void execute(const Act& act);
  void exchange(const std::atomic<bool>& stopping);
  void post();
  void turn_camera(const state::Frame& frame);
  void publish(const state::Frame& frame, std::int64_t now_ns);
  void announce(std::int64_t now_ns);
  bool must_wait(const Event& event, std::int64_t now_ns);

  const std::string name_, view_;
  const state::Abilities simulation_;
  const Stamps& stamps_;
  base::Log& log_;
  std::atomic<bool> found_{false}, open_{false}, has_work_{false};
  const std::shared_ptr<Loaded> loaded_ = std::make_shared<Loaded>();
  MotionJudge judge_;

  mutable std::mutex mutex_;  // guards all below; held for microseconds, never by the physics thread
  ArmControl control_;
  ArmJoints joints_;
  bool bound_ = false, warned_ = false, load_failed_ = false;
  bool ask_again_ = false;  // whether the model moves as described could not be known: the world has diverged
  state::ObjectId base_id_;
  EndoscopeCamera camera_;
  std::uint64_t tool_version_ = 0;  // of the structure that has the instrument of an exchange; 0: there is none
  std::uint64_t structure_version_ = 0, sequence_ = 0;
  state::ObjectId object_;
  std::uint32_t slot_ = state::kNone;  // of the arm among its kind
  std::string loaded_text_;
  std::unique_ptr<state::CommandPort> port_;
  std::int64_t kept_ns_ = 0;  // when the simulation last heard of us
  comm::PublishRate rate_;
  std::unique_ptr<ArmTopics> topics_;

  // With simulated time a client must see busy after its own clock went on: see must_wait().
  std::deque<Event> untold_;
  std::int64_t busy_told_ns_ = 0, busy_told_stamp_ = 0, busy_again_ns_ = 0;

  std::unique_ptr<ArmCommands> commands_in_;  // the opening thread's
};

}  // namespace ambf::crtk
