#include "apps/python/binding/simulation.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "framework/scene/xml/escaped.h"
#include "framework/session/load_world.h"

namespace presa::python {
namespace {

enum SimulationCode { kFingersMissing = 150 };

/// Every role must be given, and nothing but roles.
void checkRoles(const Scene& scene, const Setup& setup, Diagnostics& diagnostics) {
  std::vector<std::string> roles;
  for (const DeviceRole& device : scene.devices) {
    roles.push_back(device.role);
    if (!setup.fingers.contains(device.role))
      diagnostics.error(kFingersMissing, device.where, "finger '" + device.role + "' has no start position",
                        "fingers={...} names all fingers of the scene, or is left out: then the rig moves them");
  }
  for (const auto& [role, place] : setup.fingers) {
    if (std::ranges::find(roles, role) == roles.end())
      diagnostics.error(kFingersMissing, {scene.file, 0, 0},
                        "the scene has no finger '" + role + "'" + didYouMean(role, roles),
                        roles.empty() ? "it has none" : "its first is '" + roles.front() + "'");
  }
}

/// Binds the fingers that a program moves to the driver whose rating holds for them. MovedFinger takes its place; a
/// recording keeps the rig, and its replay needs no program.
std::string rigOfMoved(const Setup& setup) {
  if (setup.fingers.empty()) return {};
  std::string text = "<rig version=\"1.0\" name=\"moved_fingers\">";
  for (const auto& [role, place] : setup.fingers)
    text += "<device role=\"" + xml::escaped(role) + "\" driver=\"pointer\"/>";
  return text + "</rig>";
}

}  // namespace

/// The only call that acts on the run, as long as this exists.
class Simulation::Turn {
 public:
  explicit Turn(std::atomic_flag& busy) : busy_(busy) {
    if (busy_.test_and_set(std::memory_order_acquire)) throw std::logic_error("the simulation is being stepped");
  }
  ~Turn() { busy_.clear(std::memory_order_release); }
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

 private:
  std::atomic_flag& busy_;
};

Simulation::Read Simulation::read(const Setup& setup) {
  RunOptions options;
  options.realtime = false;
  options.seed = setup.seed;
  options.duration = setup.duration > 0 ? setup.duration : setup.fingers.empty() ? 0 : Simulation::kEndless;
  options.record = setup.record;
  options.overwrite = setup.overwrite;
  options.bound_stiffness = setup.fingers.empty();  // as `presa run`; a moved finger yields to no force
  Diagnostics diagnostics;
  Read read{
      loadWorld({setup.scene, setup.rig, setup.sets, setup.text, rigOfMoved(setup)}, std::move(options), diagnostics),
      {}};
  if (!setup.fingers.empty() && read.loaded.world) checkRoles(read.loaded.world->scene, setup, diagnostics);
  if (diagnostics.hasErrors()) throw InputError(diagnostics);
  for (const Diagnostic& finding : diagnostics.all()) read.notes.push_back(format(finding));
  return read;
}

Simulation::Simulation(const Setup& setup) : Simulation(setup, read(setup)) {}

Simulation::Simulation(const Setup& setup, Read read) : notes_(std::move(read.notes)), snapshot_(*read.loaded.world) {
  Session::Options options;
  for (const DeviceRole& device : read.loaded.world->scene.devices) {
    const auto start = setup.fingers.find(device.role);
    if (start == setup.fingers.end()) break;
    targets_.push_back(start->second);
    auto finger = std::make_unique<MovedFinger>(Vec3(start->second.data()));
    moved_.push_back(finger.get());
    options.devices.push_back(std::move(finger));
  }
  auto tap = std::make_unique<SnapshotTap>(snapshot_);
  tap_ = tap.get();
  options.more.push_back(std::move(tap));
  run_ = std::make_unique<Run>(std::move(read.loaded), control_, std::move(options));
  const auto& said = run_->session().notes();
  notes_.insert(notes_.end(), said.begin(), said.end());
  left_ = run_->executor().rates().ticksWithin(RateGroup::kHaptic, run_->options().duration);
}

Simulation::~Simulation() {
  try {
    close();
  } catch (...) {  // a module that fails to stop: nobody is left who could be told
  }
}

bool Simulation::step(std::uint64_t ticks, const std::function<void()>& pause) {
  const Turn turn(busy_);
  if (closed_) throw std::logic_error("the simulation is closed");
  if (!begun_) begin();
  if (ticks == 0 || left_ == 0) return left_ > 0;
  for (std::size_t f = 0; f < moved_.size(); ++f) moved_[f]->goTo(Vec3(targets_[f].data()), ticks);
  ticks = std::min(ticks, left_);
  for (; ticks > 1; pause()) {
    const std::uint64_t part = std::min(ticks - 1, kPauseTicks);
    run_->advance(part);
    ticks -= part;
    left_ -= part;
  }
  tap_->want(true);
  run_->advance(1);
  tap_->want(false);
  --left_;
  return left_ > 0;
}

void Simulation::begin() {
  try {
    run_->begin();
  } catch (...) {
    end();
    throw;
  }
  begun_ = true;
}

void Simulation::close() {
  const Turn turn(busy_);
  end();
}

// A recording is closed also where no tick was run: it then holds none.
void Simulation::end() {
  if (std::exchange(closed_, true)) return;
  if (begun_)
    run_->finish();
  else if (Recorder* recorder = run_->session().recorder())
    recorder->finish();
}

void Simulation::press(std::size_t finger, std::uint32_t buttons) {
  if (finger >= moved_.size()) throw std::logic_error("the devices of the rig move the fingers of this simulation");
  moved_[finger]->press(buttons);
}

}  // namespace presa::python
