#include "modules/view_osg/device_figures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <osg/BlendFunc>
#include <osg/Depth>

#include "modules/view_osg/osg_convert.h"
#include "modules/view_osg/placed_nodes.h"
#include "modules/view_osg/scene_nodes.h"
#include "modules/view_osg/shaders.h"

namespace presa::view {
namespace {

const std::array<Vec3, 4> kHeat{Vec3(0.03, 0.16, 0.62), Vec3(0.02, 0.48, 0.34), Vec3(0.95, 0.62, 0.02),
                                Vec3(0.85, 0.02, 0.01)};
const Vec3 kUnknown(0.25, 0.25, 0.25);
const Vec3 kLineColor(0.95, 0.10, 0.55);
constexpr double kFigureLine = 0.004;  // [m]
constexpr int kSectionPieces = 10;     // pieces of its section
constexpr double kHeatShades = 50;
constexpr Roundness kFineFigure{40, 8}, kQuickFigure{24, 6};  ///< of parts of a few centimetres

/// The centre line as a round bar, in world coordinates.
ShadedMesh barAlong(const std::vector<Vec3>& line) {
  ShadedMesh mesh;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Vec3 along = (line[std::min(i + 1, line.size() - 1)] - line[i > 0 ? i - 1 : 0]).normalized();
    const Vec3 u = along.unitOrthogonal(), v = along.cross(u);
    for (int k = 0; k < kSectionPieces; ++k) {
      const double angle = 2 * std::numbers::pi * k / kSectionPieces;
      const Vec3 normal = std::cos(angle) * u + std::sin(angle) * v;
      mesh.positions.emplace_back((line[i] + kFigureLine * normal).cast<float>());
      mesh.normals.emplace_back(normal.cast<float>());
      if (i + 1 == line.size()) continue;
      const auto low = static_cast<std::uint32_t>(i) * kSectionPieces, high = low + kSectionPieces;
      const auto here = static_cast<std::uint32_t>(k), next = static_cast<std::uint32_t>((k + 1) % kSectionPieces);
      for (const std::uint32_t corner : {low + here, low + next, high + next, low + here, high + next, high + here})
        mesh.indices.push_back(corner);
    }
  }
  return mesh;
}

osg::ref_ptr<osg::Node> paleWhereHidden(osg::Group* solid) {
  osg::ref_ptr<osg::Group> ghost = new osg::Group;
  osg::StateSet* state = ghost->getOrCreateStateSet();
  state->addUniform(new osg::Uniform("opacity", 0.55F), osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE);
  state->setAttributeAndModes(new osg::BlendFunc(osg::BlendFunc::SRC_ALPHA, osg::BlendFunc::ONE_MINUS_SRC_ALPHA));
  state->setAttributeAndModes(new osg::Depth(osg::Depth::GREATER, 0, 1, false));
  state->setRenderBinDetails(9, "DepthSortedBin");
  ghost->addChild(solid);
  return ghost;
}

}  // namespace

Vec3 heatColor(double heat) {
  const double place = std::clamp(heat, 0.0, 1.0) * (kHeat.size() - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(place), kHeat.size() - 2);
  return kHeat[below] + (place - static_cast<double>(below)) * (kHeat[below + 1] - kHeat[below]);
}

DeviceFigures::DeviceFigures() {
  root_->setName("devices");
  root_->getOrCreateStateSet()->addUniform(new osg::Uniform("grid_strength", 0.0F));
  osg::StateSet* state = solid_lines_->getOrCreateStateSet();
  state->setAttributeAndModes(shaders::glyph());
  state->addUniform(new osg::Uniform("opacity", 1.0F));
  lines_->addChild(solid_lines_);
  lines_->addChild(paleWhereHidden(solid_lines_));
}

