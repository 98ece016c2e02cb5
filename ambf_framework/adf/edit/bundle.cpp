#include "adf/detail/bundle.h"

#include <map>

#include "adf/detail/body_parser.h"
#include "adf/detail/files.h"

namespace ambf::adf {

namespace {

constexpr const char* kHigh = "high resolution path";
constexpr const char* kLow = "low resolution path";

std::string stem_of(const std::string& file) {
  const std::string name = file_name_of(file);
  const std::size_t dot = name.rfind('.');
  return dot == 0 || dot == std::string::npos ? name : name.substr(0, dot);
}

class Bundler {
 public:
  Bundler(const Value& root, const std::string& from, const std::string& to)
      : to_(folder_of(to)),
        high_("./" + stem_of(to) + "_meshes/"),
        low_(high_ + "low/"),
        report_(from),
        file_{report_, options_, folder_of(from), "", Fields(root).text(kHigh), Fields(root).text(kLow)} {}

  Bundle run(const Value& root) {
    for (std::size_t i = 0; i < root.size(); ++i) {
      const auto [key, block] = root.entry(i);
      if (!key.is_scalar() || !block.is_map()) continue;
      if (Change inner = inside(block, Fields(block), Use::both); !inner.empty())
        add_to(bundle_.change.key(key.text()), std::move(inner));
    }
    if (!bundle_.copies.empty()) {
      bundle_.change.key(kHigh).scalar = high_;
      if (!file_.low_path.empty()) bundle_.change.key(kLow).scalar = low_;
    }
    return std::move(bundle_);
  }

 private:
  enum class Use { drawn, collides, both };

  Change inside(const Value& value, const Fields& block, Use use) {
    Change change;
    if (value.is_list()) {
      for (std::size_t i = 0; i < value.size(); ++i)
        if (Change inner = inside(value.item(i), block, use); !inner.empty()) change.items[i] = std::move(inner);
    }
    if (!value.is_map()) return change;
    for (std::size_t i = 0; i < value.size(); ++i) {
      const auto [key, inner] = value.entry(i);
      const std::string name = key.is_scalar() ? key.text() : std::string();
      if (inner.is_scalar() && (name == "mesh" || name == "collision mesh" || name == "onto") &&
          !inner.text().empty()) {
        const Use of_mesh = name == "mesh" ? use : name == "onto" ? Use::drawn : Use::collides;
        const std::string mesh = inner.text(), moved = moved_mesh(block, mesh, of_mesh);
        if (!moved.empty() && moved != mesh) change.key(name).scalar = moved;
      } else if (inner.is_scalar() && (name == kHigh || name == kLow) && !inner.text().empty()) {
        change.key(name).scalar = name == kHigh ? high_ : low_;
      } else if (!inner.is_scalar() && change.find(name) == nullptr) {
        const Use of_inner = name == "compound shape"             ? Use::drawn
                             : name == "compound collision shape" ? Use::collides
                                                                  : use;
        if (Change more = inside(inner, block, of_inner); !more.empty()) change.key(name) = std::move(more);
      }
    }
    return change;
  }

  // The name that the mesh has in the bundle; empty where it is nowhere.
  std::string moved_mesh(const Fields& block, const std::string& mesh, Use use) {
    const bool own_low = !block.text(kLow).empty();
    // Where a block has no path for it, that of drawn meshes serves (mesh_places).
    const bool low_folder = own_low || (block.text(kHigh).empty() && !file_.low_path.empty());
    const auto find = [&](MeshFolder folder) { return find_file(mesh_places(block, mesh, folder, file_)); };
    const std::string drawn = use == Use::collides ? "" : find(MeshFolder::high_resolution);
    // What is only drawn, or drawn and collides from one folder, is there once.
    const std::string collides =
        use == Use::drawn || (use == Use::both && !low_folder) ? "" : find(MeshFolder::low_resolution);
    if (drawn.empty() && collides.empty()) {
      bundle_.missing.push_back(mesh);
      return {};
    }
    const std::string name = name_of(drawn, collides, file_name_of(mesh));
    if (!drawn.empty()) add(drawn, high_ + name);
    if (!collides.empty()) add(collides, (low_folder ? low_ : high_) + name);
    return name;
  }

  // Files that one name is looked for in come from one pair of folders, so that what they refer to stays apart, too.
  std::string name_of(const std::string& drawn, const std::string& collides, const std::string& name) {
    const auto folder = [](const std::string& path) { return path.empty() ? path : folder_of(path); };
    const auto known = folders_.try_emplace({folder(drawn), folder(collides)}, folders_.size()).first;
    return known->second == 0 ? name : std::to_string(known->second + 1) + "/" + name;
  }

  void add(const std::string& from, const std::string& to) {
    const std::string place = resolve(to_, to);
    for (const Copy& copy : bundle_.copies)
      if (copy.to == place) return;
    bundle_.copies.push_back({from, place});
  }

  const std::string to_, high_, low_;
  const Options options_;
  Report report_;
  const FileContext file_;
  std::map<std::pair<std::string, std::string>, std::size_t> folders_;
  Bundle bundle_;
};

}  // namespace

Bundle bundle_of(const Value& root, const std::string& from, const std::string& to) {
  return Bundler(root, from, to).run(root);
}

void add_to(Change& change, Change more) {
  if (more.scalar) change.scalar = std::move(more.scalar);
  for (auto& [name, inner] : more.keys) add_to(change.key(name), std::move(inner));
  for (auto& [index, inner] : more.items) add_to(change.items[index], std::move(inner));
  change.without.merge(more.without);
}

}  // namespace ambf::adf
