#pragma once
#include <memory>
#include <string>

#include "framework/core/math/spatial.h"

namespace presa::test {

/// One friction law and one finger that slides over a plane with the normal z, without a run. The element is read like
/// any scene's, with the plug-in's manifest:
///
///     FrictionTrack track("<dahl stiffness=\"2000\"/>", {.mu_static = 0.6, .mu_dynamic = 0.6});
///     EXPECT_LT(track.slide({0.1, 0, 0}).x(), 0);
class FrictionTrack {
 public:
  /// Constant values of the contact.
  struct Contact {
    double mu_static = 0.8,   ///< of the material [-]
        mu_dynamic = 0.6;     ///< of the material [-]
    double normal_force = 1;  ///< [N]
    double stiffness = 1000;  ///< of the surface [N/m]
    double period = 1e-3;     ///< [s]
  };
  /// Throws InputError with every finding.
  FrictionTrack(const std::string& element, const Contact& contact);
  ~FrictionTrack();

  /// One tick in which the finger slides with that tangential velocity [m/s]. Returns the force on the finger [N]; NaN
  /// if the law's answer breaks its contract (framework/haptics/friction_law.h).
  /// Nonblocking if the law is: put a RealTimeGuard around it.
  Vec3 slide(const Vec3& velocity) noexcept;
  /// The same at another normal force from now on [N].
  void press(double normal_force) noexcept;
  bool slipping() const noexcept;  ///< FrictionAnswer::slipping of the last tick

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace presa::test
