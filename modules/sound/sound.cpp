// Bodies that hit each other are heard: played as they hit where people attend the run, written to a file on request.
#include <algorithm>
#include <fstream>
#include <optional>
#include <vector>

#include "framework/core/graph/port.h"
#include "framework/haptics/material_pair.h"
#include "framework/haptics/plugin_object.h"
#include "framework/input/on_path.h"
#include "framework/session/module_plugin.h"
#include "framework/sound/loudspeaker.h"
#include "framework/sound/strike.h"

namespace presa {
namespace {

using sound::Loudspeaker;
using sound::Strike;

class Sound final : public Module {
 public:
  Sound(std::shared_ptr<const World> world, const RunOptions& options)
      : Module("sound", RateGroup::kView),
        world_(std::move(world)),
        plays_(options.realtime || options.view == RunOptions::View::kWindow),
        file_(options.sound) {
    for (const PluginElement& element : world_->scene.plugin_elements) {
      if (element.element != "sound") continue;
      pairs_.push_back(madeFor(element, [&] { return std::make_unique<Pair>(element, world_->scene); }));
    }
  }

  void start() override {
    if (plays_ && input::isOnPath(Loudspeaker::kPlayer)) loudspeaker_.emplace();
  }

  void step(const Tick&) noexcept override {
    lost_ += hits_->read(next_, [&](const BodyHit& hit) {
      for (const auto& pair : pairs_)
        if (pair->materials.holds(hit, world_->scene)) hear(pair->strikeOf(hit));
      return true;
    });
  }

  void stop() override {
    loudspeaker_.reset();
    if (file_.empty()) return;
    std::ofstream file(file_, std::ios::binary);
    unwritten_ = !(file << sound::wavOf(heard_)).flush();
  }

  std::vector<std::string> stages() const override {
    std::vector<std::string> all;
    if (plays_) all.emplace_back("play the bodies that hit each other, through aplay");
    if (!file_.empty()) all.push_back("keep them for " + file_);
    if (all.empty()) all.emplace_back("nothing: nobody listens to this run, and --sound names no file");
    return all;
  }

  std::vector<std::string> notes() const override {
    std::vector<std::string> all;
    if (plays_ && !input::isOnPath(Loudspeaker::kPlayer))
      all.emplace_back("the scene's sounds are not heard: aplay is not on the PATH (Debian: alsa-utils)");
    if (lost_ > 0) all.push_back(std::to_string(lost_) + " hits between bodies were not heard: the view was late");
    if (unwritten_) all.push_back("no sound " + file_ + ": it could not be written");
    return all;
  }

 private:
  /// One element.
  struct Pair {
    Pair(const PluginElement& element, const Scene& scene)
        : materials(element, scene),
          frequency(element.number("frequency")),
          decay(element.number("decay")),
          loudness(element.number("loudness")) {}
    Strike strikeOf(const BodyHit& hit) const {
      return {
          .time = hit.time, .frequency = frequency, .decay = decay, .loudness = std::min(1.0, loudness * hit.speed)};
    }
    MaterialPair materials;
    double frequency, decay, loudness;
  };

  void hear(const Strike& strike) {
    if (loudspeaker_) loudspeaker_->play(strike);
    if (!file_.empty()) heard_.push_back(strike);
  }

  In<BodyHits> hits_{*this, kBodyHitsPort, In<BodyHits>::Optional{}};  // no body moves: silence
  const std::shared_ptr<const World> world_;
  const bool plays_;
  const std::string file_;
  std::vector<std::unique_ptr<Pair>> pairs_;  // in the order of the scene
  std::optional<Loudspeaker> loudspeaker_;
  std::uint64_t next_ = 0, lost_ = 0;
  std::vector<Strike> heard_;  // for the file
  bool unwritten_ = false;
};

const ModulePlugin kPlugin{
    .name = "sound",
    .create = [](std::shared_ptr<const World> world, const RunOptions& options) -> std::unique_ptr<Module> {
      return std::make_unique<Sound>(std::move(world), options);
    }};

}  // namespace
}  // namespace presa

PRESA_MODULE_PLUGIN(presa::kPlugin)
