#include <cstdio>

#include "devices/simulated_subject/settings.h"
#include "framework/core/schedule/rates.h"
#include "framework/device/device_plugin.h"

namespace presa {
namespace {

/// All values drawn for the person and for this run.
std::vector<DeviceFact> factsOf(const SharedSubject& subject) {
  const SubjectSettings& settings = subject.settings();
  std::vector<DeviceFact> facts;
  for (const subject::SubjectParameter& parameter : subject::Population(settings.level).parameters())
    facts.push_back({std::string(parameter.name), std::string(parameter.unit), settings.parameters.*parameter.value});
  const subject::Brain& brain = subject.brain();
  facts.push_back({"device_resolution", "m", settings.resolution, true});
  facts.push_back({"slip_threshold_of_trial", "m", brain.slipThreshold(), true});
  facts.push_back({"misjudgement_of_trial", "1", brain.misjudgement(), true});
  facts.push_back({"scatter_of_trial", "1", brain.scatter(), true});
  facts.push_back({"slip_force_remembered", "N", brain.slipGrip(), true});
  facts.push_back({"grip_wanted", "N", brain.wanted(), true});
  facts.push_back({"drops", "1", static_cast<double>(brain.drops()), true});
  facts.push_back({"grips_raised", "1", static_cast<double>(brain.regrips()), true});
  return facts;
}

/// One digit of a simulated person.
class SimulatedDigit final : public Device {
 public:
  SimulatedDigit(std::shared_ptr<SharedSubject> subject, int digit) : subject_(std::move(subject)), digit_(digit) {}

  bool looks() const override { return digit_ == 0; }
  void see(const ObjectState& objects, const Tick& tick) noexcept override { subject_->see(objects, tick); }
  FingerInput read(const Tick& tick) noexcept override { return subject_->read(digit_, tick); }
  void write(const Wrench& F_H_W, const Tick& tick) noexcept override { subject_->write(digit_, F_H_W.f, tick); }

  std::vector<std::string> phases() const override {
    return {subject::kPhaseNames.begin(), subject::kPhaseNames.end()};
  }
  double damping() const override { return subject_->settings().parameters.grip_damping; }
  double mass() const override {
    return subject_->settings().parameters.hand_mass + subject_->settings().parameters.device_mass;
  }
  std::string model() const override {
    return "simulated subject, level " + std::string(subject::nameOf(subject_->settings().level)) +
           ": a model, not a person";
  }
  std::vector<DeviceFact> facts() const override {
    return digit_ == 0 ? factsOf(*subject_) : std::vector<DeviceFact>{};
  }
  std::vector<std::string> notes() const override {
    if (digit_ != 0) return {};
    const SubjectSettings& settings = subject_->settings();
    std::array<char, 200> text;
    std::snprintf(text.data(), text.size(),
                  "simulated subject %llu of seed %llu, level %s, device steps %.0f um: a model, not a person",
                  static_cast<unsigned long long>(settings.subject), static_cast<unsigned long long>(settings.seed),
                  subject::nameOf(settings.level).data(), settings.resolution * 1e6);
    return {text.data()};
  }

 private:
  std::shared_ptr<SharedSubject> subject_;
  int digit_;
};

/// The digit that `binding` names, of `subject`, which the first digit creates and the second joins. Null with a
/// finding.
std::unique_ptr<Device> makeDigit(const DeviceBinding& binding, const World& world, const RunOptions& options,
                                  std::shared_ptr<SharedSubject>& subject, Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.errorCount();
  const int digit = readDigit(binding, diagnostics);
  const SubjectSettings settings = readSettings(binding, world, options, diagnostics);
  const Grasp grasp = readGrasp(binding, world, diagnostics);
  if (diagnostics.errorCount() > before) return nullptr;
  if (!subject)
    subject = std::make_shared<SharedSubject>(grasp, settings, RateTable(world.scene.rates).period(RateGroup::kHaptic));
  if (subject->settings() != settings)
    diagnostics.error(
        436, binding.where, "role '" + binding.role + "' has other settings than the other digit",
        "both digits are one person: give them the same level, seed, subject, reach, hold, resolution and eyes");
  else if (!subject->take(digit))
    diagnostics.error(438, binding.where, "role '" + binding.role + "' has a digit that another role already has",
                      "a simulated subject has one thumb and one index finger");
  if (diagnostics.errorCount() > before) return nullptr;
  return std::make_unique<SimulatedDigit>(subject, digit);
}

DeviceList create(const std::vector<DeviceBinding>& bindings, const std::shared_ptr<const World>& world,
                  const RunOptions& options, Diagnostics& diagnostics) {
  std::shared_ptr<SharedSubject> subject;  // one person has all digits
  DeviceList digits;
  for (const DeviceBinding& binding : bindings)
    digits.push_back(makeDigit(binding, *world, options, subject, diagnostics));
  return digits;
}

const DevicePlugin kPlugin{.name = "simulated_subject", .create = create, .rating = kImaginedRating};

}  // namespace
}  // namespace presa

PRESA_DEVICE_PLUGIN(presa::kPlugin)
