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
#include "framework/sound/sound_output.h"
#include "framework/sound/strike.h"

namespace presa {
namespace {

using sound::Loudspeaker;
using sound::Strike;

class Sound final : public Module, public sound::SoundOutput {
 public:
  Sound(std::shared_ptr<const World> world, const RunOptions& options)
      : Module("sound", RateGroup::kDynamics),
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
    hits_->read(next_, [&](const BodyHit& hit) {
      for (const auto& pair : pairs_)
        if (pair->materials.holds(hit, world_->scene)) hear(pair->strikeOf(hit));
      return true;
    });
  }

  void stop() override {
    player_gone_ = loudspeaker_ && loudspeaker_->hasGone();
    loudspeaker_.reset();
    if (file_.empty()) return;
    std::ofstream file(file_, std::ios::binary);
    if (!(file << sound::wavOf(heard_)).flush()) trouble_ = "it could not be written";
  }

  std::vector<std::string> stages() const override {
    return {
        "hear the bodies that hit each other: played through aplay in real time or with a window, kept for --sound"};
  }

  std::vector<std::string> notes() const override {
    std::vector<std::string> all;
    if (plays_ && !input::isOnPath(Loudspeaker::kPlayer))
      all.emplace_back("the scene's sounds are not heard: aplay is not on the PATH (Debian: alsa-utils)");
    if (player_gone_)
      all.emplace_back("the scene's sounds were not heard: aplay ended; is there a sound card? (aplay -l)");
    if (late_ > 0) all.push_back(std::to_string(late_) + " sounds after the first half hour are not in " + file_);
    return all;
  }

  std::string trouble() const override { return trouble_; }

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
    if (file_.empty()) return;
    if (strike.time > sound::kLongestWav)
      ++late_;
    else
      heard_.push_back(strike);
  }

  In<BodyHits> hits_{*this, kBodyHitsPort, In<BodyHits>::Optional{}};  // no body moves: silence
  const std::shared_ptr<const World> world_;
  const bool plays_;
  const std::string file_;
  std::vector<std::unique_ptr<Pair>> pairs_;  // in the order of the scene
  std::optional<Loudspeaker> loudspeaker_;
  std::uint64_t next_ = 0;
  std::vector<Strike> heard_;  // for the file
  std::uint64_t late_ = 0;     // too late for it
  bool player_gone_ = false;
  std::string trouble_;
};

const ModulePlugin kPlugin{
    .name = "sound",
    .create = [](std::shared_ptr<const World> world, const RunOptions& options) -> std::unique_ptr<Module> {
      return std::make_unique<Sound>(std::move(world), options);
    }};

}  // namespace
}  // namespace presa

PRESA_MODULE_PLUGIN(presa::kPlugin)
