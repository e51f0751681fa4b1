#pragma once
#include <ode/ode.h>

#include <optional>
#include <vector>

#include "framework/assembly/attraction.h"
#include "modules/dynamics_ode/body_set.h"
#include "modules/dynamics_ode/sleep.h"

namespace presa::ode {

/// Draws bodies where an assembly wants them, and puts for good what has arrived there (framework/assembly/attraction.h). Drawing is a
/// velocity motor of ODE with a bounded force: solved with the contacts, so that friction does not stop it short.
class Attractor {
 public:
  /// Its motors live in `ode_world` and go before it.
  Attractor(const BodySet& bodies, dWorldID ode_world);
  ~Attractor();
  Attractor(const Attractor&) = delete;
  Attractor& operator=(const Attractor&) = delete;

  /// At the start of a period: takes what is asked for now, fixes and frees bodies, and wakes what that concerns.
  void read(const Attractions& attractions, BodySet& bodies, Sleep* sleep);
  /// Carries what is fixed a bit nearer to its pose: a jump would be felt, and kick its neighbours. Wakes what is in
  /// its way; `sleep` is null where nothing sleeps.
  void carry(BodySet& bodies, Sleep* sleep, double h) const;
  /// Sets the motors for the next sub-step of `h`.
  void drive(const BodySet& bodies, double h);

  static constexpr double kCarrySpeed = 0.01;  ///< [m/s]
  static constexpr double kCarrySpin = 0.2;    ///< [rad/s]

 private:
  bool isNews(std::size_t i);
  static void wakeAround(std::size_t i, BodySet& bodies, Sleep& sleep);

  struct Motors {
    dJointID linear = nullptr, angular = nullptr;  ///< null for a fixed body
  };
  Attractions wanted_;
  std::vector<const Attraction*> drawn_;           // by body, into wanted_; null: free
  std::vector<std::optional<Attraction>> before_;  // by body: what it was last woken for
  std::vector<Motors> motors_;                     // by body
};

}  // namespace presa::ode
