#pragma once
#include <string>

#include "framework/core/diagnostics/diagnostics.h"

namespace presa::experiment {

/// The error text when `act` is refused, otherwise "accepted".
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
