#include "physics/joints/detail/block_structure.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <set>
#include <utility>

namespace ambf::physics {
namespace {

// Joints that share a body, ascending and without repeats, for each joint.
std::vector<std::vector<int>> neighbours_of(const std::vector<JointEnds>& joints) {
  std::map<int, std::vector<int>> at_body;
  for (int j = 0; j < static_cast<int>(joints.size()); ++j) {
    for (const int body : joints[j].bodies()) {
      if (body >= 0) at_body[body].push_back(j);
    }
  }
  std::vector<std::vector<int>> result(joints.size());
  for (const auto& [body, meeting] : at_body) {
    for (const int i : meeting) {
      for (const int j : meeting) {
        if (i != j) result[i].push_back(j);
      }
    }
  }
  for (auto& list : result) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return result;
}

// How many members two ascending lists share.
int count_shared(const std::vector<int>& a, const std::vector<int>& b) {
  int shared = 0;
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    if (a[i] == b[j]) ++shared;
    const bool step_a = a[i] <= b[j];
    const bool step_b = b[j] <= a[i];
    i += step_a ? 1 : 0;
    j += step_b ? 1 : 0;
  }
  return shared;
}

// How many pairs of neighbours of a joint are not neighbours of each other: the fill that eliminating it would cause.
int fill_of(const std::vector<std::vector<int>>& graph, int joint) {
  const auto& list = graph[joint];
  const int degree = static_cast<int>(list.size());
  int present = 0;  // each edge among them twice
  for (const int neighbour : list) present += count_shared(graph[neighbour], list);
  return (degree * (degree - 1) - present) / 2;
}

// Greedy: eliminate the joint that causes the least fill, then the one with the fewest neighbours, then the first;
// make its neighbours a clique; repeat. On a tree of bodies there is always one without fill.
std::vector<int> minimum_fill(std::vector<std::vector<int>> graph) {
  using Rank = std::array<int, 3>;  // fill, degree, joint
  const int n = static_cast<int>(graph.size());
  std::vector<Rank> rank(graph.size());
  std::set<Rank> queue;
  const auto place = [&](int joint, int fill) {
    rank[joint] = {fill, static_cast<int>(graph[joint].size()), joint};
    queue.insert(rank[joint]);
  };
  for (int j = 0; j < n; ++j) place(j, fill_of(graph, j));
  std::vector<int> order;
  order.reserve(graph.size());
  std::vector<int> merged, affected;
  while (!queue.empty()) {
    const auto [fill, degree, least] = *queue.begin();
    const int joint = least;  // clang 14 captures no structured bindings
    queue.erase(queue.begin());
    order.push_back(joint);
    const std::vector<int> clique = std::move(graph[joint]);
    if (fill == 0) {
      // No edge is new. A neighbour loses the pairs of this joint with its other neighbours, of which none was an edge.
      for (const int neighbour : clique) {
        auto& list = graph[neighbour];
        queue.erase(rank[neighbour]);
        const int others = static_cast<int>(list.size()) - degree;
        list.erase(std::lower_bound(list.begin(), list.end(), joint));
        place(neighbour, rank[neighbour][0] - others);
      }
      continue;
    }
    affected = clique;
    for (const int neighbour : clique) {
      auto& list = graph[neighbour];
      merged.clear();
      std::set_union(list.begin(), list.end(), clique.begin(), clique.end(), std::back_inserter(merged));
      std::erase_if(merged, [&](int k) { return k == joint || k == neighbour; });
      list = merged;
      affected.insert(affected.end(), list.begin(), list.end());  // a new edge may complete a clique further away
    }
    std::sort(affected.begin(), affected.end());
    affected.erase(std::unique(affected.begin(), affected.end()), affected.end());
    for (const int changed : affected) {
      queue.erase(rank[changed]);
      place(changed, fill_of(graph, changed));
    }
  }
  return order;
}

// Rows of each column of the factor below the diagonal, and the elimination tree, for a given order.
void symbolic_columns(const std::vector<std::vector<int>>& neighbours, const std::vector<int>& order,
                      std::vector<std::vector<int>>& rows, std::vector<int>& parent) {
  const int n = static_cast<int>(order.size());
  std::vector<int> position(order.size());
  for (int p = 0; p < n; ++p) position[order[p]] = p;
  rows.assign(order.size(), {});
  parent.assign(order.size(), -1);
  std::vector<std::vector<int>> children(order.size());
  for (int p = 0; p < n; ++p) {
    auto& pattern = rows[p];
    for (const int neighbour : neighbours[order[p]]) {
      if (position[neighbour] > p) pattern.push_back(position[neighbour]);
    }
    for (const int child : children[p]) {
      for (const int row : rows[child]) {
        if (row > p) pattern.push_back(row);
      }
    }
    std::sort(pattern.begin(), pattern.end());
    pattern.erase(std::unique(pattern.begin(), pattern.end()), pattern.end());
    if (!rows[p].empty()) {
      parent[p] = rows[p].front();
      children[parent[p]].push_back(p);
    }
  }
}

// Depth-first order of the elimination tree: the same fill, but each mechanism and each subtree lies together in
// memory.
std::vector<int> postorder(const std::vector<int>& parent) {
  const int n = static_cast<int>(parent.size());
  std::vector<std::vector<int>> children(parent.size());
  std::vector<int> roots;
  for (int p = 0; p < n; ++p) (parent[p] < 0 ? roots : children[parent[p]]).push_back(p);
  std::vector<int> result;
  result.reserve(parent.size());
  std::vector<std::pair<int, std::size_t>> stack;  // node, next child
  for (const int root : roots) {
    stack.emplace_back(root, 0);
    while (!stack.empty()) {
      auto& [node, next] = stack.back();
      if (next < children[node].size()) {
        stack.emplace_back(children[node][next++], 0);
      } else {
        result.push_back(node);
        stack.pop_back();
      }
    }
  }
  return result;
}

}  // namespace

