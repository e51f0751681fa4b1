#include "framework/plugin/plugin_loader.h"
#include "framework/record/record_plugin.h"
#include "framework/record/record_plugin/reader.h"
#include "framework/record/record_plugin/recorder.h"
#include "framework/record/record_plugin/samples.h"

namespace {

const presa::RecordPlugin kPlugin{
    presa::kPluginAbi,
    [](std::shared_ptr<const presa::World> world, const presa::RunOptions& options,
       const presa::RecordedDevices& devices) -> std::unique_ptr<presa::Recorder> {
      return std::make_unique<presa::record::FileRecorder>(std::move(world), options, devices);
    },
    presa::record::readRecording,
    presa::record::readSamples,
};

}  // namespace

const presa::RecordPlugin* presaRecordPlugin() { return &kPlugin; }
