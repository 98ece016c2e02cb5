// Descriptions of everything an ADF file can say, as plain structs whose initial values are the defaults: what the
// parser fills, what the loader builds from, what can be written back. Rows in blocks/ bind keys to their members. SI
// units, radians. Never touches Bullet, files or threads.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "math/types.h"
#include "state/devices.h"
#include "state/structure.h"

namespace ambf::scene {

// Where a block stands in its file, for later diagnostics (1-based).
struct Location {
  int line = 0, column = 0;
};

// What every object block has (ADF 1.2 - 1.4).
struct Identity {
  std::string identifier;  // block key, spaces kept
  std::string name;        // spaces removed
  std::string name_space;  // resolved: header namespace + block namespace, or absolute
  bool passive = false;
  double rate_low_hz = 50.0, rate_high_hz = 1000.0;
  Location where;
};

enum class Shape { box, sphere, cylinder, cone, capsule, plane };
enum class Axis { x, y, z };

// A primitive in its own frame; only the fields of its shape are meant.
struct Geometry {
  Shape shape = Shape::box;
  math::Vec3 size;                    // box: full lengths
  double radius = 0.0, height = 0.0;  // height of a capsule includes its caps
  Axis axis = Axis::z;                // cylinder, cone, capsule
  math::Vec3 normal{0.0, 0.0, 1.0};   // plane
  double offset = 0.0;                // plane: distance along the normal
};

struct Color {
  double r = 0.0, g = 0.0, b = 0.0;
};

struct Material {
  Color ambient{0.3, 0.3, 0.3}, diffuse{0.7, 0.7, 0.7}, specular{1.0, 1.0, 1.0}, emission;
  double alpha = 1.0;
  unsigned shininess = 64;
  double metallic = 0.0;  // 0..1
};

struct PlacedGeometry {
  Geometry geometry;
  math::Pose offset;                      // in the body frame
  std::optional<Material> material = {};  // where it is drawn; none: that of the body
};

// A mesh file in its own frame: beside primitives, or several of them.
struct PlacedMesh {
  std::string file;                       // resolved
  std::vector<std::string> candidates;    // further places to look for it, in order
  math::Vec3 scale{1.0, 1.0, 1.0};        // of its axes, besides that of the body; below 0 mirrors
  math::Pose offset;                      // in the body frame
  std::optional<Material> material = {};  // where it is drawn; none: that of the body, else the mesh's own
};

struct Shaders {
  std::string path, vertex, fragment;  // path resolved
  bool given() const { return !vertex.empty(); }
};

struct Visual {
  std::string mesh_file;                     // resolved; empty: none
  std::vector<std::string> mesh_candidates;  // further places to look for it, in order
  bool remove_duplicates = false;
  std::vector<PlacedGeometry> shapes;  // take precedence over the mesh, as `meshes` do
  std::vector<PlacedMesh> meshes;      // of `compound shape`, drawn beside `shapes`
  double scale = 1.0;                  // of meshes' vertices and of the shapes' sizes; offsets are as written
  bool visible = true;
  std::optional<Material> material;  // none: the mesh's own
  Shaders shaders;
};

enum class CollisionMeshType { convex_hull, convex_mesh, triangle_mesh, point_cloud };

struct Collision {
  std::string mesh_file;
  std::vector<std::string> mesh_candidates;
  CollisionMeshType mesh_type = CollisionMeshType::triangle_mesh;
  std::vector<PlacedGeometry> shapes;  // take precedence over the mesh, as `meshes` do
  std::vector<PlacedMesh> meshes;      // of `compound collision shape`: their hulls collide
  std::optional<math::Pose> offset;    // `collision offset`, single shape or mesh; absent: inertial offset
  double scale = 1.0;                  // of meshes' vertices and of the shapes' sizes; offsets are as written
  double margin = 0.001;               // m
  std::vector<int> groups;             // bodies with groups collide only where they share one
};

using state::ChannelGains;
using state::ControllerOutput;
using state::JointGains;
using state::Surface;

struct Body {
  Identity identity;
  Visual visual;
  Collision collision;
  double mass = 1.0;                          // kg; 0: static
  std::optional<math::Vec3> inertia;          // principal, kg m^2, at the COM; absent: from the collision shape
  std::optional<math::Pose> inertial_offset;  // T_body_com; absent: vertex mean of the collision mesh, else identity
  std::optional<math::Vec3> gravity;          // m/s^2; absent: model's, else world's
  math::Pose T_world_body;                    // `location`
  double scale = 1.0;  // also of the joint pivots on this body; inertial offset and location are as written
  Surface surface;
  ChannelGains linear, angular;  // Cartesian controller; a scalar in the file sets all three axes
  bool publish_children_names = false, publish_joint_names = true, publish_joint_positions = true;
  bool hold = false;  // position targets stay in force when their command ends
};

struct SixDofLimits {
  math::Vec3 linear_low{-1.2, -1.2, -1.2}, linear_high{1.2, 1.2, 1.2};
  math::Vec3 angular_low{-1.2, -1.2, -1.2}, angular_high{1.2, 1.2, 1.2};
};

struct SixDofSpring {
  math::Vec3 linear_stiffness{1, 1, 1}, angular_stiffness{1, 1, 1};
  math::Vec3 linear_equilibrium, angular_equilibrium;
  math::Vec3 linear_damping{0.7, 0.7, 0.7}, angular_damping{0.7, 0.7, 0.7};
};

// `mimic`: q = multiplier q_joint + offset (rad or m), kept from both sides.
struct Mimic {
  std::string joint;  // as written; empty: none
  double multiplier = 1.0, offset = 0.0;
};

struct Joint {
  Identity identity;
  std::string parent, child;  // as written; looked up by the rules of ADF 1.5
  state::JointType type = state::JointType::revolute;
  math::Vec3 parent_pivot, child_pivot;                  // m, body frames
  math::Vec3 parent_axis{0, 0, 1}, child_axis{0, 0, 1};  // unit
  double child_offset = 0.0;                             // rad: `offset` or `child offset`
  double joint_offset = 0.0;                             // rad: shifts the zero of the joint
  std::optional<std::array<double, 2>> limits;           // low, high; absent: continuous
  JointGains controller;
  double max_motor_impulse = 0.1;  // Ns
  bool enable_motor = true, enable_feedback = false;
  std::optional<double> erp, cfm;     // absent: model's, else 0.8 and 0
  double damping = 0.0;               // Ns/m or Nms/rad, viscous, all joint types (EQUATIONS: implicit)
  double stiffness = 0.0;             // springs
  std::optional<double> equilibrium;  // springs; absent: middle of the limits
  bool ignore_inter_collision = true;
  bool hold = false;                      // a position target stays in force when its command ends
  math::Vec3 cone_limits{0.7, 0.7, 0.7};  // cone twist, rad
  SixDofLimits six_dof;
  SixDofSpring spring;
  Mimic mimic;
};

// Factors on what the mouse does with a camera.
struct MouseSpeed {
  double pan = 1.0, rotate = 1.0, scroll = 1.0, arcball = 1.0;
};

struct Camera {
  Identity identity;
  std::string parent;  // empty: the world
  math::Vec3 location, look_at, up{0, 0, 1};
  state::Lens lens;
  std::vector<std::string> controlling_devices;
  unsigned monitor = 0;
  bool visible = true;
  state::ImageStream image, depth{.interval = 10};
  state::DepthNoise depth_noise{.mean = 0.1, .std_dev = 0.001};
  Shaders preprocessing_shaders, depth_compute_shaders;
  bool multipass = false;
  MouseSpeed mouse;
};

struct Light {
  Identity identity;
  std::string parent;
  math::Vec3 location{0, 0, 5}, direction{0, 0, -1};
  state::Beam beam;
};

struct BlockKind;

// A block of a kind that scene/ has no struct for.
struct KindBlock {
  const BlockKind* kind = nullptr;
  Identity identity;
  std::shared_ptr<const void> description;  // what the kind's rows fill

