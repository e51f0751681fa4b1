#pragma once
#include <string>

#include "framework/core/diagnostics/diagnostics.h"

namespace presa::experiment {

/// Who takes part: a pseudonym of letters and digits, and the number that picks the row of a square and a group.
struct Subject {
  std::string id;
  int number = 0;  ///< from 1
};

/// `number` 0: the digits that `id` ends in. E910: not a pseudonym; E911: no number.
Subject subjectOf(const std::string& id, int number, Diagnostics& diagnostics);

}  // namespace presa::experiment
