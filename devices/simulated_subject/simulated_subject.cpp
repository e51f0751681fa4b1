#include <cstdio>

#include "devices/hand/hand_plugin.h"
#include "devices/simulated_subject/settings.h"
#include "framework/core/schedule/rates.h"
#include "framework/device/device_plugin.h"

namespace presa {
namespace {

/// All values drawn for the person and for this run, told by the first digit.
std::vector<DeviceFact> factsOf(const SharedSubject& subject, int digit) {
  if (digit != 0) return {};
  const SubjectSettings& settings = subject.settings();
  std::vector<DeviceFact> facts;
  const subject::Population population(settings.level);
  for (const subject::SubjectParameter& parameter : population.parameters())
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

std::vector<std::string> phaseNames() { return {subject::kPhaseNames.begin(), subject::kPhaseNames.end()}; }

std::string modelOf(const SharedSubject& subject) {
  return "simulated subject, level " + std::string(subject::nameOf(subject.settings().level)) +
         ": a model, not a person";
}

std::vector<std::string> notesOf(const SharedSubject& subject, int digit) {
  if (digit != 0) return {};
  const SubjectSettings& settings = subject.settings();
  std::array<char, 200> text;
  std::snprintf(text.data(), text.size(),
                "simulated subject %llu of seed %llu, level %s, device steps %.0f um: a model, not a person",
                static_cast<unsigned long long>(settings.subject), static_cast<unsigned long long>(settings.seed),
                subject::nameOf(settings.level).data(), settings.resolution * 1e6);
  return {text.data()};
}

/// One digit of a simulated person in a device without mass and friction.
class SimulatedDigit final : public Device {
 public:
  SimulatedDigit(std::shared_ptr<SharedSubject> subject, int digit) : subject_(std::move(subject)), digit_(digit) {}

  bool looks() const override { return digit_ == 0; }
  void see(const ObjectState& objects, const Tick& tick) noexcept override { subject_->see(objects, tick); }
  FingerInput read(const Tick& tick) noexcept override { return subject_->read(digit_, tick); }
  void write(const Wrench& F_H_W, const Tick& tick) noexcept override { subject_->write(digit_, F_H_W.f, tick); }

  std::vector<std::string> phases() const override { return phaseNames(); }
  double damping() const override { return subject_->settings().parameters.grip_damping; }
  double mass() const override {
    return subject_->settings().parameters.hand_mass + subject_->settings().parameters.device_mass;
  }
  std::string model() const override { return modelOf(*subject_); }
  std::vector<DeviceFact> facts() const override { return factsOf(*subject_, digit_); }
  std::vector<std::string> notes() const override { return notesOf(*subject_, digit_); }

 private:
  std::shared_ptr<SharedSubject> subject_;
  int digit_;
};

/// One digit that wears a modelled device, which brings its own mass.
class WornDigit final : public Hand {
 public:
  WornDigit(std::shared_ptr<SharedSubject> subject, int digit) : subject_(std::move(subject)), digit_(digit) {}

  /// The muscles' springs and dampers are in push().
  FingerImpedance impedance() const override {
    return {.mass = subject_->settings().parameters.hand_mass, .stiffness = 0, .damping = 0};
  }
  double damping() const override { return subject_->settings().parameters.grip_damping; }
  Vec3 start() const override { return subject_->start(digit_); }
  void feel(const Fingertip& tip) noexcept override { subject_->feel(digit_, tip); }
  HandPush live(const Tick& tick) noexcept override { return subject_->push(digit_, tick); }
  int phase(double /*time*/) const noexcept override { return static_cast<int>(subject_->brain().phase()); }
  std::uint32_t pressed(double /*time*/) const noexcept override { return subject_->pressed(); }

  bool looks() const override { return digit_ == 0; }
  void see(const ObjectState& objects, const Tick& tick) noexcept override { subject_->see(objects, tick); }
  std::vector<std::string> phases() const override { return phaseNames(); }
  std::string model() const override { return modelOf(*subject_); }
  std::vector<DeviceFact> facts() const override { return factsOf(*subject_, digit_); }
  std::vector<std::string> notes() const override { return notesOf(*subject_, digit_); }

 private:
  std::shared_ptr<SharedSubject> subject_;
  int digit_;
};

/// The subject, which its first digit creates and the second joins.
struct Person {
  std::shared_ptr<SharedSubject> subject;
  const std::shared_ptr<const World>& world;
  const RunOptions& options;
  Diagnostics& diagnostics;

  /// The digit that `binding` names; none with a finding. `resolution`: of its device; none: drawn.
  std::optional<int> join(const DeviceBinding& binding, std::optional<double> resolution) {
    const std::size_t before = diagnostics.errorCount();
    const int digit = readDigit(binding, diagnostics);
    const SubjectSettings settings = readSettings(binding, *world, options, resolution, diagnostics);
    const Grasp grasp = readGrasp(binding, *world, diagnostics);
    if (diagnostics.errorCount() > before) return std::nullopt;
    if (!subject)
      subject =
          std::make_shared<SharedSubject>(grasp, settings, RateTable(world->scene.rates).period(RateGroup::kHaptic));
    if (subject->settings() != settings)
      diagnostics.error(
          436, binding.where, "role '" + binding.role + "' has other settings than the other digit",
          "both digits are one person: give them the same level, seed, subject, reach, hold, resolution and eyes");
    else if (!subject->take(digit))
      diagnostics.error(438, binding.where, "role '" + binding.role + "' has a digit that another role already has",
                        "a simulated subject has one thumb and one index finger");
    if (diagnostics.errorCount() > before) return std::nullopt;
    return digit;
  }
};

DeviceList create(const std::vector<DeviceBinding>& bindings, const std::shared_ptr<const World>& world,
                  const RunOptions& options, Diagnostics& diagnostics) {
  Person person{{}, world, options, diagnostics};
  DeviceList digits;
  for (const DeviceBinding& binding : bindings) {
    const std::optional<int> digit = person.join(binding, std::nullopt);
    digits.push_back(digit ? std::make_unique<SimulatedDigit>(person.subject, *digit) : nullptr);
  }
  return digits;
}

/// The person has learnt one resolution: that of the first thimble where it touches the object.
std::optional<double> resolutionOf(const std::vector<Thimble>& thimbles, const World& world, Diagnostics& diagnostics) {
  if (thimbles.empty()) return std::nullopt;
  const Grasp grasp = readGrasp(thimbles.front().binding, world, diagnostics);
  return thimbles.front().step(grasp.p_WB);
}

HandList createHands(const std::vector<Thimble>& thimbles, const std::shared_ptr<const World>& world,
                     const RunOptions& options, Diagnostics& diagnostics) {
  Diagnostics found_again;
  const std::optional<double> resolution = resolutionOf(thimbles, *world, found_again);
  Person person{{}, world, options, diagnostics};
  HandList digits;
  for (const Thimble& thimble : thimbles) {
    const std::optional<int> digit = person.join(thimble.binding, resolution);
    digits.push_back(digit ? std::make_unique<WornDigit>(person.subject, *digit) : nullptr);
  }
  return digits;
}

const HandPlugin kHand{.create = createHands};
const DevicePlugin kPlugin{.name = "simulated_subject", .create = create, .rating = kImaginedRating};

}  // namespace
}  // namespace presa

PRESA_DEVICE_PLUGIN(presa::kPlugin)
PRESA_HAND_PLUGIN(presa::kHand)
