#include "physics/joints/detail/block_cholesky.h"

#include <algorithm>

#include "physics/joints/detail/dense_kernels.h"

namespace ambf::physics {

void BlockCholesky::lay_out(const BlockStructure& structure, const std::vector<int>& rows) {
  structure_ = &structure;
  const int positions = structure.size();
  rows_ = rows;
  leading_.resize(positions);
  row_begin_.resize(positions + 1);
  row_begin_[0] = 0;
  for (int p = 0; p < positions; ++p) {
    leading_[p] = dense::padded(rows_[p]);
    row_begin_[p + 1] = row_begin_[p] + leading_[p];
  }
  offset_.resize(structure.block_count());
  std::size_t total = 0;
  for (int id = 0; id < structure.block_count(); ++id) {
    const auto& block = structure.block(id);
    offset_[id] = total;
    total += static_cast<std::size_t>(leading_[block.row]) * static_cast<std::size_t>(rows_[block.column]);
  }
  a_.assign(total, 0.0);
  l_.resize(total);
  inverse_pivots_.assign(vector_size(), 0.0);
  stale_.assign(positions, 1);
  has_pinned_.assign(positions, 0);
}

void BlockCholesky::mark_changed(int position) {
  stale_[position] = 1;
  // The rows of this position also lie in the columns of its descendants.
  for (int k = structure_->updates_begin(position); k < structure_->updates_begin(position + 1); ++k) {
    const auto& update = structure_->updates()[k];
    if (update.target == position) stale_[structure_->block(update.right).column] = 1;
  }
}

void BlockCholesky::mark_all_changed(const BlockStructure::Component& component) {
  std::fill(stale_.begin() + component.first, stale_.begin() + component.last, std::uint8_t{1});
}

// Copies column p of A into L, with pinned rows and columns as those of the identity.
void BlockCholesky::load_column(int p, const std::uint8_t* pinned) {
  const int columns = rows_[p];
  const int first = structure_->column_begin(p), last = structure_->column_begin(p + 1);
  std::copy_n(a_.data() + offset_[p], leading_[p] * columns, l_.data() + offset_[p]);
  if (first < last) {  // they follow each other
    const auto end = offset_[last - 1] + static_cast<std::size_t>(leading_[structure_->block(last - 1).row] * columns);
    std::copy(a_.data() + offset_[first], a_.data() + end, l_.data() + offset_[first]);
  }
  const std::uint8_t* pinned_columns = pinned + row_begin_[p];
  const auto pin = [&](int id, int row) {
    const int ld = leading_[row];
    double* to = l_.data() + offset_[id];
    for (int c = 0; has_pinned_[p] && c < columns; ++c) {
      if (pinned_columns[c]) std::fill_n(to + c * ld, ld, 0.0);
    }
    const std::uint8_t* pinned_rows = pinned + row_begin_[row];
    for (int r = 0; has_pinned_[row] && r < rows_[row]; ++r) {
      if (!pinned_rows[r]) continue;
      for (int c = 0; c < columns; ++c) to[c * ld + r] = 0.0;
    }
  };
  if (has_pinned_[p]) {
    pin(p, p);
    for (int c = 0; c < columns; ++c)
      if (pinned_columns[c]) l_[offset_[p] + static_cast<std::size_t>(c * leading_[p] + c)] = 1.0;
  }
  for (int id = first; id < last; ++id) {
    const int row = structure_->block(id).row;
    if (has_pinned_[p] || has_pinned_[row]) pin(id, row);
  }
}

template <bool kWide>
AMBF_INLINED int BlockCholesky::factor_by(const BlockStructure::Component& component, const std::uint8_t* pinned,
                                          const double* threshold) {
  for (int p = component.first; p < component.last; ++p) {
    const std::uint8_t *const begin = pinned + row_begin_[p], *const end = begin + rows_[p];
    has_pinned_[p] = std::find(begin, end, 1) != end;
  }
  int dead = 0;
  for (int p = component.first; p < component.last; ++p) {
    if (!stale_[p]) continue;
    stale_[p] = 0;
    if (structure_->parent(p) >= 0) stale_[structure_->parent(p)] = 1;
    const int columns = rows_[p];
    if (columns == 0) continue;
    load_column(p, pinned);
    for (int k = structure_->updates_begin(p); k < structure_->updates_begin(p + 1); ++k) {
      const auto& update = structure_->updates()[k];
      const auto& left = structure_->block(update.left);
      const int ld = leading_[left.row];
      const int depth = rows_[left.column];
      if (ld == 0 || depth == 0) continue;
      double* const to = l_.data() + offset_[update.target];
      const double* const of_left = l_.data() + offset_[update.left];
      const double* const of_right = l_.data() + offset_[update.right];
      dense::with_fixed_ld(ld, [&]<int kLd>() AMBF_INLINED_LAMBDA {
        if (update.target == p) {
          dense::multiply_transposed<kWide, kLd, -1, true>(to, of_left, of_right, ld, columns, depth, leading_[p]);
        } else {
          dense::multiply_transposed<kWide, kLd, -1, false>(to, of_left, of_right, ld, columns, depth, leading_[p]);
        }
      });
    }
    double* diagonal = l_.data() + offset_[p];
    double* inverse_pivots = inverse_pivots_.data() + row_begin_[p];
    dense::with_fixed_ld(leading_[p], [&]<int kLd>() AMBF_INLINED_LAMBDA {
      dead +=
          dense::factor_diagonal<kWide, kLd>(diagonal, inverse_pivots, threshold + row_begin_[p], columns, leading_[p]);
    });
    for (int id = structure_->column_begin(p); id < structure_->column_begin(p + 1); ++id) {
      const int ld = leading_[structure_->block(id).row];
      if (ld == 0) continue;
      dense::with_fixed_ld(ld, [&]<int kLd>() AMBF_INLINED_LAMBDA {
        dense::solve_right<kWide, kLd>(l_.data() + offset_[id], diagonal, inverse_pivots, ld, columns, leading_[p]);
      });
    }
  }
  return dead;
}

AMBF_WIDE int BlockCholesky::factor_wide(const BlockStructure::Component& component, const std::uint8_t* pinned,
                                         const double* threshold) {
  return factor_by<true>(component, pinned, threshold);
}

int BlockCholesky::factor(const BlockStructure::Component& component, const std::uint8_t* pinned,
                          const double* threshold) {
  return wide_ ? factor_wide(component, pinned, threshold) : factor_by<false>(component, pinned, threshold);
}

template <bool kWide>
AMBF_INLINED void BlockCholesky::solve_by(const BlockStructure::Component& component, double* x) const {
  for (int p = component.first; p < component.last; ++p) {
    const int columns = rows_[p];
    double* own = x + row_begin_[p];
    dense::solve_lower(own, l_.data() + offset_[p], inverse_pivots_.data() + row_begin_[p], columns, leading_[p]);
    for (int id = structure_->column_begin(p); id < structure_->column_begin(p + 1); ++id) {
      const int row = structure_->block(id).row;
      const int ld = leading_[row];
      dense::with_fixed_ld(ld, [&]<int kLd>() AMBF_INLINED_LAMBDA {
        dense::add_products_from<kWide, kLd, -1>(0, x + row_begin_[row], l_.data() + offset_[id], own, ld, columns, 1);
      });
    }
  }
  for (int p = component.last - 1; p >= component.first; --p) {
    const int columns = rows_[p];
    double* own = x + row_begin_[p];
    for (int id = structure_->column_begin(p); id < structure_->column_begin(p + 1); ++id) {
      const int row = structure_->block(id).row;
      const int ld = leading_[row];
      dense::with_fixed_ld(ld, [&]<int kLd>() AMBF_INLINED_LAMBDA {
        dense::subtract_dots<kLd>(own, l_.data() + offset_[id], x + row_begin_[row], ld, columns);
      });
    }
    dense::solve_upper(own, l_.data() + offset_[p], inverse_pivots_.data() + row_begin_[p], columns, leading_[p]);
  }
}

AMBF_WIDE void BlockCholesky::solve_wide(const BlockStructure::Component& component, double* x) const {
  solve_by<true>(component, x);
}

void BlockCholesky::solve(const BlockStructure::Component& component, double* x) const {
  return wide_ ? solve_wide(component, x) : solve_by<false>(component, x);
}

}  // namespace ambf::physics
