#pragma once
#include <string>

#include "apps/common/joint_log.h"

namespace presa::html {

/// "Joints": a table of their ranges, and a plot of the positions over time for each unit. Empty without joints.
/// `max_step`: curves are interrupted where samples are farther apart [s]; 0: never.
std::string jointSection(const JointLog* log, double max_step = 0);

}  // namespace presa::html
