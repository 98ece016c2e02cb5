// Lineage against an independent answer: the transitive closure of the graph, found by walking it.
#include "model/detail/lineage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <vector>

namespace ambf::model {
namespace {

using Numbers = std::vector<std::uint32_t>;

struct Edge {
  std::uint32_t joint, parent, child;
};

std::set<std::uint32_t> as_set(const Numbers& list) { return {list.begin(), list.end()}; }

// Bodies that can be reached from `body` along the joints, without itself.
std::set<std::uint32_t> reachable(const std::vector<Edge>& edges, std::uint32_t body) {
  std::set<std::uint32_t> found;
  Numbers open{body};
  while (!open.empty()) {
    const std::uint32_t at = open.back();
    open.pop_back();
    for (const Edge& edge : edges)
      if (edge.parent == at && found.insert(edge.child).second) open.push_back(edge.child);
  }
  found.erase(body);
  return found;
}

std::set<std::uint32_t> joints_below(const std::vector<Edge>& edges, std::uint32_t body) {
  std::set<std::uint32_t> above = reachable(edges, body);
  above.insert(body);
  std::set<std::uint32_t> joints;
  for (const Edge& edge : edges)
    if (above.count(edge.parent) != 0) joints.insert(edge.joint);
  return joints;
}

Lineage lineage_of(const std::vector<Edge>& edges) {
  Lineage lineage;
  for (const Edge& edge : edges) lineage.add(edge.joint, edge.parent, edge.child);
  return lineage;
}

void expect_closure(const Lineage& lineage, const std::vector<Edge>& edges, std::uint32_t bodies) {
  for (std::uint32_t body = 0; body < bodies; ++body) {
    const std::set<std::uint32_t> below = reachable(edges, body);
    ASSERT_EQ(as_set(lineage.descendants(body)), below) << "body " << body;
    ASSERT_EQ(lineage.descendants(body).size(), below.size()) << "listed twice";
    ASSERT_EQ(as_set(lineage.joints(body)), joints_below(edges, body)) << "body " << body;
    ASSERT_EQ(lineage.joints(body).size(), joints_below(edges, body).size()) << "listed twice";
    std::set<std::uint32_t> above;
    for (std::uint32_t other = 0; other < bodies; ++other)
      if (other != body && reachable(edges, other).count(body) != 0) above.insert(other);
    ASSERT_EQ(as_set(lineage.ancestors(body)), above) << "body " << body;
  }
}

// `forward` edges only go from lower to higher numbers: no directed cycles, but undirected loops.
std::vector<Edge> random_edges(std::mt19937& random, std::uint32_t bodies, bool forward) {
  std::uniform_int_distribution<std::uint32_t> any(0, bodies - 1);
  std::uniform_int_distribution<std::uint32_t> count(2, 2 * bodies);
  std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (std::uint32_t i = count(random); i > 0; --i) {
    const std::uint32_t a = any(random), b = any(random);
    if (a != b) pairs.insert(forward ? std::minmax({a, b}) : std::pair{a, b});
  }
  std::vector<Edge> edges;
  for (const auto& [parent, child] : pairs)
    edges.push_back({100 + static_cast<std::uint32_t>(edges.size()), parent, child});
  std::shuffle(edges.begin(), edges.end(), random);
  return edges;
}

TEST(Lineage, EqualsTheTransitiveClosureOfRandomGraphs) {
  std::mt19937 random(3);
  std::uniform_int_distribution<std::uint32_t> size(3, 8);
  for (const bool forward : {true, false})
    for (int i = 0; i < 2000; ++i) {
      const std::uint32_t bodies = size(random);
      const std::vector<Edge> edges = random_edges(random, bodies, forward);
      expect_closure(lineage_of(edges), edges, bodies);
      if (HasFatalFailure()) FAIL() << "graph " << i << (forward ? ", acyclic" : ", with directed cycles");
    }
}

TEST(Lineage, DoesNotDependOnTheOrderOfLoadingExceptInOrder) {
  std::mt19937 random(5);
  for (const bool forward : {true, false})
    for (int i = 0; i < 20; ++i) {
      std::vector<Edge> edges = random_edges(random, 4, forward);
      edges.resize(std::min<std::size_t>(edges.size(), 6));
      const auto by_joint = [](const Edge& a, const Edge& b) { return a.joint < b.joint; };
      std::sort(edges.begin(), edges.end(), by_joint);
      do {
        expect_closure(lineage_of(edges), edges, 4);
        ASSERT_FALSE(HasFatalFailure());
      } while (std::next_permutation(edges.begin(), edges.end(), by_joint));
    }
}

TEST(Lineage, RemovingWhatWasAddedRestoresIt) {
  std::mt19937 random(7);
  for (int i = 0; i < 300; ++i) {
    std::vector<Edge> edges = random_edges(random, 6, i % 2 == 0);
    if (edges.empty()) continue;
    Lineage lineage = lineage_of(edges);
    const std::uint32_t last = edges.back().joint;
    edges.pop_back();
    lineage.remove({last}, {});
    const Lineage before = lineage_of(edges);
    for (std::uint32_t body = 0; body < 6; ++body) {
      EXPECT_EQ(lineage.descendants(body), before.descendants(body));  // order too
      EXPECT_EQ(lineage.joints(body), before.joints(body));
      EXPECT_EQ(lineage.ancestors(body), before.ancestors(body));
    }
  }
}

// Alg. 1 as it is written, with tables of everything: the order that the lists must have.
struct Tables {
  struct Node {
    Numbers descendants, found_by, closing;
    std::set<std::uint32_t> above;
  };
  std::map<std::uint32_t, Node> nodes;

