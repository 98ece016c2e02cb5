#include "mesh/cache.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <filesystem>
#include <map>
#include <mutex>
#include <thread>
#include <tuple>
#include <unordered_map>

#include "mesh/detail/file_stamp.h"
#include "mesh/formats/read_context.h"
#include "mesh/formats/text.h"
#include "mesh/weld.h"

namespace ambf::mesh {

namespace {

// What makes two files the same mesh: their bytes, the kind their name says, and, where they name other files, their
// folder.
struct ContentKey {
  ContentHash hash;
  std::string ending, folder;
  bool operator<(const ContentKey& o) const {
    return std::tie(hash, ending, folder) < std::tie(o.hash, o.ending, o.folder);
  }
};

struct Dependency {
  std::string path;
  FileStamp stamp;
  ContentHash hash;
};

// One content. `mutex` is held while it is decoded and while products are built, so that each is made once.
struct Slot {
  std::mutex mutex;
  std::shared_ptr<const Mesh> mesh;  // null: not decoded yet, or that failed
  base::Diagnostics diagnostics;
  std::string path;  // as in the diagnostics
  std::vector<Dependency> dependencies;
  std::shared_ptr<const CollisionMesh> collision;
  std::map<std::pair<int, double>, std::shared_ptr<const ReducedHull>> hulls;
  std::shared_ptr<const MassProperties> mass;

  bool in_use() const {
    const auto held = [](const auto& product) { return product.use_count() > 1; };
    return held(mesh) || held(collision) || held(mass) ||
           std::any_of(hulls.begin(), hulls.end(), [&held](const auto& h) { return held(h.second); });
  }
};

// Material libraries and textures: their whole content is only looked at when their stamp may lie.
ContentHash hash_of_file(const std::string& path) {
  std::string bytes, why, hint;
  constexpr std::size_t kMost = std::size_t{64} << 20;
  read_whole_file(path, kMost, bytes, why, hint);
  return hash_of(bytes);
}

bool unchanged(std::vector<Dependency>& dependencies) {
  for (Dependency& d : dependencies) {
    const FileStamp now = stamp_of(d.path);
    if (surely_same(d.stamp, now)) continue;
    if (now.exists != d.stamp.exists || !(hash_of_file(d.path) == d.hash)) return false;
    d.stamp = now;
  }
  return true;
}

ContentKey key_of(const std::string& path, std::string_view bytes) {
  namespace fs = std::filesystem;
  ContentKey key;
  key.hash = hash_of(bytes);
  key.ending = fs::path(path).extension().string();
  std::transform(key.ending.begin(), key.ending.end(), key.ending.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  const auto holds = [bytes](std::string_view word) { return bytes.find(word) != std::string_view::npos; };
  const bool may_name_files = key.ending != ".obj" && key.ending != ".ply" && key.ending != ".dae";
  const bool names_files =
      key.ending != ".stl" && (may_name_files || holds("mtllib") || holds("TextureFile") || holds("init_from"));
  if (names_files) {
    std::error_code error;
    key.folder =
        fs::weakly_canonical(fs::path(path).parent_path().empty() ? "." : fs::path(path).parent_path(), error).string();
  }
  return key;
}

CachedMesh failure(const std::string& path, const std::string& why, const std::string& hint) {
  return {nullptr, {{base::Severity::error, path, 0, 0, "", "", why, hint}}};
}

}  // namespace

// `mutex` guards the maps and counts and is never held while a Slot's mutex is waited for.
struct MeshCache::Impl {
  struct KnownPath {
    FileStamp stamp;
    ContentKey key;
  };

  LoadOptions options;
  mutable std::mutex mutex;
  std::map<std::string, KnownPath> paths;
  std::map<ContentKey, std::shared_ptr<Slot>> slots;
  std::unordered_map<const Mesh*, std::weak_ptr<Slot>> slot_of_mesh;
  Statistics counts;

