#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "framework/core/diagnostics/diagnostics.h"
#include "framework/record/record_plugin/rows.h"

namespace presa::record {

/// What a column may hold: whole numbers in a range, or, without a range, any real number that is one.
struct Rule {
  std::string column;
  std::int64_t min = 0, max = -1;
  bool finite = false;
};

/// The rules of a recording with so many fingers whose scene has so many bodies; values that are measured have none.
std::vector<Rule> tickRules(std::uint64_t fingers);
std::vector<Rule> fingerRules(std::uint64_t scene_bodies);
std::vector<Rule> scheduleRules();

/// Applies rules to the rows of one table, and keeps of each the first that breaks it.
class RowCheck {
 public:
  /// Rules of columns that the table does not have (an older version of the format) fall away.
  RowCheck(std::string path, const Table& table, const std::vector<Rule>& rules);
  /// `row`: laid out as the table says.
  void check(const void* row, std::uint64_t number);
  /// What was broken in the first `rows`, as E675.
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
