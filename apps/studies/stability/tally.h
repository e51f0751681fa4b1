#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "apps/studies/stability/rows.h"

namespace presa::stability {

/// Counts of the findings of some rows.
struct Tally {
  std::size_t stable = 0, all = 0, worse = 0;  ///< worse: than expected
  Verdict worst = Verdict::kStable;

  void add(const Row& row);
};

/// The rows of one case, in their order.
std::vector<const Row*> rowsOfCase(const Case& c, const std::vector<Row>& rows);

/// Class of the style sheet that colours a verdict.
const char* cssOf(Verdict verdict);
/// A sign for each verdict, for readers who see no colours: ● stable, ◐ drift, ✕ unstable, ⊘ failed. HTML.
std::string signHtml(Verdict verdict);
/// The sign beside a row whose verdict is worse than expected. HTML.
std::string worseSignHtml();

}  // namespace presa::stability
