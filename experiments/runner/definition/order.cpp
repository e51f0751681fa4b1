#include "experiments/runner/definition/order.h"

#include <algorithm>
#include <numeric>

#include "framework/core/math/random.h"

namespace presa::experiment {
namespace {

using Square = std::vector<std::vector<std::size_t>>;

std::uint64_t itemOf(int subject_number, int session) {
  return (static_cast<std::uint64_t>(subject_number) << 32) + static_cast<std::uint64_t>(session);
}

/// Row of a Latin square. Subjects of one cell take successive rows, and each advances by one row per session, so that
/// neither group nor session is confounded with a row.
std::size_t rowOf(const Experiment& experiment, int subject_number, int session) {
  return static_cast<std::size_t>(subject_number - 1) / cellsOf(experiment) + static_cast<std::size_t>(session - 1);
}

/// Removes immediate repeats in [from, to) by swapping a repeated trial with another one of that range, so that other
/// blocks and repeats keep their contents. False: no single swap helps.
bool partNeighbours(std::vector<Condition>& all, std::size_t from, std::size_t to) {
  const auto repeats = [&](std::size_t i) { return i > 0 && i < all.size() && all[i] == all[i - 1]; };
  const auto bad = [&](std::size_t i) { return repeats(i) || repeats(i + 1); };
  for (std::size_t i = std::max<std::size_t>(from, 1); i < to; ++i) {
    if (!repeats(i)) continue;
    bool parted = false;
    for (std::size_t j = from; j < to && !parted; ++j) {
      if (j == i || j + 1 == i) continue;
      std::swap(all[i], all[j]);
      parted = !bad(i) && !bad(j);
      if (!parted) std::swap(all[i], all[j]);
    }
    if (!parted) return false;
  }
  return true;
}

/// Indices into the conditions of one block, in the order of the design.
class Orderer {
 public:
  Orderer(const Design& design, std::size_t row, RandomStream& random) : design_(design), row_(row), random_(random) {}

  std::vector<std::size_t> once(std::size_t n) {
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    switch (design_.order) {
      case Design::Order::kListed:
        return order;
      case Design::Order::kLatinSquare:
        return fromRow(latinSquare(n));
      case Design::Order::kBalancedSquare:
        return fromRow(balancedSquare(n));
      default:
        random_.shuffle(std::span<std::size_t>(order));
        return order;
    }
  }

  std::vector<std::size_t> repeated(std::size_t n, int repeats) {
    std::vector<std::size_t> order;
    for (int r = 0; r < repeats; ++r) {
      const std::vector<std::size_t> again = once(n);
      order.insert(order.end(), again.begin(), again.end());
    }
    if (design_.order == Design::Order::kRandom) random_.shuffle(std::span<std::size_t>(order));
    return order;
  }

  /// Orders `from` … `to` so that no condition follows itself, the one before `from` included.
  void part(std::vector<Condition>& all, std::size_t from, std::size_t to) {
    for (int tries = 0; tries < kMaxTries && !partNeighbours(all, from, to); ++tries)
      random_.shuffle(std::span<Condition>(all).subspan(from, to - from));
  }

 private:
  static constexpr int kMaxTries = 1000;  // with three conditions one shuffle is not always enough

  std::vector<std::size_t> fromRow(const Square& square) const { return square[row_ % square.size()]; }

