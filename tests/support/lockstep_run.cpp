#include "tests/support/lockstep_run.h"

#include <algorithm>
#include <stdexcept>

#include "framework/session/run.h"

namespace presa::test {
namespace {

Loaded load(const std::string& scene, const std::vector<std::string>& sets) {
  Diagnostics diagnostics;
  RunOptions options;
  options.duration = 0;  // that of the script
  Loaded loaded = loadWorld({scene, {}, sets}, options, diagnostics);
  if (diagnostics.hasErrors()) throw InputError(std::move(diagnostics));
  return loaded;
}

template <class List, class Named>
std::size_t indexOf(const List& list, const Named& named, const std::string& what) {
  const auto found = std::find_if(list.begin(), list.end(), named);
  if (found == list.end()) throw std::out_of_range("the scene has no " + what);
  return static_cast<std::size_t>(found - list.begin());
}

}  // namespace

struct LockstepRun::Parts {
  Parts(const std::string& scene, const std::vector<std::string>& sets) : run(load(scene, sets), control) {}
  RunControl control;
  Run run;
  std::vector<std::string> faults;
};

LockstepRun::LockstepRun(const std::string& scene, const std::vector<std::string>& sets)
    : parts_(std::make_unique<Parts>(scene, sets)) {
  Run& run = parts_->run;
  run.execute();
  std::vector<std::string>& faults = parts_->faults;
  if (const auto broken = run.session().brokenPlugin()) faults.push_back(*broken + " broke its contract");
  if (run.monitor().objectFaults() != 0)
    faults.push_back("the dynamics had a fault at " + std::to_string(run.monitor().objectFaultTime()) + " s");
  if (run.monitor().popThrough() != 0) faults.push_back("a fingertip went through a surface");
}
LockstepRun::~LockstepRun() = default;

double LockstepRun::rise(const std::string& body) const {
  const auto named = [&](const Body& one) { return one.name == body; };
  const std::size_t i = indexOf(parts_->run.world().scene.bodies, named, "body '" + body + "'");
  const ObjectSummary& object = parts_->run.monitor().objects()[i];
  return object.highest.z() - object.start.z();
}

double LockstepRun::maxNormalForce(const std::string& role) const {
  const auto named = [&](const DeviceRole& one) { return one.role == role; };
  const std::size_t i = indexOf(parts_->run.world().scene.devices, named, "role '" + role + "'");
  return parts_->run.monitor().fingers()[i].max_normal_force;
}

const std::vector<std::string>& LockstepRun::faults() const noexcept { return parts_->faults; }

}  // namespace presa::test
