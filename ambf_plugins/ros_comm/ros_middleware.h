// ROS 1 as AMBF's middleware: State/Command topics of every object, the world's topics and services. No ROS header is
// needed to use it.
//
// It never makes anybody wait for a master: when the master is local and absent it starts one (and stops it at the
// end), when it is elsewhere it joins once one appears, and when a master was restarted it registers everything again.
#pragma once

#include <memory>

#include "base/log.h"
#include "comm/middleware.h"
#include "ros_comm/images/jpeg_encoder.h"
#include "state/abilities/abilities.h"
#include "state/picture.h"

namespace ambf::ros_comm {

class Node;

class RosMiddleware : public comm::Middleware {
 public:
  // Returns at once; the rest happens on threads of its own. One per process: ROS cannot be started twice. `simulation`
  // and `log` must outlive it. Destroy it after the comm::Server that uses it. sending_priority: SCHED_FIFO priority of
  // the thread of roscpp's that sends all states, where permitted; 0: ordinary scheduling.
  static std::unique_ptr<RosMiddleware> start(const state::Abilities& simulation, base::Log& log, int sending_priority,
                                              JpegEncoder encode);

  // Publishes cameras' pictures.
  virtual state::PictureSink& pictures() = 0;
  // For parts with topics of their own (dvrk_arm/drivers.h).
  virtual Node& node() = 0;
};

}  // namespace ambf::ros_comm
