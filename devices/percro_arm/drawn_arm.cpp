#include "devices/percro_arm/drawn_arm.h"

#include <algorithm>
#include <cmath>

#include "devices/hand/hand_settings.h"
#include "devices/percro_arm/dynamics.h"
#include "devices/percro_arm/properties.h"

namespace presa::percro {
namespace {

constexpr double kJump = 0.25;  // moments farther apart are not one motion [s]
constexpr double kCold = 0.05;  // a run that is seen from here on started with cold motors [s]
constexpr int kLinePieces = 24;
const Vec3 kRoomGravity_W{0, 0, -9.81};  // as the model's

Quat about(double angle, const Vec3& axis) { return Quat(Eigen::AngleAxisd(angle, axis)); }

}  // namespace

DrawnArm::DrawnArm(const Parameters& parameters, const Pose& X_FD)
    : parameters_(parameters), X_FD_(X_FD), parts_(drawnParts(parameters)), drive_(parameters.motors) {}

Joints DrawnArm::jointsOf(const FigureMoment& moment) const {
  return jointsAt(parameters_.geometry, X_FD_.inverseTimes(moment.p_FH));
}

void DrawnArm::place(const FigureMoment& moment, std::vector<Pose>& X_FP) const {
  const Joints q = jointsOf(moment);
  const Quat barrel(barrelFrame(q));
  const Quat thimble = moment.oriented ? Quat(X_FD_.q.conjugate() * moment.q_FT) : barrel;
  const Vec3 wrist = wristAt(q, thimble.toRotationMatrix());
  const Vec3 tip = tipPosition(parameters_.geometry, q);
  const Quat fork = barrel * about(wrist[0], Vec3::UnitX());
  X_FP.assign(kDrawnParts, Pose{});
  X_FP[kLeftPulley].q = about(q[0] + q[1], Vec3::UnitZ());  // of eq. 1, over tau_1; with its motor's sign
  X_FP[kRightPulley].q = about(q[0] - q[1], Vec3::UnitZ());
  X_FP[kGimbal].q = about(q[0], Vec3::UnitZ());
  X_FP[kOuterTube].q = barrel;
  X_FP[kDrum] = {barrel * drumShaft(parameters_),
                 barrel * about(-q[2] / parameters_.geometry.drum_radius, Vec3::UnitZ())};
  X_FP[kInnerTube] = {tip, barrel};
  X_FP[kFork] = {tip, fork};
  X_FP[kRing] = {tip, fork * about(wrist[1], Vec3::UnitY())};
  X_FP[kThimble] = {tip, thimble};
  for (Pose& X : X_FP) X = X_FD_ * X;
}

std::optional<FigureDeflection> DrawnArm::deflection(const FigureMoment& moment, double enlarged) const {
  const Joints q = jointsOf(moment);
  const double length = parameters_.geometry.length_min + q[2];
  const Quat q_FB = X_FD_.q * Quat(barrelFrame(q));
  const Vec3 k = ArmDynamics(parameters_, Vec3::Zero()).stiffness(length);
  const Vec3 d_B = -(q_FB.conjugate() * moment.f_H_F).cwiseQuotient(k);  // the finger pushes back
  FigureDeflection result{
      .d_F = q_FB * d_B, .along = std::abs(d_B.x()), .across = std::hypot(d_B.y(), d_B.z()), .line_F = {}};
  for (int i = 0; i <= kLinePieces; ++i) {
    const double s = static_cast<double>(i) / kLinePieces, bent = s * s * (3 - s) / 2;  // a beam loaded at its end
    const Vec3 p_B = s * length * Vec3::UnitX() + enlarged * Vec3(s, bent, bent).cwiseProduct(d_B);
    result.line_F.push_back(X_FD_.p + q_FB * p_B);
  }
  return result;
}

// The force of a moment is held until the next one.
void DrawnArm::follow(const FigureMoment& moment) {
  const double step = moment.time - time_.value_or(moment.time + 1);
  time_ = moment.time;
  if (step >= 0 && step <= kJump) {
    if (step > 0) drive_.step(step);  // held: nothing warms
  } else {
    drive_ = MotorDrive(parameters_.motors);
    known_ = moment.time <= kCold;
  }
  const Joints q = jointsOf(moment);
  const Vec3 f_D = X_FD_.q.conjugate() * moment.f_H_F;
  const Mat3 to_motor_torque = transmissionInverse(parameters_.geometry).transpose();
  const ArmDynamics dynamics(parameters_, X_FD_.q.conjugate() * kRoomGravity_W);
  drive_.command(to_motor_torque * dynamics.weight(q),
                 to_motor_torque * (jacobian(parameters_.geometry, q).transpose() * f_D));
}

std::optional<std::vector<double>> DrawnArm::heat() const {
  if (!known_) return std::nullopt;
  const Vec3& heat = drive_.heat();
  return std::vector<double>{heat[0], heat[1], heat[2]};
}

std::unique_ptr<DeviceFigure> makeDrawnArm(const DeviceBinding& binding) {
  const std::vector<double> p = settingNumbers(binding, "pos"), q = settingNumbers(binding, "quat");
  if (p.size() != 3 || q.size() != 4) return nullptr;
  Parameters arm = paperArm();
  if (const auto without = binding.settings.find("without"); without != binding.settings.end())
    removeProperties(without->second.value, arm);
  return std::make_unique<DrawnArm>(arm, Pose{{p[0], p[1], p[2]}, Quat(q[0], q[1], q[2], q[3]).normalized()});
}

}  // namespace presa::percro
