#pragma once
#include <string>
#include <vector>

#include "apps/studies/cost/study.h"

namespace presa::cost {

inline constexpr const char* kLawFactor = "law";

/// The factor that gives every touchable material with friction another law. A value is the name of a law's plug-in,
/// which may be followed by values of its element: "friction_lugre:stiffness=1000:speed=0.02". The laws of this tree
/// have usual values for what their element requires. Errors (E802) go to `diagnostics`.
Factor lawFactor(const std::vector<std::string>& values, const Scene& scene, const SourceLocation& where,
                 Diagnostics& diagnostics);

}  // namespace presa::cost
