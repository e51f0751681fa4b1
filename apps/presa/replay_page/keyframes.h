#pragma once
#include <nlohmann/json_fwd.hpp>

#include "apps/presa/replay_page/figures.h"
#include "framework/record/recording.h"
#include "framework/scene/world.h"

namespace presa::replay_page {

inline constexpr double kMaxKeyframeRate = 100;  ///< [Hz]
inline constexpr std::size_t kMaxKeyframes = 3000;

/// Poses for the picture, sampled evenly: {count, period, moving: [{body, p: [3], q: [4]}], fingers: [{role, radius,
/// hip, proxy, contact, normal, force, valid, mode, body, tool, device}], parts: [{p, q}]}; `device`: it has a figure, whose
/// parts are in the order of shapesOf(); `tool`, a quaternion, only where a device measured
/// it. Bodies that never move are left out; channels as packed.h. Fewer keyframes where many bodies move, so that all
/// of them stay below 1.5 MB.
nlohmann::json keyframesOf(const RecordedSamples& samples, const World& world, const PageFigures& figures);

}  // namespace presa::replay_page
