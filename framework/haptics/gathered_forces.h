#pragma once
#include <array>
#include <cstdint>

#include "framework/core/exchange/bounded_list.h"
#include "framework/haptics/balanced_forces.h"

namespace presa {

/// One of many small forces on a tool, in the frame of the tool or along the world's axes, from the tool's origin.
struct SmallForce {
  std::uint32_t solid = 0;                                  ///< number of its body
  Vec3 p = Vec3::Zero();                                    ///< where it acts [m]
  Vec3 nhat = Vec3::UnitZ();                                ///< unit, body into tool
  Vec3 f = Vec3::Zero();                                    ///< on the tool [N]
  bool slips = false;                                       ///< friction does not hold it
  double pressure() const noexcept { return f.dot(nhat); }  ///< its normal part [N]
};

/// Many small forces as a few: each octant of the contact with a body has a force of its own, so that the body feels a
/// torque against tilting. First all are weighed(), then all are added(), in any order. Thread: haptic; nonblocking.
class GatheredForces {
 public:
  static constexpr std::size_t kMaxBodies = 8,  ///< bodies that a tool touches
      kMax = 8 * kMaxBodies;                    ///< forces on a tool

  /// Counts a force for the middle of its body's contact. False: the tool touches more than kMaxBodies bodies; the others
  /// bear its share.
  bool weigh(const SmallForce& force) noexcept;
  void add(const SmallForce& force) noexcept;  ///< after all were weighed

  /// Lists the gathered forces, changed so that they add up to `wrench` about the tool's origin (balanceForces). `bodyOf`
  /// gives the body and the friction of a number. `stiffness`: of handle, tool and contact in series [N/m]. In the frame of
  /// the forces that were added, places from the tool's origin.
  template <class BodyOf>
  void write(double stiffness, const Vec6& wrench, const BodyOf& bodyOf,
             BoundedList<ToolForce>& forces) const noexcept {
    double pressure = 0;
    for (std::size_t b = 0; b < count_; ++b) pressure += bodies_[b].pressure;
    if (!(pressure > 0)) return;
    for (std::size_t b = 0; b < count_; ++b) {
      for (const Octant& octant : bodies_[b].octants) {
        if (!(octant.pressure > 0)) continue;
        ToolForce force = forceOf(octant);
        bodyOf(bodies_[b].solid, force);
        force.stiffness = stiffness * octant.pressure / pressure;
        forces.add(force);
      }
    }
    balanceForces(forces, wrench);
  }

 private:
  struct Octant {
    Vec3 f = Vec3::Zero(), place = Vec3::Zero(), normals = Vec3::Zero();
    double pressure = 0;  // sum of the normal forces [N]
    bool sticks = false;
  };
  struct BodyContact {
    std::uint32_t solid = 0;
    Vec3 moment = Vec3::Zero();  // of the pressures about the origin
    double pressure = 0;
    std::array<Octant, 8> octants;
  };
  BodyContact* with(std::uint32_t solid) noexcept;
  static ToolForce forceOf(const Octant& octant) noexcept;

  std::array<BodyContact, kMaxBodies> bodies_;
  std::size_t count_ = 0;
};

}  // namespace presa
