#include "framework/plugin/plugin_loader.h"
#include "framework/record/mesh_sums.h"
#include "framework/record/record_plugin.h"
#include "framework/record/record_plugin/inspection.h"
#include "framework/record/record_plugin/open_file.h"
#include "framework/record/record_plugin/reader.h"
#include "framework/record/record_plugin/recorder.h"
#include "framework/record/record_plugin/recording_file.h"
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

void presaRecordedMeshSums(const std::string& recording, std::string& sums) {
  using namespace presa::record;
  const h5::Library library;
  const OpenedFile opened = openFile(recording);
  if (!h5::hasAttribute(opened.handle, kMeshSumsAttribute)) return;
  presa::Diagnostics findings;
  Inspection look(recording, opened.handle, opened.bytes, findings);
  sums = look.text("", kMeshSumsAttribute);
  if (findings.hasErrors()) throw presa::InputError(std::move(findings));
}
