#pragma once
#include <memory>
#include <optional>
#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <string>
#include <vector>

#include "framework/device/device_figure.h"
#include "framework/device/frame_tree.h"
#include "framework/scene/world.h"
#include "modules/view_osg/shown_parts.h"
#include "modules/view_osg/view_frame.h"

namespace presa::view {

inline constexpr double kDeflectionScale = 100;  ///< deflections are drawn this many times as large

/// Colour of a motor at this heat, 1 at its limit: blue, green, yellow, red. Linear RGB.
Vec3 heatColor(double heat);

/// The devices of the rig whose drivers say what they look like, placed by what they report. On demand the deflected
/// centre line of each one's structure, and the heat of its motors as their colour.
class DeviceFigures {
 public:
  /// Loads those drivers, and only those (their manifests say it). Null without one; else without shapes until
  /// setQuick(). Throws InputError.
  static std::unique_ptr<DeviceFigures> of(const World& world);

  osg::Group* root() { return root_; }
  osg::Group* lines() { return lines_; }
  /// Simplified for software rendering.
  void setQuick(bool quick);
  /// Every step, drawn or not: for the heat.
  void follow(const ViewFrame& frame);
  void update(const ViewFrame& frame, const ShownParts& parts);

  /// Whether the device of that finger has a figure.
  bool has(std::size_t finger) const;
  /// Radius of a ball about this point that holds all of them [m].
  double reachFrom(const Vec3& center) const;
  /// What the colours depend on, coarsely.
  void appendAppearance(std::vector<double>& appearance) const;

  /// One device, as of the last update().
  struct Told {
    std::string role;
    std::optional<FigureDeflection> deflection;
    std::vector<std::string> motors;
    std::optional<std::vector<double>> heat;
  };
  std::vector<Told> told() const;

 private:
  struct Motor {
    int index;
    Vec3 own_color;
    osg::ref_ptr<osg::Geometry> shape;
  };
  struct Figure {
    std::size_t finger = 0;
    std::string role;
    int frame = FrameTree::kWorld;
    std::unique_ptr<DeviceFigure> drawn;
    std::vector<osg::ref_ptr<osg::MatrixTransform>> parts;
    std::vector<Motor> motors;
    osg::ref_ptr<osg::Geometry> line;
    std::optional<FigureDeflection> deflection;
  };
  DeviceFigures();
  void makeShapes(Figure& figure, bool quick);
  void addLine(Figure& figure);
  /// Where the frame of a device stands in the world, and how many metres of the world one of its metres is.
  struct Stand {
    Pose X_WF;
    double zoom = 1;

    Vec3 operator*(const Vec3& p_F) const { return X_WF * Vec3(zoom * p_F); }
    Vec3 inverseTimes(const Vec3& p_W) const { return X_WF.inverseTimes(p_W) / zoom; }
  };
  Stand standOf(const Figure& figure, const ViewFrame& frame);
  /// None: the device reports nothing; its figure stays where it was.
  std::optional<FigureMoment> momentOf(const Figure& figure, const Stand& stand, const ViewFrame& frame) const;
  void color(Figure& figure, bool by_heat);

  osg::ref_ptr<osg::Group> root_ = new osg::Group, lines_ = new osg::Group, solid_lines_ = new osg::Group;
  std::vector<Figure> figures_;
  std::optional<FrameTree> frames_;  // only where a device stands in one
  std::size_t roles_ = 0;            // of the scene; FrameTree counts its frames from there
  bool by_heat_ = false;
};

}  // namespace presa::view
