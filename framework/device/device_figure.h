#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/core/math/spatial.h"
#include "framework/plugin/plugin_loader.h"
#include "framework/scene/world.h"

/// What a device looks like in the picture of a run. A driver whose manifest says gives="figure" exports a table with
/// PRESA_DEVICE_FIGURE; for all others nothing is loaded. Frame F: that of the driver's samples.
namespace presa {

/// One shape of a part, placed in the frame P of the part.
struct FigureShape {
  Shape shape;                          ///< no Compound
  std::shared_ptr<const TriMesh> mesh;  ///< of a MeshRef; edges are sharp beyond 40 degrees
  Pose X_PG;                            ///< pose of the shape in P
  Vec3 color = Vec3::Constant(0.5);     ///< linear RGB
  int motor = -1;                       ///< its colour shows the heat of this motor; -1: of none
};

/// Shapes that move together.
struct FigurePart {
  std::string name;                 ///< its node in the view's scene graph is called "ROLE NAME"
  std::vector<FigureShape> shapes;  ///< all of one pose
};

/// All that a figure is drawn from; a recording has the same.
struct FigureMoment {
  double time = 0;               ///< [s]
  Vec3 p_FH = Vec3::Zero();      ///< fingertip, as the driver reported it [m]
  bool oriented = false;         ///< the device measures the orientation
  Quat q_FT = Quat::Identity();  ///< then, of the tool
  Vec3 f_H_F = Vec3::Zero();     ///< force that the device holds on the finger [N]
};

/// Deflection of a device's structure under the force that it holds.
struct FigureDeflection {
  Vec3 d_F = Vec3::Zero();   ///< from the tip that the encoders report to the true one [m]
  double along = 0,          ///< part of d_F along the structure [m]
      across = 0;            ///< part of d_F across the structure [m]
  std::vector<Vec3> line_F;  ///< centre line from the ground to the tip, with the deflection enlarged [m]
};

/// The figure of one device. Thread: view (60 Hz), except for construction; may allocate, nothing waits for it.
class DeviceFigure {
 public:
  virtual ~DeviceFigure() = default;
  /// Constant.
  virtual const std::vector<FigurePart>& parts() const = 0;
  /// Poses X_FP of parts(). Depends on the moment only.
  virtual void place(const FigureMoment& moment, std::vector<Pose>& X_FP) const = 0;
  /// Depends on the moment only; none: not modelled.
  virtual std::optional<FigureDeflection> deflection(const FigureMoment& /*moment*/, double /*enlarged*/) const {
    return std::nullopt;
  }
  /// Every tick of the view, for the heat. A jump in time forgets it.
  virtual void follow(const FigureMoment& /*moment*/) {}
  /// Names of the motors; empty: their heat is not modelled.
  virtual std::vector<std::string> motors() const { return {}; }
  /// Heat of each motor relative to its limit, estimated from the forces since the start; none: the start was not seen.
  virtual std::optional<std::vector<double>> heat() const { return std::nullopt; }
};

/// Table of a figure, which a driver exports with PRESA_DEVICE_FIGURE.
struct FigurePlugin {
  int abi = kPluginAbi;  ///< leave it as it is: another version is refused (E510)
  /// Null when the settings do not say where the device stands; the driver has reported why.
  std::unique_ptr<DeviceFigure> (*create)(const DeviceBinding& binding) = nullptr;
};
inline constexpr const char* kFigureSymbol = "presaDeviceFigure";  ///< returns the FigurePlugin

/// The figure of this device; null where its driver has none, which is then not loaded. Throws InputError as
/// pluginTable.
std::unique_ptr<DeviceFigure> figureOf(const DeviceBinding& binding);

}  // namespace presa

/// Exports `table`, a FigurePlugin that lives as long as the library. Once in a plug-in, outside of namespaces.
#define PRESA_DEVICE_FIGURE(table) \
  extern "C" __attribute__((visibility("default"))) const presa::FigurePlugin* presaDeviceFigure() { return &(table); }
