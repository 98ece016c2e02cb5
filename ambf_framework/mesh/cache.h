// Shared meshes by content: a file is decoded once however many bodies, paths or links name it, and again only after it
// (or a material library or texture it names) changed on disk. Products made from a mesh (collision mesh, hulls) are
// kept beside it. Thread-safe: loader threads and the render thread may call anything at any time; it locks and reads
// files, so never the physics thread. Two threads asking for the same file at once cost one decoding.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "mesh/hull.h"
#include "mesh/loader.h"
#include "mesh/mass_properties.h"
#include "mesh/mesh.h"

namespace ambf::mesh {

struct CachedMesh {
  std::shared_ptr<const Mesh> mesh;  // null when the file could not be loaded
  base::Diagnostics diagnostics;     // those of the first load again at every hit, naming the path of this call
};

class MeshCache {
 public:
  explicit MeshCache(const LoadOptions& options = {});
  ~MeshCache();
  MeshCache(const MeshCache&) = delete;
  MeshCache& operator=(const MeshCache&) = delete;

  // A failure is not remembered: the next call tries again.
  CachedMesh load(const std::string& path);

  // As load for each path, in order, decoded by up to `threads` threads (0: as many as the machine has, at most 8).
  std::vector<CachedMesh> load_many(const std::vector<std::string>& paths, int threads = 0);

  // Products, each built once per content and kind. `mesh` may come from load() of this cache or from elsewhere (then
  // it is built anew at every call). Never null for a non-null mesh.
  std::shared_ptr<const CollisionMesh> collision_mesh(const std::shared_ptr<const Mesh>& mesh);
  std::shared_ptr<const ReducedHull> hull(const std::shared_ptr<const Mesh>& mesh, const HullOptions& options = {});
  std::shared_ptr<const MassProperties> mass_properties(const std::shared_ptr<const Mesh>& mesh);

  // Frees every mesh that nobody outside holds (and its products, unless one of those is held). Call after unloading.
  // Returns how many meshes were freed.
  std::size_t trim();

  struct Statistics {
    std::size_t requests = 0;     // calls of load, load_many counted per path
    std::size_t decodes = 0;      // files actually decoded
    std::size_t products = 0;     // collision meshes, hulls and mass properties built
    std::size_t meshes_held = 0;  // now in memory
  };
  Statistics statistics() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ambf::mesh
