#pragma once
#include "devices/simulated_subject/shared_subject.h"
#include "framework/core/diagnostics/diagnostics.h"
#include "framework/scene/run_options.h"

namespace presa {

/// Reads and checks a role's settings; the findings go to `diagnostics`. `resolution`: of the device where the rig gives
/// none [m]; none: drawn.
SubjectSettings readSettings(const DeviceBinding& binding, const World& world, const RunOptions& options,
                             std::optional<double> resolution, Diagnostics& diagnostics);
/// The gripped body: the one named by `object`, otherwise the only free body with a haptic geometry. The fingertip
/// radius of a missing role is 0.
Grasp readGrasp(const DeviceBinding& binding, const World& world, Diagnostics& diagnostics);
/// 0 thumb, 1 index: by `digit`, otherwise by the role's name.
int readDigit(const DeviceBinding& binding, Diagnostics& diagnostics);

}  // namespace presa
