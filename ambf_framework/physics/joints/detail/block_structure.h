// The symbolic half of the joint factorisation: which joints couple, in which order to eliminate them, which blocks
// of the factor are nonzero and which products feed which block. Made once for a structure (who is joined to whom)
// and kept; the numeric half (block_cholesky.h) runs through these lists without a decision. It never looks at a
// value and knows no Bullet. Building allocates; everything after is read-only. Any thread.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace ambf::physics {

// One joint as the structure sees it: the two bodies it couples; or a row that ties the coordinates of two joints: it
// couples up to four bodies, none twice, and closes no loop. Bodies are named by any non-negative number; kNoBody
// stands for a body that does not move under impulses (static, kinematic), which couples nothing.
struct JointEnds {
  static constexpr int kNoBody = -1;
  int body_a = kNoBody;
  int body_b = kNoBody;
  bool ties_coordinates = false;
  int body_c = kNoBody, body_d = kNoBody;
  std::array<int, 4> bodies() const { return {body_a, body_b, body_c, body_d}; }
  friend bool operator==(const JointEnds&, const JointEnds&) = default;
};

// "Position" is a joint's place in the elimination order, "joint" its place in the caller's list. Blocks of the
// factor are numbered: block p < size() is the diagonal block of position p, the others follow column by column.
class BlockStructure {
 public:
  explicit BlockStructure(std::vector<JointEnds> joints);

  // A run of positions that no nonzero block connects with the others: one mechanism.
  struct Component {
    int first = 0;
    int last = 0;  // one past the end
    bool closes_loops =
        false;  // more joints than a tree of its bodies has (all fixed ones count as one): rows may be redundant
  };
  // A nonzero block of the lower triangle; row >= column.
  struct Block {
    int row = 0;
    int column = 0;
  };
  // A[row, column] += J(row, side_row) M^-1 J(column, side_column)^T: the two joints meet in one body there.
  struct Coupling {
    int block = 0;
    int row = 0;
    int column = 0;
    int side_row = 0;  // place in JointEnds::bodies()
    int side_column = 0;
    bool first = true;  // of its block
  };
  // block[target] -= block[left] block[right]^T, due before column `row of right` is factored.
  struct Update {
    int target = 0;
    int left = 0;
    int right = 0;
  };

  int size() const { return static_cast<int>(order_.size()); }
  const std::vector<JointEnds>& joints() const { return joints_; }
  int joint_at(int position) const { return order_[position]; }
  int position_of(int joint) const { return position_[joint]; }
  const std::vector<Component>& components() const { return components_; }
  int component_of(int position) const { return component_of_[position]; }
  int parent(int position) const { return parent_[position]; }  // elimination tree; -1 at a root

  int block_count() const { return static_cast<int>(blocks_.size()); }
  const Block& block(int id) const { return blocks_[id]; }
  // Off-diagonal blocks of column p: ids column_begin(p) .. column_begin(p + 1), rows ascending.
  int column_begin(int position) const { return column_begin_[position]; }
  const std::vector<Coupling>& couplings() const { return couplings_; }
  int couplings_begin(int position) const { return couplings_begin_[position]; }  // those of column p
  const std::vector<Update>& updates() const { return updates_; }
  int updates_begin(int position) const { return updates_begin_[position]; }  // those due before column p

 private:
  void choose_order();
  void find_pattern();
  void find_loops();
  void list_couplings();
  void list_updates();
  int find_block(int row, int column) const;

  std::vector<JointEnds> joints_;
  std::vector<std::vector<int>> neighbours_;  // joints sharing a body, by joint; emptied after the analysis
  std::vector<int> order_, position_, parent_, component_of_;
  std::vector<Component> components_;
  std::vector<Block> blocks_;
  std::vector<int> column_begin_;
  std::vector<Coupling> couplings_;
  std::vector<int> couplings_begin_;
  std::vector<Update> updates_;
  std::vector<int> updates_begin_;
};

}  // namespace ambf::physics
