#pragma once
#include <functional>
#include <string>
#include <vector>

#include "experiments/stability/case.h"
#include "experiments/stability/fingers.h"
#include "experiments/stability/methods.h"
#include "experiments/study/prescribed_finger.h"
#include "framework/device/device_modules.h"

/// A grasp with any number of fingers on exactly known paths, and its comparison with a body on springs.
namespace presa::stability {

/// Fingertips that close on given points of a body, lift it together and then move it.
struct Grip {
  std::vector<Vec3> points;   ///< where the fingertips touch, W, before lifting [m]
  std::vector<Vec3> normals;  ///< of the surface there, out of the body; unit
  double radius = 0.008;      ///< of the fingertips [m]
  double depth = 0.002;       ///< of each fingertip, once closed [m]
  double open = 0.003;        ///< gap before closing [m]
  double lift = 0.03;         ///< [m]
  std::size_t waiting = 0;    ///< further fingers of the scene, which stay away
  /// Motion that is added to a finger from kMoveBegin on.
  std::function<PrescribedFinger::State(std::size_t finger, double time)> move{};

  static constexpr double kCloseBegin = 0.05, kCloseEnd = 0.35, kLiftBegin = 0.4, kLiftEnd = 0.9, kMoveBegin = 1.5;
};
/// Two hands on a bar along x: thumb (-y) and index (+y) at -reach, then at +reach; the bar is 2 `half` wide, its middle
/// grasped at `height` [m].
Grip twoHands(double reach, double half, double height);
PrescribedFinger::State gripState(const Grip& grip, std::size_t finger, double time);
DeviceList gripFingers(const Grip& grip);

/// To and fro along `direction` (m, the amplitude) at `frequency` [Hz]; the amplitude grows over half a second.
PrescribedFinger::State shaken(const Vec3& direction, double frequency, double time);

/// A run in which a grip holds and moves a body.
struct Carried {
  std::string scene;
  std::vector<std::string> sets;
  std::string body;
  Grip grip;
  double stiffness = 0;  ///< of each finger, in contact with the body [N/m]
  /// Normal force of each finger at rest [N]; empty: that of the body at rest on the same springs, which may tilt.
  std::vector<double> forces;
  std::string oracle;  ///< of these forces
  double bound = 0.2;  ///< of the distance [mm]
};
/// Judges the normal forces just before the motion begins (0.1 %), and the distance of the body from a HeldBody on the
/// same springs while it moves (RMS over 3.5 s and the ends of three axes 50 mm long).
std::vector<Finding> carry(const Carried& carried);
/// Trials for 10 and 100 g under fingers of 2 and 10 N/mm, shaken along each axis, with each coupling.
std::vector<Trial> carriedTrials(
    const std::function<std::vector<Finding>(double mass, double stiffness, int axis, const Method&)>& run);

}  // namespace presa::stability
