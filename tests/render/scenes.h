// Structures and frames made by hand, so that the renderer is tested without a simulation.
#pragma once

#include <memory>
#include <utility>

#include "mesh/appearance.h"
#include "mesh/primitives.h"
#include "state/frame.h"

namespace ambf::render::testing {

inline mesh::SurfaceMaterial matte(float r, float g, float b) {
  mesh::SurfaceMaterial material;
  const float color[3] = {r, g, b};
  for (int i = 0; i < 3; ++i) {
    material.diffuse[i] = material.ambient[i] = color[i];
    material.specular[i] = 0.0F;
  }
  return material;
}

// A square metre that lies on the ground, u along x and v along y, its picture so many times on it; one material.
inline mesh::Mesh square(float times) {
  mesh::Mesh mesh;
  mesh::Submesh part;
  part.positions = {-0.5F, -0.5F, 0, 0.5F, -0.5F, 0, 0.5F, 0.5F, 0, -0.5F, 0.5F, 0};
  part.normals = {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
  part.texcoords = {0, 0, times, 0, times, times, 0, times};
  part.triangles = {0, 1, 2, 0, 2, 3};
  part.material = 0;
  mesh.submeshes.push_back(part);
  mesh.materials.emplace_back();
  mesh.bounds = mesh::bounds_of(mesh.submeshes);
  return mesh;
}

struct SceneMaker {
  std::shared_ptr<state::Structure> structure = std::make_shared<state::Structure>();
  std::vector<math::Pose> bodies, cameras, lights;
  state::ShaderFiles shaders;  // of the bodies that are added next

  SceneMaker() {
    static std::uint64_t versions = 0;
    structure->version = ++versions;
  }
  std::uint32_t object(state::ObjectKind kind, std::string name, std::uint32_t slot) {
    state::ObjectInfo info;
    info.id = {static_cast<std::uint32_t>(structure->objects.size()), 1};
    info.kind = kind;
    info.name = "/test/" + name;
    info.local_name = std::move(name);
    info.slot = slot;
    structure->objects.push_back(info);
    return info.id.index;
  }
  std::uint32_t body(mesh::Mesh mesh, const math::Pose& T_world_body, const mesh::SurfaceMaterial* material) {
    return body(std::make_shared<mesh::Mesh>(std::move(mesh)), T_world_body, material);
  }
  std::uint32_t body(const std::shared_ptr<const mesh::Mesh>& mesh, const math::Pose& T_world_body,
                     const mesh::SurfaceMaterial* material) {
    auto appearance = std::make_shared<mesh::Appearance>();
    appearance->parts.push_back({mesh, {}, 1.0});
    appearance->has_material = material != nullptr;
    appearance->shaders = shaders;
    if (material != nullptr) appearance->material = *material;
    const auto slot = static_cast<std::uint32_t>(bodies.size());
    state::BodyInfo info;
    info.object = object(state::ObjectKind::rigid_body, "body" + std::to_string(slot), slot);
    info.appearance = appearance;
    structure->bodies.push_back(info);
    bodies.push_back(T_world_body);
    return slot;
  }
  std::uint32_t camera(const math::Pose& T_world_camera) {
    const auto slot = static_cast<std::uint32_t>(cameras.size());
    state::CameraInfo info;
    info.object = object(state::ObjectKind::camera, "camera" + std::to_string(slot), slot);
    structure->cameras.push_back(info);
    cameras.push_back(T_world_camera);
    return slot;
  }
  state::LightInfo& light(const math::Pose& T_world_light, double cutoff_angle_rad = 1.2) {
    state::LightInfo info;
    info.object = object(state::ObjectKind::light, "light", static_cast<std::uint32_t>(lights.size()));
    info.beam.cutoff_angle_rad = cutoff_angle_rad;
    info.beam.spot_exponent = 0.0;
    structure->lights.push_back(info);
    lights.push_back(T_world_light);
    return structure->lights.back();
  }
  std::unique_ptr<state::Frame> frame() const {
    auto frame = state::make_frame(structure);
    frame->sequence = 1;
    for (std::size_t i = 0; i < bodies.size(); ++i) frame->bodies[i].T_world_body = bodies[i];
    for (std::size_t i = 0; i < cameras.size(); ++i) {
      frame->cameras[i].T_world_camera = frame->cameras[i].T_parent_camera = cameras[i];
    }
    for (std::size_t i = 0; i < lights.size(); ++i) {
      frame->lights[i].T_world_light = frame->lights[i].T_parent_light = lights[i];
    }
    return frame;
  }
};

}  // namespace ambf::render::testing
