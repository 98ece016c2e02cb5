#include "physics/meshes/detail/surface_preparation.h"

#include "base/realtime.h"

namespace ambf::physics::detail {

namespace {

constexpr int kNice = 5;  // behind drawing and publishing

}  // namespace

SurfacePreparation::SurfacePreparation() : thread_([this] { run(); }) {}

SurfacePreparation::~SurfacePreparation() {
  stop_ = true;
  wake_.notify_all();
  thread_.join();
}

void SurfacePreparation::request(const FeatureMesh& mesh) {
  if (!mesh.claim_preparation()) return;
  if (queue_.try_push(mesh.shared_from_this())) {
    wake_.notify_all();
  } else {
    mesh.return_claim();  // too many at once: asked again in the next step
  }
}

void SurfacePreparation::run() {
  base::set_thread_name("surfaces");
  base::lower_priority(kNice);
  while (!stop_) {
    const std::uint32_t seen = wake_.count();
    std::shared_ptr<const FeatureMesh> mesh;
    while (!stop_ && queue_.try_pop(mesh)) {
      mesh->for_search();
      mesh.reset();
    }
    if (!stop_) wake_.wait_until(seen, base::kNoDeadline);
  }
}

}  // namespace ambf::physics::detail
