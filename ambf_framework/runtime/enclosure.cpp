#include "runtime/detail/enclosure.h"

namespace ambf::runtime {

namespace {

constexpr double kThickness = 0.1;  // m: thick enough that nothing tunnels through at 1 ms steps

scene::Body wall(const char* name, const math::Vec3& size, const math::Vec3& center, const scene::Color& color) {
  scene::Body body;
  body.identity.identifier = std::string("BODY ") + name;
  body.identity.name = name;
  body.identity.passive = true;
  body.mass = 0.0;
  body.T_world_body.position = center;
  body.inertial_offset = math::Pose{};
  scene::PlacedGeometry box;
  box.geometry.shape = scene::Shape::box;
  box.geometry.size = size;
  body.visual.shapes = {box};
  body.collision.shapes = {box};
  scene::Material material;
  material.diffuse = color;
  material.ambient = {0.5 * color.r, 0.5 * color.g, 0.5 * color.b};
  material.specular = {0.1, 0.1, 0.1};
  body.visual.material = material;
  return body;
}

}  // namespace

scene::Model make_enclosure(const math::Vec3& size) {
  const scene::Color floor{0.62, 0.64, 0.66}, side{0.75, 0.77, 0.79};
  const double t = kThickness, x = 0.5 * (size.x + t), y = 0.5 * (size.y + t);
  scene::Model model;
  model.file = "(enclosure)";
  model.name = "enclosure";
  scene::Body ground = wall("Floor", {size.x + 2 * t, size.y + 2 * t, t}, {0, 0, -0.5 * t}, floor);
  // To collide with, the half space below: beneath the mesh of a robot that reaches into it, a box costs up to a
  // hundred thousand times more.
  scene::PlacedGeometry plane;
  plane.geometry.shape = scene::Shape::plane;
  plane.geometry.offset = 0.5 * t;
  ground.collision.shapes = {plane};
  model.bodies.push_back(std::move(ground));
  // Walls are a tenth of the enclosure's height, so that cameras outside look over them.
  const double height = 0.1 * size.z;
  model.bodies.push_back(wall("WallFront", {t, size.y + 2 * t, height}, {x, 0, 0.5 * height}, side));
  model.bodies.push_back(wall("WallBack", {t, size.y + 2 * t, height}, {-x, 0, 0.5 * height}, side));
  model.bodies.push_back(wall("WallLeft", {size.x, t, height}, {0, y, 0.5 * height}, side));
  model.bodies.push_back(wall("WallRight", {size.x, t, height}, {0, -y, 0.5 * height}, side));
  return model;
}

}  // namespace ambf::runtime
