#pragma once
#include <string>

#include "framework/core/diagnostics/diagnostics.h"

namespace presa::experiment {

/// A participant: a pseudonym of letters and digits, and the number that selects the row of the Latin square and the
/// group.
struct Subject {
  std::string id;
  int number = 0;  ///< from 1
};

/// `number` 0: use the digits at the end of `id`. E910: `id` is not a pseudonym; E911: no number.
Subject subjectOf(const std::string& id, int number, Diagnostics& diagnostics);

}  // namespace presa::experiment