BlockStructure::BlockStructure(std::vector<JointEnds> joints) : joints_(std::move(joints)) {
  neighbours_ = neighbours_of(joints_);
  choose_order();
  find_pattern();
  find_loops();
  list_couplings();
  list_updates();
  neighbours_.clear();
  neighbours_.shrink_to_fit();
}

void BlockStructure::choose_order() {
  order_ = minimum_fill(neighbours_);
  std::vector<std::vector<int>> rows;
  symbolic_columns(neighbours_, order_, rows, parent_);
  const std::vector<int> visit = postorder(parent_);
  std::vector<int> reordered(order_.size());
  for (std::size_t p = 0; p < visit.size(); ++p) reordered[p] = order_[visit[p]];
  order_ = std::move(reordered);
  position_.assign(order_.size(), 0);
  for (int p = 0; p < size(); ++p) position_[order_[p]] = p;
}

void BlockStructure::find_pattern() {
  std::vector<std::vector<int>> rows;
  symbolic_columns(neighbours_, order_, rows, parent_);
  for (int p = 0; p < size(); ++p) blocks_.push_back({p, p});
  for (int p = 0; p < size(); ++p) {
    column_begin_.push_back(block_count());
    for (const int row : rows[p]) blocks_.push_back({row, p});
  }
  column_begin_.push_back(block_count());

  component_of_.assign(order_.size(), 0);
  int first = 0;
  for (int p = 0; p < size(); ++p) {
    component_of_[p] = static_cast<int>(components_.size());
    if (parent_[p] < 0) {
      components_.push_back({first, p + 1});
      first = p + 1;
    }
  }
}

void BlockStructure::find_loops() {
  // A tree of n bodies has n - 1 joints; all that does not move is one body.
  for (Component& component : components_) {
    std::vector<int> bodies;
    int joints = 0;
    for (int p = component.first; p < component.last; ++p) {
      const JointEnds& ends = joints_[order_[p]];
      if (ends.ties_coordinates) continue;
      bodies.push_back(ends.body_a);
      bodies.push_back(ends.body_b);
      ++joints;
    }
    std::sort(bodies.begin(), bodies.end());
    const auto distinct = std::unique(bodies.begin(), bodies.end()) - bodies.begin();
    component.closes_loops = joints > static_cast<int>(distinct) - 1;
  }
}

int BlockStructure::find_block(int row, int column) const {
  if (row == column) return row;
  const auto begin = blocks_.begin() + column_begin_[column];
  const auto end = blocks_.begin() + column_begin_[column + 1];
  const auto found = std::lower_bound(begin, end, row, [](const Block& b, int r) { return b.row < r; });
  return static_cast<int>(found - blocks_.begin());
}

void BlockStructure::list_couplings() {
  for (int column = 0; column < size(); ++column) {
    couplings_begin_.push_back(static_cast<int>(couplings_.size()));
    const auto couple = [&](int row) {
      const std::array<int, 4> of_row = joints_[order_[row]].bodies(), of_column = joints_[order_[column]].bodies();
      bool first = true;
      for (int side_row = 0; side_row < 4; ++side_row) {
        for (int side_column = 0; side_column < 4; ++side_column) {
          if (of_row[side_row] < 0 || of_row[side_row] != of_column[side_column]) continue;
          couplings_.push_back({find_block(row, column), row, column, side_row, side_column, first});
          first = false;
        }
      }
    };
    couple(column);
    for (int id = column_begin_[column]; id < column_begin_[column + 1]; ++id) couple(blocks_[id].row);
  }
  couplings_begin_.push_back(static_cast<int>(couplings_.size()));
}

void BlockStructure::list_updates() {
  std::vector<std::vector<Update>> due(order_.size());
  for (int column = 0; column < size(); ++column) {
    for (int right = column_begin_[column]; right < column_begin_[column + 1]; ++right) {
      const int into = blocks_[right].row;
      for (int left = right; left < column_begin_[column + 1]; ++left) {
        due[into].push_back({find_block(blocks_[left].row, into), left, right});
      }
    }
  }
  for (const auto& list : due) {
    updates_begin_.push_back(static_cast<int>(updates_.size()));
    updates_.insert(updates_.end(), list.begin(), list.end());
  }
  updates_begin_.push_back(static_cast<int>(updates_.size()));
}

}  // namespace ambf::physics