std::unique_ptr<DeviceFigures> DeviceFigures::of(const World& world) {
  std::unique_ptr<DeviceFigures> all;
  for (std::size_t f = 0; f < world.scene.devices.size(); ++f) {
    const std::string& role = world.scene.devices[f].role;
    const auto binding = std::ranges::find(world.rig.devices, role, &DeviceBinding::role);
    if (binding == world.rig.devices.end() || binding->driver.empty()) continue;  // a viewer's rig drives nothing
    Figure figure;
    figure.finger = f;
    figure.role = role;
    figure.drawn = figureOf(*binding);
    if (!figure.drawn) continue;
    if (!all) all.reset(new DeviceFigures);
    all->roles_ = world.scene.devices.size();
    if (binding->frame != kWorldFrame) {
      if (!all->frames_) all->frames_.emplace(world.rig, world.scene.devices);
      figure.frame = all->frames_->find(binding->frame);
    }
    for (const FigurePart& part : figure.drawn->parts()) {
      figure.parts.push_back(placed(new osg::Group, *all->root_));
      figure.parts.back()->setName(role + " " + part.name);
      figure.parts.back()->setNodeMask(0);  // until the device reports
    }
    all->addLine(figure);
    all->figures_.push_back(std::move(figure));
  }
  return all;
}

void DeviceFigures::addLine(Figure& figure) {
  figure.line = new osg::Geometry;
  figure.line->setDataVariance(osg::Object::DYNAMIC);
  figure.line->setUseDisplayList(false);
  figure.line->setUseVertexBufferObjects(true);
  solid_lines_->addChild(figure.line);
}

void DeviceFigures::setQuick(bool quick) {
  root_->getOrCreateStateSet()->setAttributeAndModes(quick ? shaders::quickBody(Material::Texture::kNone, false)
                                                           : shaders::body(Material::Texture::kNone));
  for (Figure& figure : figures_) {
    makeShapes(figure, quick);
    color(figure, by_heat_);
  }
}

void DeviceFigures::makeShapes(Figure& figure, bool quick) {
  figure.motors.clear();
  const std::vector<FigurePart>& parts = figure.drawn->parts();
  for (std::size_t i = 0; i < parts.size(); ++i) {
    osg::ref_ptr<osg::Group> shapes = new osg::Group;
    for (const FigureShape& shape : parts[i].shapes) {
      const auto surface = surfaceOf(shape.shape, shape.mesh.get(), shape.color, quick ? kQuickFigure : kFineFigure);
      if (!surface) continue;
      osg::ref_ptr<osg::MatrixTransform> X_PG = new osg::MatrixTransform(toOsg(shape.X_PG));
      X_PG->addChild(surface);
      shapes->addChild(X_PG);
      if (shape.motor < 0) continue;
      surface->setDataVariance(osg::Object::DYNAMIC);
      figure.motors.push_back({shape.motor, shape.color, surface});
    }
    figure.parts[i]->setChild(0, shapes);
  }
}

bool DeviceFigures::has(std::size_t finger) const {
  return std::ranges::find(figures_, finger, &Figure::finger) != figures_.end();
}

/// A frame of the rig as the run tells it, whoever moves it; a tool, or a frame that nobody tells, by the samples.
DeviceFigures::Stand DeviceFigures::standOf(const Figure& figure, const ViewFrame& frame) {
  if (figure.frame == FrameTree::kWorld) return {};
  const auto index = static_cast<std::size_t>(figure.frame);
  if (frame.frames != nullptr && index >= roles_ && index - roles_ < frame.frames->frames.size()) {
    const FrameNow& now = frame.frames->frames[index - roles_];
    return {now.X_WF, now.zoom > 0 ? now.zoom : 1};
  }
  for (std::size_t role = 0; role < frame.device.fingers.size(); ++role) {
    const FingerInput& tool = frame.device.fingers[role];
    frames_->setTool(role, {.X_WF = {tool.p_WH, tool.q_WT}});
  }
  return {frames_->at(figure.frame, frame.time).X_WF};
}

