#pragma once
#include <map>
#include <set>
#include <string>
#include <vector>

#include "apps/experiment/analysis/analyse.h"

namespace presa::experiment {

/// One number of an analysis over all studies.
struct Spread {
  std::string table, row, column;
  std::size_t studies = 0;                     ///< number of studies that have it
  double mean = 0, sd = 0, low = 0, high = 0;  ///< low, high: 2.5 % and 97.5 % quantiles over the studies
  double power = -1;                           ///< for a p value: share of the studies with p < 0.05; otherwise -1

  bool isSame(const Spread& other) const { return table == other.table && row == other.row && column == other.column; }
};

/// The numbers of all studies, grouped by their name, in the order of first appearance.
class StudyNumbers {
 public:
  void add(int study, const analysis::Result& result);
  std::vector<Spread> spreads() const;
  std::string csv() const;

 private:
  struct Key {
    std::string table, row, column;
    auto operator<=>(const Key&) const = default;
  };
  using Values = std::vector<std::pair<int, double>>;  // study, value

  void addRow(int study, const analysis::Table& table, const std::vector<analysis::Cell>& row,
              const std::set<std::string>& subjects);
  Spread spreadOf(const Key& key, const Values& values) const;

  std::map<Key, Values> numbers_;
  std::set<Key> probabilities_;
  std::vector<Key> order_;
};

}  // namespace presa::experiment
