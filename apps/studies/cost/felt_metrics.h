#pragma once
#include <optional>

#include "apps/studies/cost/trace.h"

/// Errors in what a fingertip judges of a surface.
namespace presa::cost {

/// Just-noticeable difference of stiffness [%] [Jones1990].
inline constexpr double kStiffnessStep = 23;
/// Just-noticeable drop of friction, as a share of the tangential force before [%] [Gueorguiev2017].
inline constexpr double kFrictionStep = 11;

/// RMS of |torque - reference|, of the worst finger [mN m].
std::optional<double> torqueError(const Evidence& setting, const Evidence& reference);
/// RMS of the relative error of force over stretch, of the worst finger [%].
std::optional<double> stiffnessError(const Evidence& setting, const Evidence& reference);
/// RMS of the relative error of tangential over normal force while the reference slips, of the worst finger [%].
std::optional<double> frictionError(const Evidence& setting, const Evidence& reference);
/// Difference of the RMS of the held force between 40 and 400 Hz, of the worst finger [N]. No just-noticeable difference
/// is known to the sources.
std::optional<double> textureError(const Evidence& setting, const Evidence& reference);

}  // namespace presa::cost