std::optional<FigureMoment> DeviceFigures::momentOf(const Figure& figure, const Stand& stand,
                                                    const ViewFrame& frame) const {
  if (figure.finger >= frame.device.fingers.size()) return std::nullopt;
  const FingerInput& finger = frame.device.fingers[figure.finger];
  if (!finger.valid) return std::nullopt;
  const Quat q_FW = stand.X_WF.q.conjugate();
  FigureMoment moment{.time = frame.time, .p_FH = stand.inverseTimes(finger.p_WH), .oriented = finger.oriented};
  moment.q_FT = q_FW * finger.q_WT;
  if (figure.finger < frame.forces.f_H_W.size()) moment.f_H_F = stand.zoom * (q_FW * frame.forces.f_H_W[figure.finger]);
  return moment;
}

void DeviceFigures::follow(const ViewFrame& frame) {
  for (Figure& figure : figures_)
    if (const auto moment = momentOf(figure, standOf(figure, frame), frame)) figure.drawn->follow(*moment);
}

void DeviceFigures::update(const ViewFrame& frame, const ShownParts& parts) {
  by_heat_ = parts[ShownPart::kHeat];
  setShown(*root_, parts[ShownPart::kDevices]);
  setShown(*lines_, parts[ShownPart::kCompliance]);
  std::vector<Pose> X_FP;
  for (Figure& figure : figures_) {
    color(figure, by_heat_);
    const Stand stand = standOf(figure, frame);
    const auto moment = momentOf(figure, stand, frame);
    if (!moment) continue;
    figure.drawn->place(*moment, X_FP);
    for (std::size_t i = 0; i < figure.parts.size() && i < X_FP.size(); ++i) {
      const Pose X_WP{stand * X_FP[i].p, stand.X_WF.q * X_FP[i].q};
      figure.parts[i]->setMatrix(osg::Matrix::scale(stand.zoom, stand.zoom, stand.zoom) * toOsg(X_WP));
      figure.parts[i]->setNodeMask(~0U);
    }
    figure.deflection = figure.drawn->deflection(*moment, kDeflectionScale);
    if (!figure.deflection || !parts[ShownPart::kCompliance]) continue;
    std::vector<Vec3> line_W;
    for (const Vec3& p_F : figure.deflection->line_F) line_W.push_back(stand * p_F);
    const osg::ref_ptr<osg::Geometry> bar = meshGeometry(barAlong(line_W), kLineColor);
    figure.line->setVertexArray(bar->getVertexArray());
    figure.line->setNormalArray(bar->getNormalArray());
    figure.line->setColorArray(bar->getColorArray());
    figure.line->setPrimitiveSetList(bar->getPrimitiveSetList());
    figure.line->dirtyBound();
  }
}

void DeviceFigures::color(Figure& figure, bool by_heat) {
  const auto heat = by_heat ? figure.drawn->heat() : std::nullopt;
  for (Motor& motor : figure.motors) {
    const auto index = static_cast<std::size_t>(motor.index);
    const Vec3 color = !by_heat ? motor.own_color : heat && index < heat->size() ? heatColor((*heat)[index]) : kUnknown;
    auto* colors = dynamic_cast<osg::Vec4Array*>(motor.shape->getColorArray());
    (*colors)[0] = osg::Vec4(osg::Vec3(toOsg(color)), 1);
    colors->dirty();
  }
}

double DeviceFigures::reachFrom(const Vec3& center) const {
  const osg::BoundingSphere bound = root_->getBound();
  return bound.valid() ? (bound.center() - osg::Vec3(toOsg(center))).length() + bound.radius() : 0;
}

void DeviceFigures::appendAppearance(std::vector<double>& appearance) const {
  if (!by_heat_) return;
  for (const Figure& figure : figures_)
    for (const double heat : figure.drawn->heat().value_or(std::vector<double>{-1}))
      appearance.push_back(std::round(kHeatShades * heat));
}

std::vector<DeviceFigures::Told> DeviceFigures::told() const {
  std::vector<Told> all;
  for (const Figure& figure : figures_)
    all.push_back({figure.role, figure.deflection, figure.drawn->motors(), figure.drawn->heat()});
  return all;
}

}  // namespace presa::view
