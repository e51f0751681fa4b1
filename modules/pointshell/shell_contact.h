#pragma once
#include <cstdint>
#include <vector>

#include "framework/core/exchange/bounded_list.h"
#include "framework/geometry/point_shell.h"
#include "framework/haptics/virtual_coupling.h"
#include "modules/pointshell/solid.h"

namespace presa {

/// How points press on solids.
struct ShellLaw {
  double stiffness = 200000;   ///< of a contact as a whole [N/m]
  bool printed = false;        ///< the lectures' law
  std::size_t budget = 60000;  ///< points that a tick examines
};

/// A point of the tool that may touch a solid in this tick.
struct NearPoint {
  Eigen::Vector3f p_T = Eigen::Vector3f::Zero();  ///< [m]
  std::uint32_t point = 0;                        ///< index in the shell
  std::uint32_t solid = 0;                        ///< index of the solid
  bool is_new = false;                            ///< the last gathering did not find it
  std::uint32_t normal_of = 0;                    ///< evaluation that found the normal; an old one: none is known
  Vec3 nhat_T = Vec3::Zero();                     ///< of the surface, outward
};

/// A point in contact, in the tool's frame T.
struct TouchingPoint {
  std::uint32_t point = 0, solid = 0;  ///< as in NearPoint
  Vec3 p_T = Vec3::Zero();             ///< [m]
  Vec3 nhat_T = Vec3::Zero();          ///< unit, direction of the force on the tool without friction
  Vec3 slope_T = Vec3::Zero();         ///< a motion of the point lowers the depth by so much
  double depth = 0;                    ///< > 0 [m]
  double weight = 0;                   ///< share of the stiffness that this point has
  Vec3 f_T = Vec3::Zero();             ///< on the tool [N]
  bool slips = false;                  ///< friction does not hold it
  bool is_new = false;                 ///< as in NearPoint
};

/// One tool's points against all solids. Capacities are fixed. Thread: haptic; nonblocking except for construction.
class ShellContact {
 public:
  /// All references must outlive it. The caller keeps `X_WB` (poses) and `friction` (static and dynamic coefficients), by
  /// solid, up to date.
  ShellContact(const PointShell& shell, const std::vector<Solid>& solids, const std::vector<Pose>& X_WB,
               const std::vector<FrictionCoefficients>& friction, const ShellLaw& law);

  /// Finds the points that a tool at X_WT can bring into contact while no point moves farther than `margin` [m], and of
  /// those as many levels of the shell as budget and room allow. Keeps what an earlier tick found as long as that will do;
  /// for this it looks `ahead` beyond the margin [m]. False: not all levels.
  bool gather(const Pose& X_WT, double margin, double ahead) noexcept;
  /// The next evaluation looks for all normals anew; those after it use the same, as long as no point has moved far.
  void forgetNormals() noexcept { ++normals_; }
  /// Distance between the ball around the tool and the nearest solid: a lower bound of the clearance [m].
  double clearance(const Pose& X_WT) const noexcept;

  /// Forces at a pose: the wrench on the tool about its origin, in T, whose resistance to motion in T it adds to
  /// `stiffness`.
  Vec6 evaluate(const Pose& X_WT, Mat6& stiffness) noexcept;
  /// Distance of the nearest of the gathered points at the last evaluation, negative in contact [m].
  double nearest() const noexcept { return nearest_; }
  const BoundedList<TouchingPoint>& touching() const noexcept { return touching_; }  ///< at the last evaluation
  /// Ends the tick at the last evaluation: friction holds the points where they are.
  void keepHolds() noexcept;
  /// The tool touches nothing: friction holds no point.
  void letGo() noexcept;

 private:
  static constexpr std::size_t kMaxNear = 1024;

  static constexpr char kSlid = 1, kSlips = 2, kSticks = 4;  // bits of slides_ while a tick ends

  /// What friction remembers of a point.
  struct Hold {
    std::int32_t solid = -1;       // that it touches; -1: none
    std::uint32_t gathering = 0;   // the last one that found it
    Vec3 anchor_B = Vec3::Zero();  // where friction holds it [m]
  };

  /// Whether the points of the last gathering are all that a tool at X_WT can bring into contact within `margin`.
  bool stillHolds(const Pose& X_WT, double margin) const noexcept;
  bool gatherFrom(std::uint32_t solid, const Pose& X_BT, double margin, const PointShell::Level& level) noexcept;
  void findTouching(const Pose& X_WT) noexcept;
  void touchAsPrinted(const NearPoint& near, const SeenSolid& solid) noexcept;
  const Vec3& normalOf(NearPoint& near, const SeenSolid& solid) const noexcept;
  /// The tangential stretch of a point in T [m]; zero: friction does not hold it yet.
  Vec3 stretchOf(const TouchingPoint& one, bool held) const noexcept;
  /// Friction of a point over stiffness and weight.
  struct Tangential {
    Vec3 stretch = Vec3::Zero();     // its force [m]
    Mat3 resistance = Mat3::Zero();  // to the point's motion along the surface
  };
  /// Also says whether it slips.
  Tangential frictionOf(TouchingPoint& one) const noexcept;

  const PointShell& shell_;
  const std::vector<Solid>& solids_;
  const std::vector<Pose>& X_WB_;
  const std::vector<FrictionCoefficients>& friction_;
  const ShellLaw law_;
  std::vector<Pose> X_TB_;           // at the last evaluation, by solid
  std::vector<Pose> X_BT_gathered_;  // at the last gathering, by solid
  double reach_ = -1;                // margin of the last gathering [m]
  bool whole_ = true;                // it has all levels
  std::uint32_t gathering_ = 1;      // its number
  std::uint32_t normals_ = 1;        // number of the normals in use
  BoundedList<NearPoint> near_;
  BoundedList<TouchingPoint> touching_;
  std::vector<Hold> holds_;                      // by point
  BoundedList<std::uint32_t> held_, next_held_;  // points with a hold
  std::vector<char> slides_;                     // by solid: all of its points slipped at the end of the last tick
  std::vector<Vec3> stretch_B_;                  // by solid: mean stretch at the end of the last tick [m]
  std::vector<Eigen::Vector4d> sums_;            // of weighted stretches, and of weights, while a tick ends
  std::size_t examined_ = 0;
  double nearest_ = 0;
};

}  // namespace presa
