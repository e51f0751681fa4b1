#pragma once
#include <string>

#include "framework/core/diagnostics/diagnostics.h"

namespace presa::experiment {

/// What is said when `act` is refused, "accepted" when it is not.
template <class Act>
std::string refusalOf(Act act) {
  try {
    act();
  } catch (const InputError& error) {
    return error.diagnostics().text();
  }
  return "accepted";
}

}  // namespace presa::experiment
