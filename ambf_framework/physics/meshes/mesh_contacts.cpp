#include "physics/meshes/mesh_contacts.h"

#include <map>
#include <mutex>
#include <optional>

#include "physics/meshes/detail/attached_surface.h"
#include "physics/meshes/detail/mesh_contact_algorithm.h"
#include "physics/meshes/detail/surface_preparation.h"

namespace ambf::physics::detail {

struct MeshContacts::Impl {
  Impl(btCollisionDispatcher& dispatcher, btCollisionConfiguration& configuration, bool preparation_thread);

  std::optional<SurfacePreparation> preparation;
  SurfaceContacts contacts;
  MeshContactAlgorithm::CreateFunc straight{contacts}, swapped{contacts};
};

MeshContacts::Impl::Impl(btCollisionDispatcher& dispatcher, btCollisionConfiguration& configuration,
                         bool preparation_thread) {
  if (preparation_thread) preparation.emplace();
  swapped.m_swapped = true;
  const auto use = [&](int type) {
    dispatcher.registerCollisionCreateFunc(GIMPACT_SHAPE_PROXYTYPE, type, &straight);
    if (type != GIMPACT_SHAPE_PROXYTYPE)
      dispatcher.registerCollisionCreateFunc(type, GIMPACT_SHAPE_PROXYTYPE, &swapped);
  };
  for (int type = 0; type < CONCAVE_SHAPES_START_HERE; ++type)
    if (btBroadphaseProxy::isConvex(type)) use(type);
  use(TRIANGLE_MESH_SHAPE_PROXYTYPE);
  use(GIMPACT_SHAPE_PROXYTYPE);
  // Compounds part by part.
  dispatcher.registerCollisionCreateFunc(
      COMPOUND_SHAPE_PROXYTYPE, GIMPACT_SHAPE_PROXYTYPE,
      configuration.getCollisionAlgorithmCreateFunc(COMPOUND_SHAPE_PROXYTYPE, BOX_SHAPE_PROXYTYPE));
  dispatcher.registerCollisionCreateFunc(
      GIMPACT_SHAPE_PROXYTYPE, COMPOUND_SHAPE_PROXYTYPE,
      configuration.getCollisionAlgorithmCreateFunc(BOX_SHAPE_PROXYTYPE, COMPOUND_SHAPE_PROXYTYPE));
}

MeshContacts::MeshContacts(btCollisionDispatcher& dispatcher, btCollisionConfiguration& configuration,
                           bool preparation_thread)
    : impl_(std::make_unique<Impl>(dispatcher, configuration, preparation_thread)) {}
MeshContacts::~MeshContacts() = default;

void MeshContacts::set_real_time(bool real_time) {
  impl_->contacts.prepare_by(real_time && impl_->preparation ? &*impl_->preparation : nullptr);
}
void MeshContacts::begin_step() { impl_->contacts.budget().begin_step(); }
bool MeshContacts::take_postponed() { return impl_->contacts.budget().take_postponed(); }
std::uint64_t MeshContacts::overloaded_steps() const { return impl_->contacts.budget().overloaded_steps(); }
void MeshContacts::restart() { impl_->contacts.budget().restart(); }

SharedSurface make_mesh_surface(const std::vector<math::Vec3>& vertices,
                                const std::vector<std::array<int, 3>>& triangles, double margin, bool moving) {
  return make_feature_mesh(vertices, triangles, margin, moving);
}

// Chains and piles are of hundreds of equal boxes, with 6 KB of surface each.
SharedSurface make_box_surface(const btVector3& half_extents) {
  static std::mutex mutex;
  static std::map<std::array<double, 3>, std::weak_ptr<const FeatureMesh>> made;
  static std::size_t next_cleaning = 64;
  const std::lock_guard<std::mutex> lock(mutex);
  std::weak_ptr<const FeatureMesh>& known = made[{half_extents.x(), half_extents.y(), half_extents.z()}];
  if (SharedSurface surface = known.lock()) return surface;
  SharedSurface surface = make_feature_box(half_extents);
  known = surface;
  if (made.size() >= next_cleaning) {
    std::erase_if(made, [](const auto& entry) { return entry.second.expired(); });
    next_cleaning = 2 * made.size() + 64;
  }
  return surface;
}

void attach_surface(btCollisionShape& shape, const FeatureMesh& surface) {
  shape.setUserPointer(const_cast<FeatureMesh*>(&surface));
}

}  // namespace ambf::physics::detail