  // The slot a path had when it was last read, if the file is surely the same since.
  std::shared_ptr<Slot> slot_by_stamp(const std::string& path, const FileStamp& stamp) {
    const std::lock_guard lock(mutex);
    const auto known = paths.find(path);
    if (known == paths.end() || !surely_same(known->second.stamp, stamp)) return nullptr;
    const auto slot = slots.find(known->second.key);
    return slot == slots.end() ? nullptr : slot->second;
  }

  std::shared_ptr<Slot> slot_by_content(const std::string& path, const FileStamp& stamp, const ContentKey& key) {
    const std::lock_guard lock(mutex);
    paths[path] = {stamp, key};
    std::shared_ptr<Slot>& slot = slots[key];
    if (slot == nullptr) slot = std::make_shared<Slot>();
    return slot;
  }

  CachedMesh load(const std::string& path) {
    {
      const std::lock_guard lock(mutex);
      ++counts.requests;
    }
    std::string bytes, why, hint;
    const FileStamp stamp = stamp_of(path);  // before reading: a later change shows
    std::shared_ptr<Slot> slot = slot_by_stamp(path, stamp);
    if (slot != nullptr) {
      const std::lock_guard lock(slot->mutex);
      if (slot->mesh != nullptr && unchanged(slot->dependencies)) return answer(*slot, path);
    }
    if (!read_whole_file(path, options.max_file_bytes, bytes, why, hint)) return failure(path, why, hint);
    slot = slot_by_content(path, stamp, key_of(path, bytes));
    const std::lock_guard lock(slot->mutex);
    if (slot->mesh == nullptr || !unchanged(slot->dependencies)) return decode(slot, path, std::move(bytes));
    return answer(*slot, path);
  }

  // The slot's mutex is held.
  CachedMesh decode(const std::shared_ptr<Slot>& slot, const std::string& path, std::string bytes) {
    LoadResult result = load_bytes(std::move(bytes), path, options);
    std::vector<Dependency> dependencies;
    for (const std::string& name : result.depends_on) {
      const FileStamp stamp = stamp_of(name);
      dependencies.push_back({name, stamp, stamp.exists ? hash_of_file(name) : hash_of("")});
    }
    const std::lock_guard lock(mutex);
    ++counts.decodes;
    if (slot->mesh != nullptr) slot_of_mesh.erase(slot->mesh.get());
    slot->mesh = nullptr;
    slot->collision = nullptr;
    slot->mass = nullptr;
    slot->hulls.clear();
    if (!result.ok) return {nullptr, std::move(result.diagnostics)};
    slot->path = path;
    slot->diagnostics = std::move(result.diagnostics);
    slot->dependencies = std::move(dependencies);
    slot->mesh = std::make_shared<const Mesh>(std::move(result.mesh));
    slot_of_mesh[slot->mesh.get()] = slot;
    return answer(*slot, path);
  }

  static CachedMesh answer(const Slot& slot, const std::string& path) {
    CachedMesh out{slot.mesh, slot.diagnostics};
    for (base::Diagnostic& d : out.diagnostics) {
      if (d.file == slot.path) d.file = path;
    }
    return out;
  }

  std::shared_ptr<Slot> slot_of(const std::shared_ptr<const Mesh>& mesh) const {
    const std::lock_guard lock(mutex);
    const auto found = slot_of_mesh.find(mesh.get());
    return found == slot_of_mesh.end() ? nullptr : found->second.lock();
  }

  // Finds or makes a product of `mesh`; `place` gives its pointer in a slot.
  template <typename Product, typename Place, typename Make>
  std::shared_ptr<const Product> product(const std::shared_ptr<const Mesh>& mesh, const Place& place,
                                         const Make& make) {
    if (mesh == nullptr) return nullptr;
    const std::shared_ptr<Slot> slot = slot_of(mesh);
    if (slot != nullptr) {
      const std::lock_guard lock(slot->mutex);
      if (slot->mesh == mesh) {
        std::shared_ptr<const Product>& kept = place(*slot);
        if (kept == nullptr) {
          kept = std::make_shared<const Product>(make(*slot));
          count_product();
        }
        return kept;
      }
    }
    Slot passing;  // not ours, or the file has changed since
    passing.mesh = mesh;
    count_product();
    return std::make_shared<const Product>(make(passing));
  }

