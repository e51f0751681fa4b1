#include "devices/percro_arm/drawn_parts.h"

#include <numbers>

#include "devices/percro_arm/drawn_shapes.h"

namespace presa::percro {
namespace {

constexpr double kPi = std::numbers::pi;
const Vec3 kAluminium(0.50, 0.52, 0.55), kBright(0.68, 0.70, 0.73), kMotor(0.045, 0.050, 0.062);
const Vec3 kCarbon(0.022, 0.024, 0.028), kPulley(0.16, 0.22, 0.30), kAccent(0.72, 0.36, 0.05),
    kRubber(0.03, 0.10, 0.17);

// [m]
constexpr double kAboveDesk = 0.14, kPlate = 0.012;                     // axes over the desk
constexpr double kCheek = 0.125, kCheekThick = 0.012;                   // z of the two cheeks that carry the tilt axis
constexpr double kPulleyAt = 0.098, kPulleyWide = 0.010, kRim = 0.009;  // z of the driven pulleys
constexpr double kCapstan = 0.006, kMotorRadius = 0.022, kMotorLong = 0.062;
constexpr double kGimbalRadius = 0.046, kGimbalThick = 0.0055, kShaft = 0.007;
constexpr double kTubeRadius = 0.0185, kWall = 0.0025, kTubeFront = 0.345, kBehindMotor = 0.040;
constexpr double kYawPulley = 0.038;
constexpr double kDrumWide = 0.010, kDrumBelow = 0.012;  // the cable runs this far below the barrel's axis
constexpr double kWrist = 0.038;                         // from the end of the inner tube to the tip
constexpr double kInnerLong = 0.720, kCore = 0.0065, kRod = 0.0018, kRodAside = 0.0080, kSpacer = 0.0128;
constexpr double kForkRadius = 0.0215, kForkThick = 0.0020, kRingRadius = 0.0172, kRingThick = 0.0015;
constexpr double kSleeveInner = 0.0092, kSleeveOuter = 0.0106, kSleeveFrom = -0.0070, kSleeveTo = -0.0015;

Quat turned(double angle, const Vec3& axis) { return Quat(Eigen::AngleAxisd(angle, axis)); }
const Quat kAlongX = turned(kPi / 2, Vec3::UnitY()), kAlongY = turned(-kPi / 2, Vec3::UnitX());
const Quat kAlongZ = Quat::Identity();  // the axis of every round shape

FigureShape solid(Shape shape, const Vec3& p, const Quat& q, const Vec3& color) {
  return {.shape = std::move(shape), .mesh = nullptr, .X_PG = {p, q}, .color = color};
}
FigureShape meshed(std::shared_ptr<const TriMesh> mesh, const Vec3& p, const Quat& q, const Vec3& color) {
  return {.shape = MeshRef{}, .mesh = std::move(mesh), .X_PG = {p, q}, .color = color};
}

/// Of the two motors of the differential, in D; side: sign of z.
Vec3 capstanAt(const Parameters& parameters, double side) {
  const double apart = (parameters.geometry.tilt_ratio + 1) * kCapstan;
  return {-0.6 * apart, -0.8 * apart, side * kPulleyAt};
}

FigurePart base(const Parameters& parameters) {
  FigurePart part{"base", {}};
  auto& all = part.shapes;
  all.push_back(solid(Box{{0.22, kPlate, 0.38}}, {-0.02, kPlate / 2 - kAboveDesk, 0}, kAlongZ, kAluminium));
  int motor = 0;
  for (const double side : {-1.0, 1.0}) {
    const Vec3 capstan = capstanAt(parameters, side);
    const double high = kAboveDesk - kPlate;
    all.push_back(solid(Box{{0.040, high, kCheekThick}}, {0, -high / 2, side * kCheek}, kAlongZ, kAluminium));
    all.push_back(solid(Cylinder{0.020, kCheekThick}, {0, 0, side * kCheek}, kAlongZ, kAluminium));
    all.push_back(solid(Cylinder{0.012, 0.022}, {0, 0, side * (kCheek + 0.004)}, kAlongZ, kBright));
    const double low = high + capstan.y() + kMotorRadius;  // height of the motor's bracket
    all.push_back(solid(Box{{2 * kMotorRadius, low, kCheekThick}}, {capstan.x(), low / 2 - high, side * kCheek},
                        kAlongZ, kAluminium));
    all.push_back(solid(Cylinder{kCapstan, 0.03}, capstan, kAlongZ, kBright));
    const double middle = side * (kCheek + kCheekThick / 2 + kMotorLong / 2);
    FigureShape body = solid(Cylinder{kMotorRadius, kMotorLong}, {capstan.x(), capstan.y(), middle}, kAlongZ, kMotor);
    body.motor = motor++;
    all.push_back(body);
    all.push_back(solid(Cylinder{0.013, 0.014}, {capstan.x(), capstan.y(), middle + side * (kMotorLong / 2 + 0.007)},
                        kAlongZ, kBright));  // its encoder
  }
  return part;
}

FigurePart pulley(const std::string& name, const Parameters& parameters, double side) {
  const double radius = parameters.geometry.tilt_ratio * kCapstan, z = side * kPulleyAt;
  FigurePart part{name,
                  {meshed(tube(radius - kRim, radius, kPulleyWide), {0, 0, z}, kAlongZ, kPulley),
                   solid(Cylinder{0.016, kPulleyWide}, {0, 0, z}, kAlongZ, kPulley)}};
  constexpr int kSpokes = 5;
  for (int i = 0; i < kSpokes; ++i) {
    const Quat q = turned(2 * kPi * i / kSpokes, Vec3::UnitZ());
    part.shapes.push_back(
        solid(Box{{radius - kRim, 0.010, 0.006}}, Vec3(0, 0, z) + q * Vec3(radius / 2 - kRim / 2, 0, 0), q, kPulley));
  }
  return part;
}

FigurePart gimbal() {
  FigurePart part{"gimbal", {meshed(bow(kGimbalRadius, kGimbalThick, 0, 2 * kPi), Vec3::Zero(), kAlongX, kAccent)}};
  const double length = kCheek - kGimbalRadius;
  for (const double side : {-1.0, 1.0}) {
    part.shapes.push_back(
        solid(Cylinder{kShaft, length}, {0, 0, side * (kGimbalRadius + length / 2)}, kAlongZ, kBright));
    part.shapes.push_back(solid(Cylinder{0.011, 0.016}, {0, side * kGimbalRadius, 0}, kAlongY, kAccent));
  }
  return part;
}

FigurePart outerTube(const Parameters& parameters) {
  const Vec3 shaft = drumShaft(parameters);
  const double back = shaft.x() - kBehindMotor, length = kTubeFront - back, middle = (kTubeFront + back) / 2;
  FigurePart part{"outer tube",
                  {meshed(tube(kTubeRadius - kWall, kTubeRadius, length), {middle, 0, 0}, kAlongX, kAluminium)}};
  auto& all = part.shapes;
  for (const double x : {back + 0.005, kTubeFront - 0.008})  // the bearings of the inner tube
    all.push_back(meshed(tube(kSpacer + 0.0005, kTubeRadius + 0.0035, 0.016), {x, 0, 0}, kAlongX, kBright));
  all.push_back(meshed(tube(kTubeRadius, kTubeRadius + 0.005, 0.044), Vec3::Zero(), kAlongX, kBright));
  const double top = kGimbalRadius + 0.020;
  all.push_back(solid(Cylinder{kShaft, top - kTubeRadius}, {0, (top + kTubeRadius) / 2, 0}, kAlongY, kBright));
  all.push_back(solid(Cylinder{kShaft, kGimbalRadius - kTubeRadius}, {0, -(kGimbalRadius + kTubeRadius) / 2, 0},
                      kAlongY, kBright));
  all.push_back(solid(Cylinder{kYawPulley, 0.009}, {0, top, 0}, kAlongY, kPulley));
  all.push_back(solid(Cylinder{0.012, 0.015}, {0, top, 0}, kAlongY, kBright));
  const double high = -shaft.y() - kTubeRadius;
  for (const double side : {-1.0, 1.0})
    all.push_back(solid(Box{{0.026, high + 0.020, 0.004}},
                        {shaft.x(), -kTubeRadius - high / 2, side * (kDrumWide / 2 + 0.004)}, kAlongZ, kAluminium));
  const double edge = kDrumWide / 2 + 0.006;
  FigureShape body =
      solid(Cylinder{kMotorRadius, kMotorLong}, shaft + Vec3(0, 0, edge + kMotorLong / 2), kAlongZ, kMotor);
  body.motor = 2;
  all.push_back(body);
  all.push_back(solid(Cylinder{0.013, 0.014}, shaft + Vec3(0, 0, edge + kMotorLong + 0.007), kAlongZ, kBright));
  return part;
}

FigurePart drum(const Parameters& parameters) {
  const double radius = parameters.geometry.drum_radius;
  FigurePart part{"drum",
                  {meshed(tube(radius - 0.008, radius, kDrumWide), Vec3::Zero(), kAlongZ, kPulley),
                   solid(Cylinder{0.009, kDrumWide + 0.004}, Vec3::Zero(), kAlongZ, kBright)}};
  for (int i = 0; i < 3; ++i)
    part.shapes.push_back(
        solid(Box{{2 * (radius - 0.006), 0.007, 0.005}}, Vec3::Zero(), turned(kPi * i / 3, Vec3::UnitZ()), kPulley));
  return part;
}

// [Bergamasco2006 2.1.2]: four rods along the barrel keep its torsional stiffness.
FigurePart innerTube() {
  const double middle = -kWrist - kInnerLong / 2;
  FigurePart part{"inner tube", {solid(Cylinder{kCore, kInnerLong}, {middle, 0, 0}, kAlongX, kCarbon)}};
  auto& all = part.shapes;
  for (const double y : {-kRodAside, kRodAside})
    for (const double z : {-kRodAside, kRodAside})
      all.push_back(solid(Cylinder{kRod, kInnerLong}, {middle, y, z}, kAlongX, kBright));
  constexpr int kSpacers = 6;
  for (int i = 0; i < kSpacers; ++i)
    all.push_back(solid(Cylinder{kSpacer, 0.006}, {-kWrist - 0.003 - (kInnerLong - 0.006) * i / (kSpacers - 1), 0, 0},
                        kAlongX, kAluminium));
  return part;
}

FigurePart fork() {
  const double from = -kWrist, to = -kForkRadius, length = to - from;
  FigurePart part{"fork",
                  {meshed(bow(kForkRadius, kForkThick, kPi / 2, 3 * kPi / 2), Vec3::Zero(), kAlongZ, kAluminium),
                   solid(Cylinder{0.0055, length}, {(from + to) / 2, 0, 0}, kAlongX, kBright),
                   solid(Cylinder{0.0085, 0.007}, {from + 0.0045, 0, 0}, kAlongX, kAccent)}};
  for (const double side : {-1.0, 1.0})
    part.shapes.push_back(solid(Cylinder{0.0032, 0.0065}, {0, side * kForkRadius, 0}, kAlongY, kBright));
  return part;
}

FigurePart wristRing() {
  FigurePart part{"ring", {meshed(bow(kRingRadius, kRingThick, 0, 2 * kPi), Vec3::Zero(), kAlongX, kAccent)}};
  const double gap = kForkRadius - kRingRadius;
  for (const double side : {-1.0, 1.0}) {
    part.shapes.push_back(solid(Cylinder{0.0012, gap}, {0, side * (kRingRadius + gap / 2), 0}, kAlongY, kBright));
    part.shapes.push_back(solid(Cylinder{0.0028, 0.0052}, {0, 0, side * kRingRadius}, kAlongZ, kBright));
  }
  return part;
}

// Open at both ends: the fingertip is drawn at the surface that it touches, which the reported tip lies beyond.
FigurePart thimble() {
  const double length = kSleeveTo - kSleeveFrom, middle = (kSleeveFrom + kSleeveTo) / 2,
               gap = kRingRadius - kSleeveOuter;
  FigurePart part{"thimble", {meshed(tube(kSleeveInner, kSleeveOuter, length), {middle, 0, 0}, kAlongX, kRubber)}};
  for (const double side : {-1.0, 1.0}) {
    part.shapes.push_back(solid(Cylinder{0.0012, gap}, {0, 0, side * (kSleeveOuter + gap / 2)}, kAlongZ, kBright));
    part.shapes.push_back(solid(Box{{-middle + 0.003, 0.004, 0.0022}}, {middle / 2, 0, side * (kSleeveOuter + 0.0002)},
                                kAlongZ, kRubber));
  }
  return part;
}

}  // namespace

Vec3 drumShaft(const Parameters& parameters) {
  return {-parameters.masses.counterweight_arm, -kDrumBelow - parameters.geometry.drum_radius, 0};
}

std::vector<FigurePart> drawnParts(const Parameters& parameters) {
  return {base(parameters),
          pulley("left pulley", parameters, -1),
          pulley("right pulley", parameters, 1),
          gimbal(),
          outerTube(parameters),
          drum(parameters),
          innerTube(),
          fork(),
          wristRing(),
          thimble()};
}

}  // namespace presa::percro
