#pragma once
#include <string>

#include "framework/record/recording.h"

namespace presa::record {

/// See RecordPlugin::samples.
RecordedSamples readSamples(const std::string& file);

}  // namespace presa::record