  const Design& design_;
  std::size_t row_;
  RandomStream& random_;
};

std::size_t indexOf(const Experiment& experiment, const std::string& factor) {
  for (std::size_t f = 0; f < experiment.factors.size(); ++f) {
    if (experiment.factors[f].name == factor) return f;
  }
  return experiment.factors.size();
}

/// The conditions of each block, in block order.
std::vector<std::vector<Condition>> blocksOf(const Experiment& experiment, const std::vector<Condition>& conditions,
                                             Orderer& orderer) {
  if (experiment.design.block_by.empty()) return {conditions};
  const std::size_t f = indexOf(experiment, experiment.design.block_by);
  std::vector<std::vector<Condition>> blocks;
  for (const std::size_t level : orderer.once(experiment.factors[f].levels.size())) {
    std::vector<Condition> block;
    for (const Condition& condition : conditions) {
      if (condition[f] == level) block.push_back(condition);
    }
    if (!block.empty()) blocks.push_back(std::move(block));
  }
  return blocks;
}

struct Placed {
  Condition condition;
  int block = 1;
};

std::vector<Placed> placeAll(const Experiment& experiment, const std::vector<Condition>& conditions, Orderer& orderer) {
  const Design& design = experiment.design;
  std::vector<Condition> order;
  std::vector<Placed> placed;
  int number = 0;
  for (const std::vector<Condition>& block : blocksOf(experiment, conditions, orderer)) {
    // each repeat is a piece of its own when the order keeps repeats apart and there are no blocks
    const bool by_repeat = design.block_by.empty() && design.order != Design::Order::kRandom;
    const std::size_t piece =
        design.order == Design::Order::kRandom ? block.size() * std::size_t(design.repeats) : block.size();
    const std::size_t begin = order.size();
    for (const std::size_t i : orderer.repeated(block.size(), design.repeats)) order.push_back(block[i]);
    if (design.no_immediate_repeat) {
      for (std::size_t from = begin; from < order.size(); from += piece) orderer.part(order, from, from + piece);
    }
    for (std::size_t i = begin; i < order.size(); ++i) {
      if (i == begin || (by_repeat && (i - begin) % piece == 0)) ++number;
      placed.push_back({{}, number});
    }
  }
  for (std::size_t i = 0; i < placed.size(); ++i) placed[i].condition = order[i];
  return placed;
}

}  // namespace

std::size_t cellsOf(const Experiment& experiment) {
  std::size_t cells = 1;
  for (const Factor& factor : experiment.factors) cells *= factor.between ? factor.levels.size() : 1;
  return cells;
}

Square latinSquare(std::size_t n) {
  Square square(n, std::vector<std::size_t>(n));
  for (std::size_t row = 0; row < n; ++row) {
    for (std::size_t i = 0; i < n; ++i) square[row][i] = (row + i) % n;
  }
  return square;
}

Square balancedSquare(std::size_t n) {
  Square square;
  for (std::size_t row = 0; row < n; ++row) {
    std::vector<std::size_t> items(n);
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t zigzag = i % 2 == 1 ? (i + 1) / 2 : (n - i / 2) % n;  // 0 1 n-1 2 n-2 …
      items[i] = (row + zigzag) % n;
    }
    square.push_back(items);
    if (n % 2 == 1) square.emplace_back(items.rbegin(), items.rend());
  }
  return square;
}

std::vector<Condition> conditionsOf(const Experiment& experiment, int subject_number) {
  std::vector<Condition> all{{}};
  std::size_t cells = 1;  // combinations of the between-subject factors so far
  for (const Factor& factor : experiment.factors) {
    std::vector<Condition> longer;
    for (const Condition& condition : all) {
      for (std::size_t level = 0; level < factor.levels.size(); ++level) {
        if (factor.between && level != (std::size_t(subject_number - 1) / cells) % factor.levels.size()) continue;
        longer.push_back(condition);
        longer.back().push_back(level);
      }
    }
    if (factor.between) cells *= factor.levels.size();
    all = std::move(longer);
  }
  return all;
}

std::vector<PlannedTrial> planTrials(const Experiment& experiment, int subject_number, int session) {
  const std::uint64_t item = itemOf(subject_number, session);
  const std::vector<Condition> conditions = conditionsOf(experiment, subject_number);
  RandomStream seeds(experiment.seed, "trial seeds", item), practice(experiment.seed, "practice", item);
  RandomStream practice_seeds(experiment.seed, "practice seeds", item);
  RandomStream random(experiment.seed, "order", item);
  std::vector<PlannedTrial> trials;
  for (int i = 1; i <= experiment.design.practice; ++i)
    trials.push_back({i, 0, true, 1, 1, conditions[practice.below(conditions.size())], practice_seeds.bits()});
  Orderer orderer(experiment.design, rowOf(experiment, subject_number, session), random);
  int number = 0;
  for (const Placed& placed : placeAll(experiment, conditions, orderer)) {
    const auto before = std::count_if(trials.begin(), trials.end(), [&](const PlannedTrial& trial) {
      return !trial.practice && trial.condition == placed.condition;
    });
    trials.push_back({++number, placed.block, false, static_cast<int>(before) + 1, 1, placed.condition, seeds.bits()});
  }
  return trials;
}

}  // namespace presa::experiment