  void count_product() {
    const std::lock_guard lock(mutex);
    ++counts.products;
  }
};

namespace {
const CollisionMesh& collision_of(Slot& slot) {
  if (slot.collision == nullptr)
    slot.collision = std::make_shared<const CollisionMesh>(make_collision_mesh(*slot.mesh));
  return *slot.collision;
}
}  // namespace

MeshCache::MeshCache(const LoadOptions& options) : impl_(std::make_unique<Impl>()) { impl_->options = options; }
MeshCache::~MeshCache() = default;

CachedMesh MeshCache::load(const std::string& path) {
  try {
    return impl_->load(path);
  } catch (const std::exception& error) {  // out of memory, or a path the file system refuses
    return failure(path, std::string("the mesh could not be loaded: ") + error.what(), "reduce (decimate) the mesh");
  }
}

std::vector<CachedMesh> MeshCache::load_many(const std::vector<std::string>& paths, int threads) {
  constexpr int kMaxThreads = 8;
  if (threads <= 0) threads = static_cast<int>(std::thread::hardware_concurrency());
  threads = std::clamp(threads, 1, kMaxThreads);
  std::vector<CachedMesh> results(paths.size());
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t i = next++; i < paths.size(); i = next++) results[i] = load(paths[i]);
  };
  std::vector<std::thread> others;
  for (std::size_t i = 1; i < std::min(static_cast<std::size_t>(threads), paths.size()); ++i) {
    try {
      others.emplace_back(work);
    } catch (const std::exception&) {
      break;  // no more threads to be had: those there are do the work
    }
  }
  work();
  for (std::thread& thread : others) thread.join();
  return results;
}

std::shared_ptr<const CollisionMesh> MeshCache::collision_mesh(const std::shared_ptr<const Mesh>& mesh) {
  return impl_->product<CollisionMesh>(
      mesh, [](Slot & slot) -> auto& { return slot.collision; },
      [](Slot& slot) { return make_collision_mesh(*slot.mesh); });
}

std::shared_ptr<const ReducedHull> MeshCache::hull(const std::shared_ptr<const Mesh>& mesh,
                                                   const HullOptions& options) {
  const std::pair key(options.max_points, options.tolerance_relative);
  return impl_->product<ReducedHull>(
      mesh, [&key](Slot & slot) -> auto& { return slot.hulls[key]; },
      [&options](Slot& slot) { return reduce_hull(collision_of(slot).vertices, options); });
}

std::shared_ptr<const MassProperties> MeshCache::mass_properties(const std::shared_ptr<const Mesh>& mesh) {
  return impl_->product<MassProperties>(
      mesh, [](Slot & slot) -> auto& { return slot.mass; },
      [](Slot& slot) { return mesh::mass_properties(collision_of(slot)); });
}

std::size_t MeshCache::trim() {
  std::vector<std::shared_ptr<Slot>> dropped;  // freed after the lock
  const std::lock_guard lock(impl_->mutex);
  for (auto it = impl_->slots.begin(); it != impl_->slots.end();) {
    const std::shared_ptr<Slot>& slot = it->second;
    std::unique_lock busy(slot->mutex, std::try_to_lock);
    // Only the map holds it, so nobody can be about to use it; and nobody holds what it made.
    if (!busy.owns_lock() || slot.use_count() > 1 || slot->in_use()) {
      ++it;
      continue;
    }
    busy.unlock();
    if (slot->mesh != nullptr) {
      impl_->slot_of_mesh.erase(slot->mesh.get());
      dropped.push_back(slot);
    }
    it = impl_->slots.erase(it);
  }
  for (auto it = impl_->paths.begin(); it != impl_->paths.end();) {
    it = impl_->slots.count(it->second.key) == 0 ? impl_->paths.erase(it) : std::next(it);
  }
  return dropped.size();
}

MeshCache::Statistics MeshCache::statistics() const {
  const std::lock_guard lock(impl_->mutex);
  Statistics counts = impl_->counts;
  counts.meshes_held = impl_->slot_of_mesh.size();
  return counts;
}

}  // namespace ambf::mesh
