#pragma once
#include "framework/core/exchange/bounded_list.h"
#include "framework/haptics/tool_renderer.h"
#include "framework/haptics/virtual_coupling.h"

namespace presa {

/// Changes forces so that they add up to `wrench` about the origin that their places count from: the force exactly, the
/// torque as far as places that lie apart can give it. Each changes by its stiffness, as springs would. Places, forces
/// and wrench are in one frame. Places nearer to each other than `lever` [m] hardly give a torque: they would pull against
/// each other with large forces. Thread: any; nonblocking.
void balanceForces(BoundedList<ToolForce>& forces, const Vec6& wrench, double lever = 0) noexcept;

}  // namespace presa
