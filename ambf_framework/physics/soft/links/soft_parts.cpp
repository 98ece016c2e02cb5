// Parts of soft bodies of links that differ from the rest.
#include <algorithm>
#include <map>

#include "physics/soft/detail/soft_data.h"

namespace ambf::physics::detail {

// Evenly, but for parts that are denser.
std::vector<double> masses_of_parts(const SoftDefinition& given) {
  std::vector<double> mass(given.nodes.size(), 1.0);
  for (const SoftPart& part : given.parts)
    for (const std::uint32_t node : part.nodes) mass[node] *= part.density;
  double all = 0.0;
  for (const double each : mass) all += each;
  for (double& each : mass) each *= given.mass / all;
  return mass;
}

// Bullet corrects a link by its material's kLST: above 1 it would overshoot.
void stiffen_parts(btSoftBody& soft, const SoftDefinition& given) {
  if (given.parts.empty()) return;
  std::vector<double> stiffness(static_cast<std::size_t>(soft.m_links.size()), given.config.kLST);
  for (const SoftPart& part : given.parts) {
    std::vector<bool> in(given.nodes.size(), false);
    for (const std::uint32_t node : part.nodes) in[node] = true;
    for (int i = 0; i < soft.m_links.size(); ++i) {
      const btSoftBody::Link& link = soft.m_links[i];
      if (in[static_cast<std::size_t>(link.m_n[0] - &soft.m_nodes[0])] &&
          in[static_cast<std::size_t>(link.m_n[1] - &soft.m_nodes[0])])
        stiffness[static_cast<std::size_t>(i)] *= part.stiffness;
    }
  }
  std::map<double, btSoftBody::Material*> materials{{given.config.kLST, soft.m_materials[0]}};
  for (int i = 0; i < soft.m_links.size(); ++i) {
    const double wanted = std::min(stiffness[static_cast<std::size_t>(i)], std::max(1.0, given.config.kLST));
    btSoftBody::Material*& material = materials[wanted];
    if (material == nullptr) {
      material = soft.appendMaterial();
      *material = *soft.m_materials[0];
      material->m_kLST = wanted;
    }
    soft.m_links[i].m_material = material;
  }
}

}  // namespace ambf::physics::detail
