// The numeric half of the joint factorisation: A = L L^T for a symmetric positive (semi)definite A with the block
// pattern of a BlockStructure. Storage is laid out once for a set of row counts and only ever grows, so that a steady
// simulation does not allocate. Rows may be pinned: their row and column of A then count as those of the identity,
// and a solve leaves 0 there. It never chooses an order or a row to pin. Physics thread (or any one thread at a
// time).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "physics/joints/detail/block_structure.h"

namespace ambf::physics {

class BlockCholesky {
 public:
  // wide: with Quad, which the processor must have; the same bits.
  explicit BlockCholesky(bool wide) : wide_(wide) {}

  // Prepares for `structure` (which must outlive this) with rows[p] rows at position p. All blocks of A become 0.
  void lay_out(const BlockStructure& structure, const std::vector<int>& rows);

  int rows(int position) const { return rows_[position]; }
  int leading_dimension(int position) const { return leading_[position]; }
  // Vectors over all rows have the padded rows of position p at row_begin(p); the padding entry is 0.
  int row_begin(int position) const { return row_begin_[position]; }
  int vector_size() const { return row_begin_.empty() ? 0 : row_begin_.back(); }

  // Block `id` of A, column-major. The leading dimension is that of the block's row position. Only the lower triangle
  // of A is read (diagonal blocks: of the block).
  double* a(int id) { return a_.data() + offset_[id]; }
  const double* a(int id) const { return a_.data() + offset_[id]; }

  // Says that values of A or pins in the rows of this position changed since the last factor().
  void mark_changed(int position);
  void mark_all_changed(const BlockStructure::Component& component);

  // Factors what the marked rows of a component touch. pinned and threshold are vectors over all rows; a pivot not
  // above its threshold makes its unknown 0 (redundant beyond the regularisation, or not a number). Returns how many
  // such rows it met.
  int factor(const BlockStructure::Component& component, const std::uint8_t* pinned, const double* threshold);

  // x := A^-1 x over the rows of a factored component. Entries of pinned rows must be 0 and stay 0.
  void solve(const BlockStructure::Component& component, double* x) const;

 private:
  void load_column(int position, const std::uint8_t* pinned);
  template <bool kWide>
  int factor_by(const BlockStructure::Component& component, const std::uint8_t* pinned, const double* threshold);
  int factor_wide(const BlockStructure::Component& component, const std::uint8_t* pinned, const double* threshold);
  template <bool kWide>
  void solve_by(const BlockStructure::Component& component, double* x) const;
  void solve_wide(const BlockStructure::Component& component, double* x) const;

  bool wide_;
  const BlockStructure* structure_ = nullptr;
  std::vector<int> rows_, leading_, row_begin_;
  std::vector<std::size_t> offset_;  // by block id, into a_ and l_
  std::vector<double> a_, l_;
  std::vector<double> inverse_pivots_;
  std::vector<std::uint8_t> stale_;       // by position: its column must be factored again
  std::vector<std::uint8_t> has_pinned_;  // by position, in factor()
};

}  // namespace ambf::physics
