#include "physics/meshes/detail/feature_tree.h"

#include <algorithm>
#include <cmath>

#include "physics/meshes/detail/constants.h"
#include "physics/meshes/detail/feature_pair.h"

namespace ambf::physics::detail {

namespace {

class TreeBuilder {
 public:
  explicit TreeBuilder(FeatureMesh& mesh) : mesh_(mesh) {
    if (mesh.triangles.empty()) return;
    leaves_.reserve(mesh.triangles.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      leaves_.push_back(
          {at(static_cast<int>(t), 0) + at(static_cast<int>(t), 1) + at(static_cast<int>(t), 2), static_cast<int>(t)});
    mesh.nodes.reserve(2 * leaves_.size() - 1);
    add_node(0, leaves_.size());
    make_patches();
  }

 private:
  struct Leaf {
    btVector3 centre;  // three times that
    int triangle;
  };
  struct Box {
    btVector3 low, high;
  };

  const btVector3& at(int triangle, int k) const {
    return corner(mesh_, mesh_.triangles[static_cast<std::size_t>(triangle)], static_cast<std::size_t>(k));
  }
  // Twice the area as a vector along the normal.
  btVector3 area(const FeatureMesh::Triangle& t) const {
    return (corner(mesh_, t, 1) - corner(mesh_, t, 0)).cross(corner(mesh_, t, 2) - corner(mesh_, t, 0));
  }

  static FeatureMesh::Node box_around(const btVector3& low, const btVector3& high) {
    FeatureMesh::Node node;
    for (int k = 0; k < 3; ++k) {
      const auto i = static_cast<std::size_t>(k);
      node.middle[i] = static_cast<float>(0.5 * (low[k] + high[k]));
      node.extent[i] =
          static_cast<float>(0.5 * (high[k] - low[k]) + kBoxRounding * (std::abs(low[k]) + std::abs(high[k])));
    }
    return node;
  }

  Box add_node(std::size_t begin, std::size_t end) {
    const std::size_t here = mesh_.nodes.size();
    mesh_.nodes.emplace_back();
    Box box{{0, 0, 0}, {0, 0, 0}};
    if (end - begin == 1) {
      const int t = leaves_[begin].triangle;
      box = {at(t, 0), at(t, 0)};
      for (int k = 1; k < 3; ++k) {
        box.low.setMin(at(t, k));
        box.high.setMax(at(t, k));
      }
      mesh_.nodes[here] = box_around(box.low, box.high);
      mesh_.nodes[here].triangle = t;
      return box;
    }
    btVector3 first = leaves_[begin].centre, last = first;
    for (std::size_t i = begin; i < end; ++i) {
      first.setMin(leaves_[i].centre);
      last.setMax(leaves_[i].centre);
    }
    const int axis = (last - first).maxAxis();
    const std::size_t middle = (begin + end) / 2;
    const auto start = leaves_.begin();
    std::nth_element(start + static_cast<std::ptrdiff_t>(begin), start + static_cast<std::ptrdiff_t>(middle),
                     start + static_cast<std::ptrdiff_t>(end), [axis](const Leaf& a, const Leaf& b) {
                       return a.centre[axis] < b.centre[axis] ||
                              (a.centre[axis] == b.centre[axis] && a.triangle < b.triangle);
                     });
    box = add_node(begin, middle);
    const int right = static_cast<int>(mesh_.nodes.size());
    const Box other = add_node(middle, end);
    box.low.setMin(other.low);
    box.high.setMax(other.high);
    mesh_.nodes[here] = box_around(box.low, box.high);
    mesh_.nodes[here].right = right;
    return box;
  }

  // From the leaves up: children follow their parents.
  void make_patches() {
    mesh_.patches.resize(mesh_.nodes.size());
    std::vector<btVector3> areas(mesh_.nodes.size());
    for (std::size_t i = mesh_.nodes.size(); i-- > 0;) {
      const FeatureMesh::Node& node = mesh_.nodes[i];
      const bool leaf = node.right < 0;
      areas[i] = leaf ? area(mesh_.triangles[static_cast<std::size_t>(node.triangle)])
                      : areas[i + 1] + areas[static_cast<std::size_t>(node.right)];
      btVector3 normal = areas[i];
      if (normal.length2() > 1e-30) normal.normalize();
      mesh_.patches[i] =
          leaf ? patch_of_leaf(node.triangle, normal)
               : merged(node, mesh_.patches[i + 1], mesh_.patches[static_cast<std::size_t>(node.right)], normal);
      mesh_.patches[i].spread = leaf ? leaf_spread(node.triangle, normal)
                                     : std::max(turned(normal, mesh_.patches[i + 1]),
                                                turned(normal, mesh_.patches[static_cast<std::size_t>(node.right)]));
      for (int k = 0; k < 3; ++k) mesh_.patches[i].normal[static_cast<std::size_t>(k)] = static_cast<float>(normal[k]);
    }
  }

  void include(FeatureMesh::Patch& patch, const btVector3& normal, const btVector3& offset, double rise, double fall,
               double radius) const {
    const double along = normal.dot(offset);
    patch.rise = std::max(patch.rise, static_cast<float>(along + rise));
    patch.fall = std::max(patch.fall, static_cast<float>(fall - along));
    patch.radius = std::max(patch.radius, static_cast<float>(offset.length() + radius));
  }

  FeatureMesh::Patch patch_of_leaf(int t, const btVector3& normal) {
    FeatureMesh::Patch patch;
    int first = -1;
    for (int k = 0; k < 3; ++k) {
      if (!mesh_.triangles[static_cast<std::size_t>(t)].owns[static_cast<std::size_t>(k)]) continue;
      if (first < 0) {
        first = k;
        patch.vertex = mesh_.triangles[static_cast<std::size_t>(t)].vertex[static_cast<std::size_t>(k)];
      }
      include(patch, normal, at(t, k) - at(t, first), 0.0, 0.0, 0.0);
    }
    return patch;
  }

  float leaf_spread(int t, const btVector3& normal) {
    return mesh_.triangles[static_cast<std::size_t>(t)].sheet
               ? 2.0F
               : static_cast<float>((mesh_.triangles[static_cast<std::size_t>(t)].normal - normal).length());
  }
  static float turned(const btVector3& normal, const FeatureMesh::Patch& part) {
    return std::min(2.0F, static_cast<float>((normal - mean_normal(part)).length()) + part.spread);
  }

  // Of two patches' vertices the one nearer the middle speaks for both, so that what is known of it need not be found
  // again.
  FeatureMesh::Patch merged(const FeatureMesh::Node& node, const FeatureMesh::Patch& left,
                            const FeatureMesh::Patch& right, const btVector3& normal) const {
    const auto place = [this](const FeatureMesh::Patch& p) {
      return mesh_.vertices[static_cast<std::size_t>(p.vertex)].at;
    };
    FeatureMesh::Patch patch;
    const bool of_left = right.vertex < 0 || (left.vertex >= 0 && (place(left) - node.centre()).length2() <=
                                                                      (place(right) - node.centre()).length2());
    patch.vertex = of_left ? left.vertex : right.vertex;
    if (patch.vertex < 0) return patch;
    const btVector3 origin = place(patch);
    for (const FeatureMesh::Patch* part : {&left, &right}) {
      if (part->vertex < 0) continue;
      const double r = static_cast<double>(part->radius), turned = (normal - mean_normal(*part)).length() * r;
      include(patch, normal, place(*part) - origin, std::min(r, static_cast<double>(part->rise) + turned),
              std::min(r, static_cast<double>(part->fall) + turned), r);
    }
    const double in_box = (origin - node.centre()).length() + node.half().length();
    patch.radius = std::min(patch.radius, static_cast<float>(in_box));
    return patch;
  }

  FeatureMesh& mesh_;
  std::vector<Leaf> leaves_;
};

}  // namespace

void make_tree(FeatureMesh& mesh) { TreeBuilder builder(mesh); }

}  // namespace ambf::physics::detail
