// Contacts of nodes of links with rigid bodies.
#include <BulletSoftBody/btSoftBodyInternals.h>

#include "physics/detail/body_data.h"
#include "physics/soft/detail/link_step.h"
#include "physics/soft/detail/near_shape.h"
#include "physics/soft/detail/soft_data.h"
#include "physics/soft/held_nodes.h"

namespace ambf::physics::detail {

namespace {

// As btSoftColliders::CollideSDF_RS makes it, from an exact distance (m, margin taken off) along a normal (world).
void add_contact(SoftData& data, std::size_t number, BodyData& body, const btVector3& normal, double distance) {
  btSoftBody& soft = *data.soft;
  btRigidBody& rigid = body.rigid;
  const double inverse_mass = data.inverse_mass[number];
  if (!(inverse_mass + rigid.getInvMass() > 0.0)) return;
  data.touched_moving |= !body.is_static();
  const btVector3& at = data.now[number];
  const double step = soft.m_sst.sdt;
  const btVector3 lever = at - rigid.getWorldTransform().getOrigin();
  const btVector3 carried = rigid.getVelocityInLocalPoint(lever) * step;
  const btVector3 slip = at - data.last_good[number] - carried;
  const double along = slip.dot(normal), friction = soft.m_cfg.kDF * rigid.getFriction();
  NodeContact made;
  made.node = static_cast<std::uint32_t>(number);
  made.moving = -1;
  made.normal = normal;
  made.carried = carried;
  made.offset = -normal.dot(at - normal * distance);
  made.yield = inverse_mass * step;
  made.slip = (slip - normal * along).length2() < along * friction * along * friction ? 0.0 : 1.0 - friction;
  made.hardness = body.is_static() ? soft.m_cfg.kKHR : soft.m_cfg.kCHR;
  const auto impulse = [&] {
    return ImpulseMatrix(step, inverse_mass, rigid.getInvMass(), rigid.getInvInertiaTensorWorld(), lever);
  };
  if (data.is_plain) {
    if (!rigid.hasContactResponse()) return;
    if (rigid.getInvMass() > 0.0) {
      made.moving = static_cast<std::int32_t>(data.moving_contacts.size());
      data.moving_contacts.push_back({&rigid, lever, impulse()});
    } else if (inverse_mass != data.impulse_of) {  // the same in all directions, wherever it is
      data.impulse_on_static = impulse()[0][0];
      data.impulse_of = inverse_mass;
    }
    made.impulse = data.impulse_on_static;
    data.contacts.push_back(made);
    return;
  }
  btSoftBody::RContact contact;
  contact.m_cti.m_colObj = &rigid;
  contact.m_cti.m_normal = made.normal;
  contact.m_cti.m_offset = made.offset;
  contact.m_node = &soft.m_nodes[static_cast<int>(number)];
  contact.m_c0 = impulse();
  contact.m_c1 = lever;
  contact.m_c2 = made.yield;
  contact.m_c3 = made.slip;
  contact.m_c4 = made.hardness;
  contact.t1 = contact.t2 = btVector3(0, 0, 0);  // of multi bodies only
  soft.m_rcontacts.push_back(contact);
}

}  // namespace

void add_contacts(SoftData& data, BodyData& body, const btCollisionShape& shape, const btTransform& pose) {
  if (shape.isCompound()) {
    const auto& compound = static_cast<const btCompoundShape&>(shape);
    for (int i = 0; i < compound.getNumChildShapes(); ++i)
      add_contacts(data, body, *compound.getChildShape(i), pose * compound.getChildTransform(i));
    return;
  }
  const double margin = data.soft->getCollisionShape()->getMargin();
  const MetShape met(shape);
  if (!met.can_be_met) return;
  const Box box = box_of(shape, pose, margin);
  if (!box.overlaps(data.low, data.high)) return;
  data.runs.each_near(box, data.now.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (!box.contains(data.now[i])) continue;
      const auto found = met.near(pose.invXform(data.now[i]), margin);
      if (found && !held_off(data.grips, *data.owner, i, body))
        add_contact(data, i, body, pose.getBasis() * found->normal, found->distance - margin);
    }
  });
}

}  // namespace ambf::physics::detail