  template <class T>
  const T& as() const {
    return *static_cast<const T*>(description.get());
  }
};

// A model file. Only blocks named in its header lists are here, in header order.
struct Model {
  std::string file;  // as given
  std::string name;  // file name without folders
  bool ignore_inter_collision = false;
  std::optional<math::Vec3> gravity;
  std::optional<double> joint_erp, joint_cfm;
  std::vector<Body> bodies;
  std::vector<Joint> joints;
  std::vector<Camera> cameras;
  std::vector<Light> lights;
  std::vector<KindBlock> blocks;  // of registered kinds
  Shaders shaders;
};

struct Skybox {
  std::string path, right, left, top, bottom, front, back;
  Shaders shaders;
};

struct World {
  std::string file;
  std::string name_space;
  std::string environment_file;         // resolved; empty: the default walled ground
  math::Vec3 enclosure{4.0, 4.0, 3.0};  // length, width, height, m; used only without environment
  unsigned max_iterations = 10;
  bool max_iterations_given = false;  // else the cap of 22 sub-steps (at 1 ms) holds (dissertation §3.4.1)
  math::Vec3 gravity{0.0, 0.0, -9.8};
  std::vector<Camera> cameras;
  std::vector<Light> lights;
  Shaders shaders;
  std::optional<Skybox> skybox;
  std::string solver;              // "", "direct", "si", "mlcp"
  unsigned solver_iterations = 0;  // 0: default
};

struct Launch {
  std::string file;
  std::string world_file, color_file, input_devices_file;  // resolved
  std::vector<std::string> model_files;                    // resolved, index = -l index; empty: nothing has that place
  std::vector<std::string> world_files;  // resolved; empty, or for each of model_files the world it is shown in
};

// P and D of one channel of a device; none: not given.
struct DeviceGains {
  std::optional<math::Vec3> p, d;
  bool given() const { return p || d; }
};

enum class HapticGainKind { automatic, stiffness, ratio };
// What opens the hardware: key `driver`. Options as text, those in maps as "axes/x".
struct DeviceDriver {
  std::string type;
  std::map<std::string, std::string> options;
  std::optional<math::Pose> T_base_offset, T_tip_offset;
};

struct InputDevice {
  std::string name;  // block's key
  std::string hardware_name;
  DeviceDriver driver;
  DeviceGains haptic_linear, haptic_angular, controller_linear, controller_angular;
  // What the haptic gains mean: as the block says, else as the form of the file suggests.
  HapticGainKind haptic_gain_kind = HapticGainKind::automatic;
  double deadband_N = 1e-3;
  double max_force_N = 0.0, max_torque_Nm = 0.0, max_jerk_N_per_ms = 0.0;  // 0: none but the hardware's
  double workspace_scaling = 1.0, camera_scaling = 10.0;
  std::optional<math::Pose> location;
  math::Quat orientation_offset;
  std::string multibody_file;  // resolved
  std::string root_link;
  bool enable_joint_control = true;
  std::vector<std::string> cameras;  // empty: all
  state::ButtonMapping buttons;
  double dominance = 0.5;
  state::OnLoss on_loss = state::OnLoss::hold;
  double ramp_s = 1.0;
  std::string color;
  bool visible = false;
  double visible_size = 1.0;
  std::string visible_color;
};

struct InputDevices {
  std::string file;
  std::vector<std::string> listed;  // all names of the list, those of wrong blocks too: what `-i` counts
  std::vector<InputDevice> devices;
};

}  // namespace ambf::scene
