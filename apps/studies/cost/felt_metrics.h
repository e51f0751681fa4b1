#pragma once
#include <optional>
#include <vector>

#include "apps/studies/cost/trace.h"

/// Errors in what a fingertip judges of a surface.
namespace presa::cost {

/// Just-noticeable difference of stiffness [%] [Jones1990].
inline constexpr double kStiffnessStep = 23;
/// Just-noticeable drop of friction, as a share of the tangential force before [%] [Gueorguiev2017].
inline constexpr double kFrictionStep = 11;
/// Just-noticeable share of a vibration: the smallest median over places, frequencies (10 and 125 Hz) and magnitudes,
/// 0.20 to 0.58 [Forta2012, abstract].
inline constexpr double kVibrationStep = 0.2;
/// Vibration [N] below which that share is not used: near the absolute threshold it takes a factor of ten [Hatzfeld2012,
/// abstract].
inline constexpr double kFaintVibration = 0.01;

/// RMS of |torque - reference|, of the worst finger [mN m].
std::optional<double> torqueError(const Evidence& setting, const Evidence& reference);
/// RMS of the relative error of force over stretch, of the worst finger [%].
std::optional<double> stiffnessError(const Evidence& setting, const Evidence& reference);
/// RMS of the relative error of tangential over normal force while the reference slips, of the worst finger [%].
std::optional<double> frictionError(const Evidence& setting, const Evidence& reference);
/// Evidence::vibration of a run, from the rest of its evidence. Empty: it held no force in the compared window.
std::vector<double> vibrationOf(const Evidence& e);
/// Difference of the RMS of the held force between 40 and 400 Hz, of the worst finger [N].
std::optional<double> textureError(const Evidence& setting, const Evidence& reference);
/// Just-noticeable difference of that RMS [N]: kVibrationStep of the finger's that vibrates most. None below
/// kFaintVibration, where the fraction grows.
std::optional<double> textureNoticeable(const Evidence& reference);

}  // namespace presa::cost
