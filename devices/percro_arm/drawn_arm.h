#pragma once
#include "devices/percro_arm/drawn_parts.h"
#include "devices/percro_arm/kinematics.h"
#include "devices/percro_arm/motors.h"

namespace presa::percro {

/// The figure of one arm. The joints that the encoders counted follow from the reported tip by inverse kinematics, which
/// is exact; so a recording is drawn as its run was.
class DrawnArm final : public DeviceFigure {
 public:
  DrawnArm(const Parameters& parameters, const Pose& X_FD);

  const std::vector<FigurePart>& parts() const override { return parts_; }
  void place(const FigureMoment& moment, std::vector<Pose>& X_FP) const override;
  /// The structure at rest under the held force: f / k in the barrel's frame, with the stiffness at this length.
  std::optional<FigureDeflection> deflection(const FigureMoment& moment, double enlarged) const override;
  /// The controller's estimate: motors.h, driven by the force that the arm holds and the weight that it carries.
  void follow(const FigureMoment& moment) override;
  std::vector<std::string> motors() const override { return {"left", "right", "barrel"}; }
  std::optional<std::vector<double>> heat() const override;

 private:
  Joints jointsOf(const FigureMoment& moment) const;

  const Parameters parameters_;
  const Pose X_FD_;
  const std::vector<FigurePart> parts_;
  MotorDrive drive_;
  std::optional<double> time_;  // of the last moment followed [s]
  bool known_ = false;          // the motors were followed from their cold start on
};

/// For the table of the driver. Null unless the settings have a base pose.
std::unique_ptr<DeviceFigure> makeDrawnArm(const DeviceBinding& binding);

}  // namespace presa::percro
