#include "modules/view_osg/joint_glyphs.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <osg/BlendFunc>
#include <osg/Depth>

#include "framework/geometry/rotation_between.h"
#include "modules/view_osg/osg_convert.h"
#include "modules/view_osg/shaders.h"

namespace presa::view {
namespace {

const Vec3 kFrameColor(0.30, 0.08, 0.85), kHandColor(0.20, 0.85, 0.08);
// size: share of the body's radius, bounds [m]
constexpr double kOfBody = 0.6, kSmallestGlyph = 0.006, kLargestGlyph = 0.10;
// relative to the size
constexpr double kThick = 0.035, kAxis = 1.2, kDisc = 0.24, kDiscHeight = 0.10, kBall = 0.30, kFixedBlock = 0.36,
                 kStop = 0.45;
constexpr double kPieces = 48;  ///< of a full turn

osg::ref_ptr<osg::MatrixTransform> glyphPart(osg::Group& parent, const osg::Matrixd& place, osg::Node* shape) {
  osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform(place);
  transform->addChild(shape);
  parent.addChild(transform);
  return transform;
}

void addRod(osg::Group& parent, const Vec3& from, const Vec3& to, double radius, const Vec3& color) {
  glyphPart(parent, alongZ(from, to - from, {radius, radius, (to - from).norm()}), unitShaft(color, kQuick));
}

/// Part of a ring about z, of round section, from one angle to another.
osg::ref_ptr<osg::Geometry> arc(double radius, double thick, double from, double to, const Vec3& color) {
  constexpr int kAround = 8;
  const int steps = std::max(1, static_cast<int>(std::ceil(kPieces * (to - from) / (2 * std::numbers::pi))));
  ShadedMesh mesh;
  for (int step = 0; step <= steps; ++step) {
    const double turn = from + (to - from) * step / steps;
    const Vec3 out(std::cos(turn), std::sin(turn), 0);
    for (int i = 0; i < kAround; ++i) {
      const double angle = 2 * std::numbers::pi * i / kAround;
      const Vec3 normal = std::cos(angle) * out + std::sin(angle) * Vec3::UnitZ();
      mesh.positions.emplace_back((radius * out + thick * normal).cast<float>());
      mesh.normals.emplace_back(normal.cast<float>());
      if (step == steps) continue;
      const auto low = static_cast<std::uint32_t>(step * kAround), next = static_cast<std::uint32_t>((i + 1) % kAround);
      const auto here = static_cast<std::uint32_t>(i), high = low + kAround;
      for (const std::uint32_t corner : {low + here, high + here, high + next, low + here, high + next, low + next})
        mesh.indices.push_back(corner);
    }
  }
  return meshGeometry(mesh, color);
}

Vec3 heading(double angle) { return {std::cos(angle), std::sin(angle), 0}; }

osg::ref_ptr<osg::Node> translucentWhereHidden(osg::Group* solid) {
  osg::ref_ptr<osg::Group> ghost = new osg::Group;
  osg::StateSet* state = ghost->getOrCreateStateSet();
  state->addUniform(new osg::Uniform("opacity", 0.55F), osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE);
  state->setAttributeAndModes(new osg::BlendFunc(osg::BlendFunc::SRC_ALPHA, osg::BlendFunc::ONE_MINUS_SRC_ALPHA));
  state->setAttributeAndModes(new osg::Depth(osg::Depth::GREATER, 0, 1, false));
  state->setRenderBinDetails(9, "DepthSortedBin");
  ghost->addChild(solid);
  return ghost;
}

/// Turning frame: z along `axis_J`.
Quat frameOf(const Vec3& axis_J) { return rotationBetween(Vec3::UnitZ(), axis_J); }

}  // namespace

JointGlyphs::JointGlyphs(const Scene& scene, const JointMotion& motion, const BodyNodes& bodies) {
  root_->setName("joints");
  osg::StateSet* state = solid_->getOrCreateStateSet();
  state->setAttributeAndModes(shaders::glyph());
  state->addUniform(new osg::Uniform("opacity", 1.0F));
  root_->addChild(solid_);
  root_->addChild(translucentWhereHidden(solid_));
  for (std::size_t j = 0; j < motion.count(); ++j) {
    const Joint& joint = scene.joints[j];
    Glyph glyph{new osg::MatrixTransform, new osg::MatrixTransform, new osg::MatrixTransform, nullptr, 0};
    double radius = bodies.radius(joint.body);
    if (joint.to != Joint::kWorld && !scene.bodies[joint.to].fixed) radius = std::min(radius, bodies.radius(joint.to));
    glyph.size = std::clamp(kOfBody * radius, kSmallestGlyph, kLargestGlyph);
    for (osg::MatrixTransform* place : {glyph.X_WA.get(), glyph.X_WB.get(), glyph.slid.get()}) {
      place->setDataVariance(osg::Object::DYNAMIC);
      solid_->addChild(place);
    }
    const double s = glyph.size;
    switch (joint.type) {
      case JointType::kFixed:
        glyph.X_WB->addChild(boxGeometry(Vec3::Constant(kFixedBlock * s), kFrameColor));
        break;
      case JointType::kBall:
        glyph.X_WB->addChild(sphereGeometry(kBall * s, kFrameColor, kQuick));
        break;
      case JointType::kHinge:
        addTurning(joint, 0, motion.frames(j).X_BJ, glyph);
        break;
      case JointType::kSlider:
        addSliding(joint.axes[0], glyph);
        break;
      case JointType::kUniversal: {
        const Vec3 second = kAxis * s * secondAxis(joint) / 2, first = kAxis * s * Vec3::UnitZ() / 2;
        addRod(*glyph.X_WA, -first, first, 2 * kThick * s, kFrameColor);
        addRod(*glyph.X_WB, -second, second, 2 * kThick * s, kHandColor);
        break;
      }
      case JointType::kPrismaticRotary:
        addSliding(joint.axes[0], glyph);
        addTurning(joint, 1, motion.frames(j).X_BJ, glyph);
        break;
    }
    glyphs_.push_back(glyph);
  }
}

// The hand points from the axis to the middle of the body, so that the arc lies where the body moves.
void JointGlyphs::addTurning(const Joint& joint, std::size_t axis, const Pose& X_BJ, Glyph& glyph) {
  const double s = glyph.size, thick = kThick * s;
  const Quat turned = frameOf(axis == 0 ? Vec3::UnitZ() : secondAxis(joint));
  const Vec3 middle = turned.conjugate() * X_BJ.inverse().p;
  const double zero = std::hypot(middle.x(), middle.y()) > 1e-6 ? std::atan2(middle.y(), middle.x()) : 0;
  osg::ref_ptr<osg::MatrixTransform> fixed = new osg::MatrixTransform(toOsg(Pose{Vec3::Zero(), turned}));
  osg::ref_ptr<osg::MatrixTransform> moving = new osg::MatrixTransform(fixed->getMatrix());
  glyph.slid->addChild(fixed);
  glyph.X_WB->addChild(moving);
  addRod(*fixed, -kAxis * s / 2 * Vec3::UnitZ(), kAxis * s / 2 * Vec3::UnitZ(), 1.5 * thick, kFrameColor);
  fixed->addChild(cylinderGeometry(kDisc * s, kDiscHeight * s, kFrameColor, kQuick));
  addRod(*moving, Vec3::Zero(), s * heading(zero), thick, kHandColor);
  glyphPart(*moving, toOsg(Pose{s * heading(zero), Quat::Identity()}), sphereGeometry(2.2 * thick, kHandColor, kQuick));
  const JointAxis& range = joint.axes[axis];
  if (!range.lower && !range.upper) return;
  const double open = std::numbers::pi / 6;  // drawn beyond the start where there is no stop
  const double from = zero + range.lower.value_or(-open), to = zero + range.upper.value_or(open);
  fixed->addChild(arc(s, thick, from, to, kFrameColor));
  for (const auto& [stop, angle] : {std::pair{range.lower, from}, {range.upper, to}})
    if (stop)
      addRod(*fixed, (1 - kStop / 2) * s * heading(angle), (1 + kStop / 2) * s * heading(angle), 1.5 * thick,
             kFrameColor);
}

void JointGlyphs::addSliding(const JointAxis& axis, Glyph& glyph) {
  const double s = glyph.size, thick = kThick * s;
  glyph.travel = glyphPart(*glyph.X_WA, osg::Matrixd::identity(), unitShaft(kFrameColor, kQuick));
  glyph.travel->setDataVariance(osg::Object::DYNAMIC);
  for (const std::optional<double>& stop : {axis.lower, axis.upper})
    if (stop)
      glyphPart(*glyph.X_WA, toOsg(Pose{*stop * Vec3::UnitZ(), Quat::Identity()}),
                boxGeometry({kStop * s, kStop * s, 2 * thick}, kFrameColor));
  glyph.X_WB->addChild(cylinderGeometry(kDisc * s, 3 * thick, kHandColor, kQuick));
}

void JointGlyphs::update(const JointMotion& motion, const std::vector<Pose>& X_WB) {
  for (std::size_t j = 0; j < glyphs_.size(); ++j) {
    const Joint& joint = motion.joint(j);
    Glyph& glyph = glyphs_[j];
    const Pose X_WA = joint.to == Joint::kWorld ? Pose{} : X_WB[joint.to];
    const Pose X_WJ = X_WA * motion.frames(j).X_AJ;
    const Vec3 slid(0, 0, joint.type == JointType::kPrismaticRotary ? motion.position(j, 0) : 0);
    glyph.X_WA->setMatrix(toOsg(X_WJ));
    glyph.slid->setMatrix(toOsg(X_WJ * Pose{slid, Quat::Identity()}));
    glyph.X_WB->setMatrix(toOsg(X_WB[joint.body] * motion.frames(j).X_BJ));
    if (!glyph.travel) continue;
    const double at = motion.position(j, 0), s = glyph.size, thick = kThick * s;
    const double low = joint.axes[0].lower.value_or(std::min(0.0, at) - s);
    const double high = joint.axes[0].upper.value_or(std::max(0.0, at) + s);
    glyph.travel->setMatrix(alongZ(low * Vec3::UnitZ(), Vec3::UnitZ(), {thick, thick, high - low}));
  }
}

}  // namespace presa::view
