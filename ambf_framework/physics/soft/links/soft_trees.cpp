// What Bullet's own step of a soft body goes by: trees of boxes around nodes and faces, normals, joints of clusters.
#include <map>
#include <numeric>

#include "physics/soft/detail/soft_data.h"

namespace ambf::physics::detail {

namespace {

// Which things hang together, over any number of others.
class Pieces {
 public:
  explicit Pieces(int count) : above_(static_cast<std::size_t>(count)), left_(count) {
    std::iota(above_.begin(), above_.end(), 0);
  }
  void join(int a, int b) {
    const std::size_t top_a = top(a), top_b = top(b);
    if (top_a == top_b) return;
    above_[top_a] = static_cast<int>(top_b);
    --left_;
  }
  bool one() const { return left_ <= 1; }

 private:
  std::size_t top(int of) {
    auto at = static_cast<std::size_t>(of);
    while (above_[at] != static_cast<int>(at))
      at = static_cast<std::size_t>(above_[at] = above_[static_cast<std::size_t>(above_[at])]);
    return at;
  }
  std::vector<int> above_;
  int left_;
};

int number_of(const btSoftBody& soft, const btSoftBody::Node* node) {
  return static_cast<int>(node - &soft.m_nodes[0]);
}

bool are_nodes_one_piece(const btSoftBody& soft) {
  Pieces pieces(soft.m_nodes.size());
  for (int i = 0; i < soft.m_links.size(); ++i)
    pieces.join(number_of(soft, soft.m_links[i].m_n[0]), number_of(soft, soft.m_links[i].m_n[1]));
  return pieces.one();
}

// Faces are neighbours over an edge, if they are not one and the same.
bool are_faces_one_piece(const btSoftBody& soft) {
  Pieces pieces(soft.m_faces.size());
  std::map<std::pair<int, int>, int> at_edge;
  const auto corners = [&](int face) {
    return std::array{number_of(soft, soft.m_faces[face].m_n[0]), number_of(soft, soft.m_faces[face].m_n[1]),
                      number_of(soft, soft.m_faces[face].m_n[2])};
  };
  const auto sum = [](const std::array<int, 3>& of) { return static_cast<long>(of[0]) + of[1] + of[2]; };
  for (int i = 0; i < soft.m_faces.size(); ++i) {
    const std::array<int, 3> own = corners(i);
    for (std::size_t j = 2, k = 0; k < 3; j = k++) {
      const auto [known, is_new] = at_edge.emplace(std::minmax(own[j], own[k]), i);
      if (!is_new && sum(corners(known->second)) != sum(own)) pieces.join(known->second, i);
    }
  }
  return pieces.one();
}

// Bullet joins neighbours, then those, until one is left: of a mesh in several pieces it would do so for ever. There
// each leaf is put in by itself, in the order of nodes and of faces.
void build_trees(const SoftData& data) {
  btSoftBody& soft = *data.soft;
  if (data.nodes_are_one_piece) {
    soft.rebuildNodeTree();
  } else {
    soft.m_ndbvt.clear();
    for (int i = 0; i < soft.m_nodes.size(); ++i) {
      btSoftBody::Node& node = soft.m_nodes[i];
      node.m_leaf = soft.m_ndbvt.insert(btDbvtVolume::FromCR(node.m_x, 0.0), &node);
    }
  }
  if ((soft.m_cfg.collisions & btSoftBody::fCollision::VF_SS) == 0) return;
  if (data.faces_are_one_piece) {
    soft.initializeFaceTree();
    return;
  }
  soft.m_fdbvt.clear();
  for (int i = 0; i < soft.m_faces.size(); ++i) {
    btSoftBody::Face& face = soft.m_faces[i];
    std::array<const btVector3*, 3> corner{&face.m_n[0]->m_x, &face.m_n[1]->m_x, &face.m_n[2]->m_x};
    face.m_leaf = soft.m_fdbvt.insert(btDbvtVolume::FromPoints(corner.data(), 3), &face);
  }
}

}  // namespace

void SoftData::follow_bullet() {
  for (std::size_t i = 0; i < now.size(); ++i) {
    const btSoftBody::Node& node = soft->m_nodes[static_cast<int>(i)];
    now[i] = node.m_x;
    velocity[i] = node.m_v;
  }
}

// Once: no step, nor a restart, changes it.
void SoftData::find_pieces() {
  nodes_are_one_piece = are_nodes_one_piece(*soft);
  faces_are_one_piece = are_faces_one_piece(*soft);
}

// What its steps go by, which for thousands of nodes takes tens of milliseconds.
void SoftData::restart_bullet() {
  for (int i = 0; i < soft->m_joints.size(); ++i) {
    soft->m_joints[i]->~Joint();
    btAlignedFree(soft->m_joints[i]);
  }
  soft->m_joints.clear();
  build_trees(*this);
  soft->m_cdbvt.clear();
  for (int i = 0; i < soft->m_clusters.size(); ++i) soft->m_clusters[i]->m_leaf = nullptr;
  soft->updateNormals();
  soft->updateBounds();
  follow_bullet();
}

}  // namespace ambf::physics::detail
