#pragma once
#include <string>

#include "framework/record/recording.h"

namespace presa::record {

/// See RecordPlugin::read.
Recording readRecording(const std::string& file);

}  // namespace presa::record
