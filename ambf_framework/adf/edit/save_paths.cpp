#include "adf/detail/save_paths.h"

#include <filesystem>

#include "adf/detail/files.h"

namespace ambf::adf {

namespace {

namespace fs = std::filesystem;

constexpr const char* kHigh = "high resolution path";
constexpr const char* kLow = "low resolution path";

std::string text_at(const Value& map, std::string_view key) {
  const auto found = map.find(key);
  return found && found->is_scalar() ? found->text() : std::string();
}

class Mender {
 public:
  Mender(const std::string& from, const std::string& to) : from_(from), to_(to) {}

  Change run(const Value& root) {
    Change change;
    for (std::size_t i = 0; i < root.size(); ++i) {
      const auto [key, value] = root.entry(i);
      if (!key.is_scalar()) continue;
      if (Change inner = inside(value, false); !inner.empty()) change.key(key.text()) = std::move(inner);
    }
    const std::string high = text_at(root, kHigh);
    if (!is_absolute(high) && (!high.empty() || header_leads_)) change.key(kHigh).scalar = moved(high);
    if (const std::string low = text_at(root, kLow); !low.empty() && !is_absolute(low))
      change.key(kLow).scalar = moved(low);
    return change;
  }

 private:
  std::string moved(const std::string& folder) const {
    std::string path = seen_from(to_, resolve(from_, folder));
    if (!path.ends_with('/')) path += '/';
    return path;
  }

  bool is_there(const std::string& path) const {
    std::error_code problem;
    return !path.empty() && !is_absolute(path) && path.find('\0') == std::string::npos &&
           fs::exists(resolve(from_, path), problem);
  }

  // `own_folder`: a map around this one names the folder of its meshes.
  Change inside(const Value& value, bool own_folder) {
    Change change;
    if (value.is_list()) {
      for (std::size_t i = 0; i < value.size(); ++i)
        if (Change inner = inside(value.item(i), own_folder); !inner.empty()) change.items[i] = std::move(inner);
    }
    if (!value.is_map()) return change;
    // The folder of a block is looked for beneath the header's, too (ADF 1.7): then it stays.
    for (const char* key : {kHigh, kLow}) {
      const std::string own = text_at(value, key);
      if (is_there(own)) {
        change.key(key).scalar = moved(own);
        own_folder = true;
      }
    }
    for (const char* key : {"mesh", "collision mesh", "onto"}) {
      const std::string mesh = text_at(value, key);
      header_leads_ |= !mesh.empty() && !is_absolute(mesh) && !own_folder;
    }
    if (const std::string path = text_at(value, "path"); is_there(path)) change.key("path").scalar = moved(path);
    for (std::size_t i = 0; i < value.size(); ++i) {
      const auto [key, inner_value] = value.entry(i);
      if (!key.is_scalar() || inner_value.is_scalar() || change.find(key.text()) != nullptr) continue;
      if (Change inner = inside(inner_value, own_folder); !inner.empty()) change.key(key.text()) = std::move(inner);
    }
    return change;
  }

  const std::string from_, to_;
  bool header_leads_ = false;  // to some mesh
};

}  // namespace

Change moved_paths(const Value& root, const std::string& from, const std::string& to) {
  std::error_code problem;
  if (fs::weakly_canonical(fs::absolute(from), problem) == fs::weakly_canonical(fs::absolute(to), problem)) return {};
  return Mender(from, to).run(root);
}

}  // namespace ambf::adf
