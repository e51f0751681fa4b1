#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <utility>
#include <vector>

namespace presa::ode {

/// Sparse Cholesky factorisation of a symmetric positive definite matrix of 6 x 6 blocks, one row of blocks per body. A
/// chain of bodies costs as much per body as a single one; a heap fills in, see work(). Allocates only where a pattern
/// is larger than every one before and than what was reserved.
class BlockCholesky {
 public:
  using Block = Eigen::Matrix<double, 6, 6>;
  using Vector = std::vector<Eigen::Matrix<double, 6, 1>>;  ///< by body
  using Pair = std::pair<std::int32_t, std::int32_t>;

  static constexpr std::size_t kMaxCount = 512;  ///< of block rows: tables are square

  /// Reserves memory for `count` block rows, at most kMaxCount, of up to kUsualDegree neighbours each.
  explicit BlockCholesky(std::size_t count);
  /// Takes the pattern: `count` diagonal blocks, and the blocks of `pairs` (either order, repeats allowed). Orders the
  /// rows by minimum degree. False when `count` is too large or work() would exceed `max_work`.
  bool analyse(std::size_t count, const std::vector<Pair>& pairs, std::size_t max_work);
  /// Products of two blocks that factorise() takes.
  std::size_t work() const noexcept { return work_; }

  void setZero();
  /// Adds to the block in row i and column j, and its transpose to that in row j and column i.
  void add(std::int32_t i, std::int32_t j, const Block& block);
  /// False when the matrix is not positive definite.
  bool factorise();
  /// Solves in place.
  void solve(Vector& x);

 private:
  static constexpr std::size_t kUsualDegree = 64;
  struct Column {
    std::vector<std::int32_t> rows;  // below the diagonal, ascending in the order of elimination
    std::vector<std::size_t> blocks;
  };
  bool& joined(std::size_t i, std::size_t j) { return joined_[i * count_ + j].is; }
  std::int32_t& slot(std::size_t row, std::size_t column) { return slots_[row * count_ + column]; }
  void join(std::int32_t a, std::int32_t b);
  void eliminate(std::size_t k);
  void placeBlocks();

  struct Flag {
    bool is = false;
  };
  std::size_t count_ = 0, work_ = 0;
  std::vector<std::int32_t> order_, place_;  // order_[k]: body eliminated k-th; place_: its inverse, -1 before
  std::vector<std::vector<std::int32_t>> neighbours_;  // by body, of those not eliminated
  std::vector<Flag> joined_;                           // by two bodies
  std::vector<std::int32_t> slots_;  // by row and column in the order of elimination: index of the block
  std::vector<Column> columns_;
  std::vector<Block> blocks_;  // below the diagonal
  std::vector<Block> diagonal_;
  Vector sorted_;
};

}  // namespace presa::ode
