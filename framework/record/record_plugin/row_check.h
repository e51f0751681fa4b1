#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "framework/core/diagnostics/diagnostics.h"
#include "framework/record/record_plugin/rows.h"

namespace presa::record {

/// Allowed values of a column: whole numbers from `min` to `max`, or (`finite`) any finite real number.
struct Rule {
  std::string column;
  std::int64_t min = 0, max = -1;
  bool finite = false;
};

/// Rules for a recording with this many fingers and scene bodies. Measured values have no rules.
std::vector<Rule> tickRules(std::uint64_t fingers);
std::vector<Rule> fingerRules(std::uint64_t scene_bodies);
std::vector<Rule> orderRules(std::uint64_t scene_bodies);
std::vector<Rule> scheduleRules();

/// Applies rules to the rows of one table and remembers the first violation of each.
class RowCheck {
 public:
  /// Rules for columns that the table lacks (older format) are ignored.
  RowCheck(std::string path, const Table& table, const std::vector<Rule>& rules);
  /// `row` has the layout of the table.
  void check(const void* row, std::uint64_t number);
  /// Reports violations in the first `rows` rows as E675.
  void report(const std::string& file, std::uint64_t rows, Diagnostics& findings) const;

 private:
  struct Watched {
    Rule rule;
    Column column;
    std::uint64_t broken = 0;  ///< rows
    std::uint64_t first = 0;
    std::string found;
  };
  std::string path_;
  std::vector<Watched> watched_;
};

}  // namespace presa::record
