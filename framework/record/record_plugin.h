#pragma once
#include "framework/record/recording.h"

namespace presa {

/// The record plug-in, loaded at the first call, so that a run that neither records nor replays does not load HDF5.
/// Thread: any but the haptic one. Throws InputError: E59x the plug-in cannot be loaded, E600 it was built for another
/// version of Presa.
const RecordPlugin& recordPlugin();

}  // namespace presa

/// The function that the plug-in exports.
extern "C" const presa::RecordPlugin* presaRecordPlugin();
