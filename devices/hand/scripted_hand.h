#pragma once
#include <memory>

#include "devices/hand/hand.h"
#include "devices/hand/hand_settings.h"

namespace presa {

/// Pushes a fingertip along a motion: position control across the grip, force control along it. Both corrections are
/// slow like a human hand, far below the contact dynamics. Frame W. Thread: haptic; nothing allocates.
class ScriptedHand : public Hand {
 public:
  explicit ScriptedHand(HandSettings settings) : settings_(std::move(settings)) {}

  FingerImpedance impedance() const override { return settings_.impedance; }
  Vec3 start() const override { return motion().at(0).p_WT; }
  void feel(const Fingertip& tip) noexcept override { tip_ = tip; }
  HandPush live(const Tick& tick) noexcept override;

  int phase(double time) const noexcept override { return motion().at(time).phase; }
  std::uint32_t pressed(double time) const noexcept override { return motion().buttonsIn(motion().at(time).phase); }
  int buttons() const override { return motion().buttons(); }
  double lostAt() const override { return settings_.lost_at; }
  std::vector<Place> path() const override;
  std::string model() const override { return "scripted fingers: no person"; }
  std::vector<std::string> phases() const override { return motion().phase_names; }
  std::vector<double> phaseTimes() const override { return motion().phase_times; }
  std::vector<PhaseIntent> phaseIntents() const override { return motion().phase_intents; }
  std::vector<std::string> notes() const override { return settings_.notes; }

  const Motion& motion() const noexcept { return *settings_.motion; }

 private:
  HandSettings settings_;
  Fingertip tip_;
  double grip_ = 0;            // [N] correction of the grip force
  Vec3 carry_ = Vec3::Zero();  // [N] correction that carries the load
};

}  // namespace presa