  explicit Tables(const std::vector<Edge>& edges) {
    for (const Edge& edge : edges) {
      const Node child = nodes[edge.child];
      std::set<std::uint32_t> above = nodes[edge.parent].above;
      above.insert(edge.parent);
      for (const std::uint32_t body : above) {
        for (std::size_t i = 0; i < child.descendants.size(); ++i) list(body, child.descendants[i], child.found_by[i]);
        list(body, edge.child, edge.joint);
        for (const std::uint32_t joint : child.closing)
          if (!knows(nodes[body], joint)) nodes[body].closing.push_back(joint);
      }
      Numbers below = child.descendants;
      below.push_back(edge.child);
      for (const std::uint32_t body : below) nodes[body].above.insert(above.begin(), above.end());
    }
  }
  static bool has(const Numbers& list, std::uint32_t value) {
    return std::find(list.begin(), list.end(), value) != list.end();
  }
  static bool knows(const Node& node, std::uint32_t joint) {
    return has(node.found_by, joint) || has(node.closing, joint);
  }
  void list(std::uint32_t above, std::uint32_t body, std::uint32_t joint) {
    Node& node = nodes[above];
    if (knows(node, joint)) return;
    if (body != above && !has(node.descendants, body)) {
      node.descendants.push_back(body);
      node.found_by.push_back(joint);
    } else {
      node.closing.push_back(joint);
    }
  }
  Numbers joints(std::uint32_t body) {
    Numbers all = nodes[body].found_by;
    all.insert(all.end(), nodes[body].closing.begin(), nodes[body].closing.end());
    return all;
  }
};

TEST(Lineage, HasTheOrderOfTheAlgorithmInEveryGraph) {
  std::mt19937 random(11);
  for (int i = 0; i < 3000; ++i) {
    const std::uint32_t bodies = 3 + static_cast<std::uint32_t>(random() % 8);
    std::vector<Edge> edges;
    if (i % 3 == 0) {  // a tree, its joints in any order
      for (std::uint32_t body = 1; body < bodies; ++body)
        edges.push_back({100 + body, static_cast<std::uint32_t>(random() % body), body});
      std::shuffle(edges.begin(), edges.end(), random);
    } else {
      edges = random_edges(random, bodies, i % 3 == 1);
    }
    Tables tables(edges);
    const Lineage lineage = lineage_of(edges);
    for (std::uint32_t body = 0; body < bodies; ++body) {
      ASSERT_EQ(lineage.descendants(body), tables.nodes[body].descendants) << "graph " << i << ", body " << body;
      ASSERT_EQ(lineage.joints(body), tables.joints(body)) << "graph " << i << ", body " << body;
    }
  }
}

TEST(Lineage, EveryBodyComesAfterAParent) {
  std::mt19937 random(13);
  for (int i = 0; i < 200; ++i) {
    const std::vector<Edge> edges = random_edges(random, 8, i % 2 == 0);
    const Lineage lineage = lineage_of(edges);
    std::set<std::uint32_t> placed, all;
    for (const Edge& edge : edges) all.insert({edge.parent, edge.child});
    for (const Descent::Placed& each : Descent(lineage).from_the_roots()) {
      if (each.parent != each.body) {
        EXPECT_TRUE(placed.count(each.parent) != 0);
      } else if (i % 2 == 0) {
        EXPECT_TRUE(lineage.ancestors(each.body).empty());
      }
      EXPECT_TRUE(placed.insert(each.body).second);
    }
    EXPECT_EQ(placed, all);
  }
}

TEST(Lineage, ChainLoadedFromTheRootListsTheNearestFirst) {
  // A -> B -> C loaded in that order: the printed Alg. 1 leaves C without its parent A.
  const Lineage lineage = lineage_of({{10, 0, 1}, {11, 1, 2}});
  EXPECT_EQ(lineage.descendants(0), (Numbers{1, 2}));
  EXPECT_EQ(lineage.joints(0), (Numbers{10, 11}));
  EXPECT_EQ(lineage.ancestors(2), (Numbers{1, 0}));
}

TEST(Lineage, ChainLoadedFromTheTipListsTheChildsDescendantsFirst) {
  const Lineage lineage = lineage_of({{11, 1, 2}, {10, 0, 1}});
  EXPECT_EQ(lineage.descendants(0), (Numbers{2, 1}));
  EXPECT_EQ(lineage.joints(0), (Numbers{11, 10}));
}

TEST(Lineage, JointThatClosesALoopIsListedAfterAllOthers) {
  // A four-bar: 0 -> 1 -> 2 and 0 -> 3 -> 2 (joint 22 closes the loop), then a link 2 -> 4 joined later.
  const Lineage lineage = lineage_of({{20, 0, 1}, {21, 1, 2}, {23, 0, 3}, {22, 3, 2}, {24, 2, 4}});
  EXPECT_EQ(lineage.descendants(0), (Numbers{1, 2, 3, 4}));
  EXPECT_EQ(lineage.joints(0), (Numbers{20, 21, 23, 24, 22}));
  EXPECT_EQ(lineage.joints(3), (Numbers{22, 24}));  // seen from 3 it closes nothing
}

// Fig. 4.2: a densely connected piece in which A reaches B, and F reaches E, by several routes; beside it a chain and a
// body alone. The figure's table lists for each body its parents, children and joints, each once.
TEST(Lineage, DenselyConnectedBodiesListEachRelativeOnce) {
  enum : std::uint32_t { A, B, C, D, E, F, G, H, I, alone };
  const std::vector<Edge> edges{{1, A, B}, {2, A, C}, {3, C, B}, {4, B, D}, {5, F, G},
                                {6, G, E}, {7, F, E}, {8, D, F}, {9, H, I}};
  const Lineage lineage = lineage_of(edges);
  expect_closure(lineage, edges, 10);
  EXPECT_EQ(as_set(lineage.descendants(A)), (std::set<std::uint32_t>{B, C, D, E, F, G}));
  EXPECT_EQ(as_set(lineage.joints(A)), (std::set<std::uint32_t>{1, 2, 3, 4, 5, 6, 7, 8}));
  EXPECT_EQ(as_set(lineage.ancestors(E)), (std::set<std::uint32_t>{A, B, C, D, F, G}));
  EXPECT_EQ(as_set(lineage.joints(F)), (std::set<std::uint32_t>{5, 6, 7}));
  EXPECT_EQ(lineage.ancestors(I), (Numbers{H}));
  EXPECT_TRUE(lineage.descendants(I).empty());
  EXPECT_TRUE(lineage.descendants(alone).empty());
  EXPECT_TRUE(lineage.joints(alone).empty());
  EXPECT_TRUE(lineage.ancestors(alone).empty());
}

// Fig. 4.12: taking a link out of a closed mechanism leaves each piece with its own lineage.
TEST(Lineage, RemovingALinkSplitsTheMechanism) {
  Lineage lineage = lineage_of({{20, 0, 1}, {21, 1, 2}, {22, 2, 3}, {23, 3, 4}});
  lineage.remove({}, {2});
  EXPECT_EQ(lineage.descendants(0), (Numbers{1}));
  EXPECT_EQ(lineage.joints(0), (Numbers{20}));
  EXPECT_EQ(lineage.joints(3), (Numbers{23}));
  EXPECT_EQ(lineage.ancestors(4), (Numbers{3}));
  EXPECT_TRUE(lineage.joints(2).empty());
}

}  // namespace
}  // namespace ambf::model
