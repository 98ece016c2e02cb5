// Prepares surfaces for search (FeatureMesh::for_search) on a thread of its own, so that a step in real time need
// not. The constructor starts the thread: not on a thread with a real-time priority. Private to physics/.
#pragma once

#include <atomic>
#include <memory>
#include <thread>

#include "base/event_count.h"
#include "exchange/bounded_queue.h"
#include "physics/meshes/detail/feature_mesh.h"

namespace ambf::physics::detail {

class SurfacePreparation {
 public:
  SurfacePreparation();
  ~SurfacePreparation();  // waits for the surface in work; those behind it stay unprepared
  SurfacePreparation(const SurfacePreparation&) = delete;
  SurfacePreparation& operator=(const SurfacePreparation&) = delete;

  // The surface becomes ready_for_search() some time later. Physics thread, in every step that needs it; never waits.
  void request(const FeatureMesh& mesh);

 private:
  void run();

  exchange::BoundedQueue<std::shared_ptr<const FeatureMesh>> queue_{64};
  base::EventCount wake_;
  std::atomic<bool> stop_{false};
  std::thread thread_;  // last: uses all of the above
};

}  // namespace ambf::physics::detail
