#include "runtime/detail/saving.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

#include "adf/urdf_import.h"
#include "adf/write.h"
#include "mesh/loader.h"
#include "scene/block_kinds.h"
#include "state/kinds.h"

namespace ambf::runtime {

namespace {

namespace fs = std::filesystem;

// Empty for what cannot be the text that was kept.
std::string content_of(const std::string& path) {
  std::error_code problem;
  if (!fs::is_regular_file(path, problem) || fs::file_size(path, problem) > kMaxKeptTextBytes || problem) return {};
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::string copy_file(const std::string& from, const std::string& to, base::IfExists if_exists) {
  std::error_code problem;
  if (fs::equivalent(from, to, problem)) return {};
  const std::uintmax_t size = fs::file_size(from, problem);
  if (problem || size > mesh::LoadOptions{}.max_file_bytes)
    return "cannot copy '" + from + "': " + (problem ? problem.message() : "larger than what is read as a mesh");
  std::ifstream stream(from, std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(stream), {});
  if (!stream || bytes.size() != size) return "cannot copy '" + from + "': reading it failed";
  if (fs::is_regular_file(to, problem) && fs::file_size(to, problem) == size) {
    std::ifstream there(to, std::ios::binary);
    if (std::string(std::istreambuf_iterator<char>(there), {}) == bytes) return {};  // of a bundle with this one
  }
  fs::create_directories(fs::path(to).parent_path(), problem);
  if (problem) return "cannot make the folder of '" + to + "': " + problem.message();
  return base::write_whole_file(to, bytes, if_exists);
}

}  // namespace

adf::Present present_of(const model::Catalogue& catalogue, state::ModelId model, const state::Frame& now,
                        const math::Pose& T_world_model) {
  adf::Present present;
  const state::Structure& structure = *now.structure;
  const math::Pose T_model_world = math::inverse(T_world_model);
  const auto place_of = [&](const std::string& block, const state::PlacedInfo& placed, const math::Pose& T_parent) {
    const bool hangs = !placed.parent_name.empty();
    return adf::ViewPlace{block, placed.parent_name, hangs ? T_parent : T_model_world * T_parent};
  };
  std::map<std::uint32_t, std::string> block_of;  // by object
  for (model::Catalogue::Made& made : catalogue.made_from(model)) {
    const state::ObjectInfo& object = structure.objects[made.object];
    const std::uint32_t slot = object.slot;
    if (state::info_of(object.kind).has_mass) {
      present.bodies.push_back({made.block, T_model_world * now.bodies[slot].T_world_body});
      present.tuned_bodies.push_back({made.block, structure.bodies[slot].parameters, now.body_parameters[slot]});
    } else if (state::info_of(object.kind).connects_bodies) {
      present.tuned_joints.push_back({made.block, structure.joints[slot].parameters, now.joint_parameters[slot]});
    }
    block_of.emplace(made.object, std::move(made.block));
  }
  for (std::size_t slot = 0; slot < structure.cameras.size(); ++slot) {
    const state::CameraInfo& camera = structure.cameras[slot];
    if (const auto block = block_of.find(camera.object); block != block_of.end())
      present.cameras.push_back(
          {place_of(block->second, camera, now.cameras[slot].T_parent_camera), camera.lens, now.cameras[slot].lens});
  }
  for (std::size_t slot = 0; slot < structure.lights.size(); ++slot) {
    const state::LightInfo& light = structure.lights[slot];
    if (const auto block = block_of.find(light.object); block != block_of.end())
      present.lights.push_back(
          {place_of(block->second, light, now.lights[slot].T_parent_light), light.beam, now.lights[slot].beam});
  }
  return present;
}

SavedFrom saved_from(const KeptText* kept, const scene::Model& description, const std::string& file) {
  if (kept != nullptr && kept->text != nullptr) return {*kept->text, file, {}};
  adf::WrittenModel written = adf::write_model(description);
  return {std::move(written.text), "", std::move(written.diagnostics)};
}

std::string kept_as_read(const scene::Model& model, const state::Frame& now) {
  std::map<std::string, std::size_t> others;
  for (const scene::KindBlock& block : model.blocks) ++others[std::string(block.kind->group->title)];
  std::string kept;
  for (const auto& [name, count] : others)
    kept += (kept.empty() ? "" : ", ") + std::to_string(count) + " " + name + "(s)";
  const bool moves = std::any_of(now.bodies.begin(), now.bodies.end(), [](const state::BodyState& body) {
    constexpr double kStill = 1e-9;  // m/s, rad/s
    return math::norm(body.twist_world.linear) > kStill || math::norm(body.twist_world.angular) > kStill;
  });
  if (moves) kept += (kept.empty() ? "" : ", ") + std::string("velocities (there is no key for them)");
  return kept;
}

std::string why_not_over_its_own(const std::string& path, const std::string& text, const std::string* written) {
  const std::string there = content_of(path);
  if (there == text || (written != nullptr && there == *written)) return {};
  if (adf::is_urdf(there)) return "'" + path + "' is URDF and is not replaced by ADF; give another path";
  return "'" + path + "' has changed since it was loaded; save it under another name";
}

bool is_same_file(const std::string& a, const std::string& b) {
  std::error_code problem;
  return !b.empty() && fs::equivalent(a, b, problem) && !problem;
}

std::string adf_name_of(const std::string& path, const std::string& otherwise) {
  const fs::path file(path.empty() ? otherwise : path);
  std::string name = file.stem().string();
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == '/' || static_cast<unsigned char>(c) < 0x20; }, '_');
  const std::string ending = file.extension().string();
  const bool is_adf = ending == ".yaml" || ending == ".yml" || ending == ".adf";
  return (name.empty() || name == "." || name == ".." ? "model" : name) + (is_adf ? ending : ".yaml");
}

std::string copy_mesh(const adf::Copy& copy, base::IfExists if_exists) {
  if (std::string why = copy_file(copy.from, copy.to, if_exists); !why.empty()) return why;
  const fs::path home = fs::path(copy.from).parent_path(), there = fs::path(copy.to).parent_path();
  for (const std::string& file : mesh::load(copy.from).depends_on) {
    std::error_code problem;
    if (!fs::is_regular_file(file, problem)) continue;
    const fs::path relative = fs::path(file).lexically_normal().lexically_relative(home.lexically_normal());
    const bool within = !relative.empty() && *relative.begin() != "..";
    const fs::path to = there / (within ? relative : fs::path(file).filename());
    if (std::string why = copy_file(file, to.string(), if_exists); !why.empty()) return why;
  }
  return {};
}

}  // namespace ambf::runtime
