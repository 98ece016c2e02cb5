#include "mesh/obj_points.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <locale>
#include <sstream>

#include "mesh/loader.h"

namespace ambf::mesh {

bool is_obj(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending == ".obj";
}

std::vector<math::Vec3> obj_points(const std::string& path) {
  std::vector<math::Vec3> points;
  std::error_code failed;
  if (!std::filesystem::is_regular_file(path, failed)) return points;
  const std::uintmax_t size = std::filesystem::file_size(path, failed);
  if (failed || size > LoadOptions{}.max_file_bytes) return points;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    words.imbue(std::locale::classic());
    std::string keyword;
    double x = 0.0, y = 0.0, z = 0.0;
    if (!(words >> keyword) || keyword != "v" || !(words >> x >> y >> z)) continue;
    points.push_back({static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)});
  }
  return points;
}

}  // namespace ambf::mesh
