#pragma once
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "framework/device/device_figure.h"
#include "framework/record/recording.h"
#include "framework/scene/world.h"

namespace presa::replay_page {

/// The figure of one device of a recording. A device in a <frame> of the rig is left out of pages.
struct PageFigure {
  std::size_t finger;  ///< in the order of the scene's roles
  std::unique_ptr<DeviceFigure> drawn;
};
using PageFigures = std::vector<PageFigure>;

/// Loads the drivers that have figures, and no others. Throws InputError.
PageFigures figuresOf(const Rig& rig, const RecordedSamples& samples);

std::size_t partCount(const PageFigures& figures);

/// Poses of a figure's parts at these ticks, by part.
std::vector<std::vector<Pose>> motionOf(const PageFigure& figure, const RecordedSamples& samples,
                                        const std::vector<std::size_t>& rows);

}  // namespace presa::replay_page
