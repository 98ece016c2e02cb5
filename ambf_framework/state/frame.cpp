#include "state/frame.h"

#include <cstring>

namespace ambf::state {

std::unique_ptr<Frame> make_frame(std::shared_ptr<const Structure> structure) {
  auto frame = std::make_unique<Frame>();
  frame->bodies.resize(structure->bodies.size());
  frame->joints.resize(structure->joints.size());
  frame->body_parameters.resize(structure->bodies.size());
  frame->joint_parameters.resize(structure->joints.size());
  frame->cameras.resize(structure->cameras.size());
  frame->lights.resize(structure->lights.size());
  for (std::size_t i = 0; i < structure->cameras.size(); ++i) frame->cameras[i].lens = structure->cameras[i].lens;
  for (std::size_t i = 0; i < structure->lights.size(); ++i) frame->lights[i].beam = structure->lights[i].beam;
  frame->contacts.reserve(kMaxContactsInFrame);
  frame->picks.reserve(kMaxPicks);
  frame->commands.reserve(structure->bodies.size() + structure->cameras.size() + structure->lights.size());
  frame->structure = std::move(structure);
  return frame;
}

namespace {

class Fnv1a {
 public:
  void add(double value) { add_bytes(&value, sizeof value); }
  void add(std::uint64_t value) { add_bytes(&value, sizeof value); }
  void add(const math::Vec3& v) { add(v.x), add(v.y), add(v.z); }
  void add(const math::Pose& p) {
    add(p.position);
    add(p.orientation.x), add(p.orientation.y), add(p.orientation.z), add(p.orientation.w);
  }
  std::uint64_t value() const { return hash_; }

 private:
  void add_bytes(const void* data, std::size_t size) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < size; ++i) hash_ = (hash_ ^ bytes[i]) * 0x100000001b3ull;
  }
  std::uint64_t hash_ = 0xcbf29ce484222325ull;
};

}  // namespace

std::uint64_t state_hash(const Frame& frame) {
  Fnv1a hash;
  hash.add(std::uint64_t{frame.sim_step});
  hash.add(frame.sim_time);
  for (const BodyState& body : frame.bodies) {
    hash.add(body.T_world_body);
    hash.add(body.twist_world.linear), hash.add(body.twist_world.angular);
    hash.add(body.wrench_body.force), hash.add(body.wrench_body.torque);
  }
  for (const JointState& joint : frame.joints) {
    hash.add(joint.position), hash.add(joint.velocity), hash.add(joint.effort);
  }
  for (const ContactState& contact : frame.contacts) {
    hash.add(contact.point_world), hash.add(contact.normal_world), hash.add(contact.impulse);
  }
  hash.add(std::uint64_t{frame.contacts_total});
  return hash.value();
}

}  // namespace ambf::state
