// A = L L^T by right-looking elimination of block columns. Order: greedy minimum degree, ties by index, so that equal
// patterns give equal bits.
#include "modules/dynamics_ode/contact_solver/block_cholesky.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "framework/geometry/index.h"

namespace presa::ode {
namespace {}  // namespace

BlockCholesky::BlockCholesky(std::size_t count) {
  count = std::min(count, kMaxCount);
  order_.reserve(count);
  place_.reserve(count);
  joined_.reserve(count * count);
  slots_.reserve(count * count);
  neighbours_.resize(count);
  columns_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    neighbours_[i].reserve(kUsualDegree);
    columns_[i].rows.reserve(kUsualDegree);
    columns_[i].blocks.reserve(kUsualDegree);
  }
  diagonal_.resize(count);
  blocks_.resize(kUsualDegree / 5 * count);
  sorted_.reserve(count);
}

bool BlockCholesky::analyse(std::size_t count, const std::vector<Pair>& pairs, std::size_t max_work) {
  if (count > kMaxCount) return false;
  count_ = count;
  work_ = 0;
  order_.resize(count);
  place_.assign(count, -1);
  joined_.assign(count * count, {});
  if (columns_.size() < count) columns_.resize(count);
  if (neighbours_.size() < count) neighbours_.resize(count);
  for (std::size_t i = 0; i < count; ++i) neighbours_[i].clear();
  for (const auto& [a, b] : pairs) join(a, b);
  for (std::size_t k = 0; k < count; ++k) {
    eliminate(k);
    if (work_ > max_work) return false;
  }
  placeBlocks();
  return true;
}

void BlockCholesky::join(std::int32_t a, std::int32_t b) {
  if (a == b || joined(index(a), index(b))) return;
  joined(index(a), index(b)) = joined(index(b), index(a)) = true;
  neighbours_[index(a)].push_back(b);
  neighbours_[index(b)].push_back(a);
}

// Removes the body with the fewest neighbours and joins these with each other.
void BlockCholesky::eliminate(std::size_t k) {
  std::size_t best = count_;
  for (std::size_t i = 0; i < count_; ++i) {
    if (place_[i] < 0 && (best == count_ || neighbours_[i].size() < neighbours_[best].size())) best = i;
  }
  order_[k] = static_cast<std::int32_t>(best);
  place_[best] = static_cast<std::int32_t>(k);
  std::vector<std::int32_t>& rows = columns_[k].rows;
  rows.assign(neighbours_[best].begin(), neighbours_[best].end());
  work_ += rows.size() * (rows.size() + 3) / 2 + 1;
  for (const std::int32_t a : rows) {
    std::erase(neighbours_[index(a)], order_[k]);
    for (const std::int32_t b : rows) join(a, b);
  }
}

void BlockCholesky::placeBlocks() {
  slots_.assign(count_ * count_, -1);
  std::int32_t next = 0;
  for (std::size_t k = 0; k < count_; ++k) {
    Column& column = columns_[k];
    for (std::int32_t& row : column.rows) row = place_[index(row)];
    std::sort(column.rows.begin(), column.rows.end());
    column.blocks.clear();
    for (const std::int32_t row : column.rows) {
      column.blocks.push_back(index(next));
      slot(index(row), k) = next++;
    }
  }
  if (blocks_.size() < index(next)) blocks_.resize(index(next));
  if (diagonal_.size() < count_) diagonal_.resize(count_);
}

void BlockCholesky::setZero() {
  for (std::size_t k = 0; k < count_; ++k) {
    diagonal_[k].setZero();
    for (const std::size_t block : columns_[k].blocks) blocks_[block].setZero();
  }
}

void BlockCholesky::add(std::int32_t i, std::int32_t j, const Block& block) {
  const std::size_t row = index(place_[index(i)]), column = index(place_[index(j)]);
  if (row == column) {
    diagonal_[row] += block;
  } else if (row > column) {
    blocks_[index(slot(row, column))] += block;
  } else {
    blocks_[index(slot(column, row))] += block.transpose();
  }
}

bool BlockCholesky::factorise() {
  for (std::size_t k = 0; k < count_; ++k) {
    const Eigen::LLT<Block> llt(diagonal_[k]);
    if (llt.info() != Eigen::Success) return false;
    diagonal_[k] = llt.matrixL();
    const Column& column = columns_[k];
    for (const std::size_t block : column.blocks) {
      diagonal_[k].triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(blocks_[block]);
    }
    for (std::size_t a = 0; a < column.rows.size(); ++a) {
      const Block& L_a = blocks_[column.blocks[a]];
      diagonal_[index(column.rows[a])].noalias() -= L_a * L_a.transpose();
      for (std::size_t b = 0; b < a; ++b) {
        blocks_[index(slot(index(column.rows[a]), index(column.rows[b])))].noalias() -=
            L_a * blocks_[column.blocks[b]].transpose();
      }
    }
  }
  return true;
}

void BlockCholesky::solve(Vector& x) {
  sorted_.resize(x.size());
  for (std::size_t k = 0; k < count_; ++k) sorted_[k] = x[index(order_[k])];
  for (std::size_t k = 0; k < count_; ++k) {
    Vector::value_type& own = sorted_[k];
    diagonal_[k].triangularView<Eigen::Lower>().solveInPlace(own);
    for (std::size_t a = 0; a < columns_[k].rows.size(); ++a) {
      sorted_[index(columns_[k].rows[a])].noalias() -= blocks_[columns_[k].blocks[a]] * own;
    }
  }
  for (std::size_t k = count_; k-- > 0;) {
    Vector::value_type& own = sorted_[k];
    for (std::size_t a = 0; a < columns_[k].rows.size(); ++a) {
      own.noalias() -= blocks_[columns_[k].blocks[a]].transpose() * sorted_[index(columns_[k].rows[a])];
    }
    diagonal_[k].triangularView<Eigen::Lower>().transpose().solveInPlace(own);
    x[index(order_[k])] = own;
  }
}

}  // namespace presa::ode
