#pragma once
#include <string>
#include <vector>

#include "devices/percro_arm/calibration/linked_bases.h"

namespace presa::device {

/// CSV with the columns a_x_m a_y_m a_z_m b_x_m b_y_m b_z_m (others are passed over): at one moment in a line, the
/// position that each of two linked devices reports in the frame of its own base. Throws InputError with every finding:
/// E474 not such a file, E475 a cell that is no number.
std::vector<LinkedSample> readSamples(const std::string& file);
std::string samplesText(const std::vector<LinkedSample>& samples);

}  // namespace presa::device
