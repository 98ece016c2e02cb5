// What exists: the immutable list of objects and joints that a Frame's arrays belong to. The loader's catalogue makes a
// new one at every structural change; frames share it. Read by any thread, written by none. C++17.
#pragma once

#include <any>
#include <memory>
#include <string>
#include <vector>

#include "math/types.h"
#include "state/ids.h"
#include "state/index_list.h"
#include "state/parameters.h"
#include "state/view.h"

namespace ambf::mesh {
struct Appearance;  // mesh/appearance.h: what render draws; opaque to everyone else
}

namespace ambf::state {

// What every object has: identity, topic names, rates.
struct ObjectInfo {
  ObjectId id;
  ObjectKind kind = ObjectKind::rigid_body;
  ModelId model = kWorldModel;
  std::string name;  // namespace + name + conflict number, e.g. "/ambf/env/psm/baselink"; topics are name + "/State"
  std::string local_name;      // the same without the namespace, e.g. "baselink"
  std::string identifier;      // namespace + block identifier + conflict number, e.g. "/ambf/env/psm/BODY baselink"
  std::uint32_t slot = kNone;  // index into the frame's column of its kind
  bool passive = false;        // no topics
  double rate_low_hz = 50.0;   // publishing rate while nobody commands the object
  double rate_high_hz = 1000.0;
};

// What only bodies have. Joint order is that of the reference (Alg. 1): the index a command message uses.
struct BodyInfo {
  std::uint32_t object = kNone;  // index into Structure::objects
  double mass = 0.0;             // kg; 0 is static
  math::Vec3 inertia;            // principal, kg m^2, at the centre of mass
  math::Pose T_body_com;         // the ADF's inertial offset
  IndexList children;            // indices into Structure::objects of all descendants, in the reference's order
  IndexList joints;              // slots of all active (not passive) descendant joints, in the reference's order
  BodyParameters parameters;     // as loaded
  ControllerOutput linear_output = ControllerOutput::velocity, angular_output = ControllerOutput::velocity;
  bool publish_children_names = false;
  bool publish_joint_names = true;
  bool publish_joint_positions = true;                           // also velocities and efforts
  std::shared_ptr<const mesh::Appearance> appearance;            // drawn
  std::shared_ptr<const mesh::Appearance> collision_appearance;  // drawn when collision shapes are shown; may be null
};

enum class JointType : std::uint8_t {
  fixed,
  revolute,
  prismatic,
  linear_spring,
  torsion_spring,
  p2p,
  cone_twist,
  six_dof,
  six_dof_spring
};

// How far joints with several free directions go: cone twist, six dof, six dof spring. The joint's frame has its z
// along the axis.
struct JointSpan {
  math::Pose T_parent_joint, T_child_joint;  // the joint's frame in each body; they agree where every coordinate is 0
  math::Vec3 cone;  // cone twist: of the swing about x and y, of the twist about z, both ways; rad
  // Six dof: shifts along the parent's joint frame, and the turns of R = Rx Ry Rz of the child's in it. Low > high:
  // free.
  math::Vec3 linear_low, linear_high;    // m
  math::Vec3 angular_low, angular_high;  // rad
};

struct JointInfo {
  std::uint32_t object = kNone;
  JointType type = JointType::fixed;
  std::uint32_t parent_body = kNone;  // slots of bodies
  std::uint32_t child_body = kNone;
  std::string name;  // as published in joint_names: the ADF name without namespace
  bool passive = false;
  bool has_limits = false;
  double lower = 0.0, upper = 0.0;        // rad or m
  math::Vec3 pivot_parent, axis_parent;   // in the parent's body frame
  JointParameters parameters;             // as loaded
  std::shared_ptr<const JointSpan> span;  // null: the joint has one free direction, or none that is limited
  ControllerOutput output = ControllerOutput::velocity;
};

// What every object has that hangs on another one or in the world (KindInfo::has_parent).
struct PlacedInfo {
  std::uint32_t object = kNone;         // index into Structure::objects
  std::uint32_t parent_object = kNone;  // likewise; kNone: the world
  std::string parent_name;              // as requested
};

struct CameraInfo : PlacedInfo {
  Lens lens;  // as loaded
  bool visible = true;
  unsigned monitor = 0;
  std::vector<std::string> controlling_devices;
  double pan = 1.0, rotate = 1.0, scroll = 1.0, arcball = 1.0;  // mouse multipliers
  math::Vec3 look_at;                                           // in the parent's frame: where the view turns about
  bool frames_scene = false;  // nobody described it: a window that shows it puts it where it sees everything
  ImageStream image, depth;
  DepthNoise depth_noise;
  ShaderFiles preprocessing_shaders;  // instead of all objects' shaders, for what is published
  ShaderFiles depth_shaders;          // compute what is published as depth
  bool multipass = false;             // transparent surfaces exact in their order, at the price of more passes
};

struct LightInfo : PlacedInfo {
  Beam beam;  // as loaded
};

struct ModelInfo {
  ModelId id = kWorldModel;
  std::string name;  // file name + conflict number
  std::string file;
  bool environment = false;  // the room that the world file names, or the walled ground in its place
};

struct Structure {
  std::uint64_t version = 0;
  std::string world_name;  // world namespace + "World", e.g. "/ambf/env/World"
  std::vector<ModelInfo> models;
  std::vector<ObjectInfo> objects;  // of all kinds, in load order
  std::vector<BodyInfo> bodies;
  std::vector<JointInfo> joints;
  std::vector<CameraInfo> cameras;
  std::vector<LightInfo> lights;
  std::vector<std::any> registered;       // tables of registered kinds, by kind: state::table (state/kind_rows.h)
  math::Vec3 gravity_world;               // m/s^2, of the world file
  std::shared_ptr<const WorldLook> look;  // never null once a world is loaded
};

// Index into objects of the object with this id, or kNone when it is gone.
std::uint32_t find(const Structure& structure, ObjectId id);
// By full name or identifier, else by unique substring of an identifier (the original's rule); kNone when absent or
// ambiguous.
std::uint32_t find(const Structure& structure, const std::string& name, ObjectKind kind);

}  // namespace ambf::state
