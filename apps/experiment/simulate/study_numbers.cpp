#include "apps/experiment/simulate/study_numbers.h"

#include <algorithm>
#include <cmath>

#include "apps/common/terminal/text.h"

namespace presa::experiment {
namespace {

using analysis::Cell;
using analysis::Table;
using terminal::format;

constexpr double kSignificant = 0.05;

}  // namespace

void StudyNumbers::add(int study, const analysis::Result& result) {
  const std::set<std::string> subjects(result.trials.subjects.begin(), result.trials.subjects.end());
  for (const analysis::Section& section : result.sections) {
    for (const Table& table : section.tables) {
      for (const std::vector<Cell>& row : table.rows) addRow(study, table, row, subjects);
    }
  }
}

std::vector<Spread> StudyNumbers::spreads() const {
  std::vector<Spread> all;
  for (const Key& key : order_) all.push_back(spreadOf(key, numbers_.at(key)));
  return all;
}

std::string StudyNumbers::csv() const {
  std::string text = "study,table,row,column,value\n";
  for (const Key& key : order_) {
    for (const auto& [study, value] : numbers_.at(key))
      text += format("%d,\"%s\",\"%s\",\"%s\",%.17g\n", study, key.table.c_str(), key.row.c_str(), key.column.c_str(),
                     value);
  }
  return text;
}

void StudyNumbers::addRow(int study, const Table& table, const std::vector<Cell>& row,
                          const std::set<std::string>& subjects) {
  std::string name;
  for (const Cell& cell : row) {
    const auto* word = std::get_if<std::string>(&cell);
    if (word == nullptr) continue;
    if (subjects.contains(*word)) return;  // numbers of single subjects are not comparable between studies
    name += (name.empty() ? "" : " ") + *word;
  }
  for (std::size_t c = 0; c < row.size() && c < table.columns.size(); ++c) {
    const auto* value = std::get_if<double>(&row[c]);
    if (value == nullptr) continue;
    const Key key{table.id, name, table.columns[c].name};
    const auto [found, is_new] = numbers_.try_emplace(key);
    if (is_new) order_.push_back(key);
    found->second.emplace_back(study, *value);
    if (table.columns[c].format == "p") probabilities_.insert(key);
  }
}

Spread StudyNumbers::spreadOf(const Key& key, const Values& values) const {
  Spread spread{key.table, key.row, key.column, values.size()};
  std::vector<double> sorted;
  for (const auto& [study, value] : values) sorted.push_back(value);
  std::sort(sorted.begin(), sorted.end());
  const auto n = static_cast<double>(sorted.size());
  for (const double value : sorted) spread.mean += value / n;
  for (const double value : sorted) spread.sd += (value - spread.mean) * (value - spread.mean);
  spread.sd = sorted.size() > 1 ? std::sqrt(spread.sd / (n - 1)) : 0;
  const auto quantile = [&](double share) {  // linear interpolation between order statistics
    const double at = share * (n - 1);
    const auto i = static_cast<std::size_t>(at);
    const double next = i + 1 < sorted.size() ? sorted[i + 1] : sorted[i];
    return sorted[i] + (at - static_cast<double>(i)) * (next - sorted[i]);
  };
  spread.low = quantile(0.025);
  spread.high = quantile(0.975);
  if (probabilities_.contains(key)) {
    const auto below = std::count_if(sorted.begin(), sorted.end(), [](double p) { return p < kSignificant; });
    spread.power = static_cast<double>(below) / n;
  }
  return spread;
}

}  // namespace presa::experiment
