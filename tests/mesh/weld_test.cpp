// Welding against Table 5.1 of the dissertation and against comparing every pair.
#include "mesh/weld.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
#include <random>

#include "tests/mesh/files.h"

namespace ambf::mesh {
namespace {

using math::Vec3;
using test::binary_stl;

TEST(Weld, GivesTable5_1) {
  // Dissertation Table 5.1, counted from 1: vertices 4, 6, 7, 9, 10, 12 repeat 2, 3, 2, 5, 8, 5.
  const std::vector<int> place = {1, 2, 3, 2, 5, 3, 2, 8, 5, 8, 11, 5};
  std::vector<Vec3> vertices;
  for (int p : place) vertices.push_back({std::sin(p), std::cos(3.0 * p), p * 0.1});
  const Weld w = weld(vertices, 1e-6);
  const std::vector<std::uint32_t> first = {1, 2, 3, 2, 5, 3, 2, 8, 5, 8, 11, 5},
                                   welded = {1, 2, 3, 2, 4, 3, 2, 5, 4, 5, 6, 4};
  for (std::size_t i = 0; i < place.size(); ++i) {
    EXPECT_EQ(w.first[i] + 1, first[i]);
    EXPECT_EQ(w.welded[i] + 1, welded[i]);
  }
}

TEST(Weld, AgreesWithComparingEveryPair) {
  std::mt19937 rng(1);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  for (double epsilon : {0.0, 1e-9, 1e-3, 0.05, 0.4, 5.0}) {
    std::vector<Vec3> v;
    for (int i = 0; i < 600; ++i) {
      // Some anew, some near an earlier one, some equal to one, some flat in a coordinate.
      Vec3 p{u(rng), i % 3 == 0 ? 0.0 : u(rng), u(rng)};
      if (i % 4 == 1) p = v[rng() % v.size()] + Vec3{u(rng), u(rng), u(rng)} * epsilon;
      if (i % 4 == 2) p = v[rng() % v.size()];
      v.push_back(p);
    }
    const Weld w = weld(v, epsilon);
    std::vector<std::uint32_t> originals;
    for (std::uint32_t i = 0; i < v.size(); ++i) {
      std::uint32_t expected = i;
      for (std::uint32_t j : originals) {
        if (math::dot(v[j] - v[i], v[j] - v[i]) <= epsilon * epsilon) {
          expected = j;
          break;
        }
      }
      if (expected == i) originals.push_back(i);
      ASSERT_EQ(w.first[i], expected) << "epsilon " << epsilon << " vertex " << i;
    }
    EXPECT_EQ(w.distinct, originals);
  }
}

TEST(Weld, DistinctPointsOfAFineTipStayDistinct) {
  // 200 points close together far from a large box: the original's grid of bounds / n merges them.
  std::vector<Vec3> v = {{-1, -1, -1}, {1, 1, 1}};
  for (int i = 0; i < 200; ++i) v.push_back({1.0, 1.0, 1.0 + 1e-5 * (i + 1)});
  EXPECT_EQ(weld(v, kWeldEpsilonRelative * bounds_of(v).diagonal()).distinct.size(), v.size());
}

// A flat sheet of n x n nodes as unconnected triangles.
std::vector<Vec3> sheet_corners(int n) {
  std::vector<Vec3> corners;
  const auto node = [](int i, int j) { return Vec3{0.02 * i, 0.02 * j, 0.0}; };
  for (int i = 0; i + 1 < n; ++i) {
    for (int j = 0; j + 1 < n; ++j) {
      for (const Vec3& p :
           {node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j), node(i + 1, j + 1), node(i, j + 1)}) {
        corners.push_back(p);
      }
    }
  }
  return corners;
}

TEST(Weld, FlatSheetFromStlHas900Nodes) {
  const LoadResult r = load_bytes(binary_stl(sheet_corners(30)), "sheet.stl");
  ASSERT_TRUE(r.ok);
  const CollisionMesh once = make_collision_mesh(r.mesh);
  EXPECT_EQ(once.vertices.size(), 900U);
  EXPECT_EQ(once.triangles.size(), 2U * 29U * 29U);
}

TEST(Weld, WeldingTwiceIsWeldingOnceAndKeepsTheOrderOfTriangles) {
  const std::vector<Vec3> corners = sheet_corners(12);
  Mesh soup;
  soup.submeshes.emplace_back();
  for (const Vec3& p : corners) {
    for (double value : {p.x, p.y, p.z}) soup.submeshes[0].positions.push_back(static_cast<float>(value));
    soup.submeshes[0].triangles.push_back(static_cast<std::uint32_t>(soup.submeshes[0].triangles.size()));
  }
  Weld mapping;
  const CollisionMesh once = make_collision_mesh(soup, kWeldEpsilonRelative, &mapping);
  ASSERT_EQ(mapping.welded.size(), corners.size());
  for (std::size_t t = 0; t < once.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(once.triangles[t][k], mapping.welded[3 * t + k]);
      EXPECT_LT(math::norm(once.vertices[once.triangles[t][k]] - corners[3 * t + k]), 1e-6);
    }
  }
  const Weld again = weld(once.vertices, kWeldEpsilonRelative * once.bounds.diagonal());
  EXPECT_EQ(again.distinct.size(), once.vertices.size());
}

double seconds_to_weld(const std::vector<Vec3>& v, double epsilon) {
  double best = 1e9;
  for (int k = 0; k < 3; ++k) {
    timespec a{}, b{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &a);
    const Weld w = weld(v, epsilon);
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &b);
    EXPECT_FALSE(w.distinct.empty());
    best = std::min(best, static_cast<double>(b.tv_sec - a.tv_sec) + 1e-9 * static_cast<double>(b.tv_nsec - a.tv_nsec));
  }
  return best;
}

std::vector<Vec3> random_vertices(std::size_t n, double size) {
  std::mt19937 rng(2);
  std::uniform_real_distribution<double> u(0.0, size);
  std::vector<Vec3> v;
  for (std::size_t i = 0; i < n; ++i) v.push_back(i % 3 == 0 ? Vec3{u(rng), u(rng), u(rng)} : v[rng() % i]);
  return v;
}

TEST(Weld, TimeIsLinear) {
  const double small = seconds_to_weld(random_vertices(60'000, 1.0), 1e-6);
  const double large = seconds_to_weld(random_vertices(960'000, 1.0), 1e-6);
  RecordProperty("seconds_960000", std::to_string(large));
  // 16 times the vertices; up to 4 times as much for each, for caches that others use too; 256 if pairs were compared.
  EXPECT_LT(large / small, 16.0 * 8.0);
}

TEST(Weld, VerticesPackedAsDenselyAsTheyStayDistinctCostABoundedFactor) {
  // 100000 places in a cube of 40 tolerances: the ratio is about 1.5, and about 20 with cells of 16 tolerances.
  const double spread = seconds_to_weld(random_vertices(300'000, 1.0), 1e-6);
  const double packed = seconds_to_weld(random_vertices(300'000, 40e-6), 1e-6);
  RecordProperty("ratio", std::to_string(packed / spread));
  EXPECT_LT(packed / spread, 8.0);
}

}  // namespace
}  // namespace ambf::mesh
