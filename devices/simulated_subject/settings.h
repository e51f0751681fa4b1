#pragma once
#include "devices/simulated_subject/shared_subject.h"
#include "framework/core/diagnostics/diagnostics.h"

namespace presa {

/// Reads and checks a role's settings; the findings go to `diagnostics`. Fingers' radii are left at 0 when a role is missing.
SubjectSettings readSettings(const DeviceBinding& binding, const World& world, Diagnostics& diagnostics);
/// What is gripped: the body named by `object`, else the only free one that fingers can touch.
Grasp readGrasp(const DeviceBinding& binding, const World& world, Diagnostics& diagnostics);
/// 0 thumb, 1 index: from `digit`, else from the role's name.
int readDigit(const DeviceBinding& binding, Diagnostics& diagnostics);

}  // namespace presa
