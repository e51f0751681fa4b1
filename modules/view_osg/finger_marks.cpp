#include "modules/view_osg/finger_marks.h"

#include <algorithm>
#include <cmath>
#include <osg/BlendFunc>
#include <osg/Depth>

#include "framework/geometry/closest_point.h"
#include "modules/view_osg/geometry_nodes.h"
#include "modules/view_osg/osg_convert.h"
#include "modules/view_osg/placed_nodes.h"
#include "modules/view_osg/shaders.h"

namespace presa::view {
namespace {

const Vec3 kThumb(1.0, 0.36, 0.05), kIndex(0.05, 0.42, 1.0);  // told apart by everybody
const Vec3 kLine(1, 1, 1), kSpot(0.02, 0.02, 0.02), kGlow(1.0, 0.80, 0.15);
constexpr double kLineRadius = 0.0007, kSpotThick = 0.0004, kGlowRadius = 0.009, kGlowThick = 0.0012;  // [m]
constexpr double kFingerLength = 0.05, kFingerThick = 0.8;  // length [m], radius in radii of the fingertip
constexpr double kHandAbove = 0.13;                         // where both fingers point, above their middle [m]
const Vec3 kDown(1e-6, 1.4e-6, -1);                         // along no axis of a box
constexpr double kFloats = 0.0006;                          // of marks over the surface below them [m]

void addOpacity(osg::Node& node, float opacity) {
  node.getOrCreateStateSet()->addUniform(new osg::Uniform("opacity", opacity));
}

/// Where a vertical line down from p first meets a box, above its bottom; none beside it or below its top.
std::optional<double> topBelow(const Box& box, const Pose& X_WG, const Vec3& p_W) {
  const Vec3 p = X_WG.inverseTimes(p_W), d = X_WG.q.conjugate() * kDown;
  double from = 0, to = 1e9;
  for (int axis = 0; axis < 3; ++axis) {
    const double half = box.size[axis] / 2;
    if (std::abs(d[axis]) < 1e-12) {
      if (std::abs(p[axis]) > half) return std::nullopt;
      continue;
    }
    const double a = (-half - p[axis]) / d[axis], b = (half - p[axis]) / d[axis];
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
  }
  return from > 0 && from <= to ? std::optional(p_W.z() - from) : std::nullopt;
}

}  // namespace

Surroundings::Surroundings(const World& world) : world_(world) {
  for (const BodyMeshes& meshes : world.meshes)
    trees_.push_back(meshes.haptic ? std::make_unique<SurfaceTree>(*meshes.haptic) : nullptr);
}

std::optional<double> Surroundings::below(const Vec3& p_W, const std::vector<Pose>& X_WB) const {
  constexpr double kDeep = 10;  // [m]
  std::optional<double> highest;
  for (std::size_t i = 0; i < trees_.size(); ++i) {
    const std::optional<Geometry>& haptic = world_.scene.bodies[i].haptic;
    if (!haptic) continue;
    const Pose X_WG = X_WB[i] * haptic->X_BG;
    std::optional<double> z;
    if (trees_[i]) {
      const double way = trees_[i]->firstHit(X_WG.inverseTimes(p_W), X_WG.q.conjugate() * kDown, kDeep);
      if (way < kDeep) z = p_W.z() - way;
    } else if (const Box* box = std::get_if<Box>(&haptic->shape)) {
      z = topBelow(*box, X_WG, p_W);
    }
    if (z && (!highest || *z > *highest)) highest = z;
  }
  return highest;
}

std::optional<Surroundings::Near> Surroundings::nearest(const Vec3& p_W, double reach,
                                                        const std::vector<Pose>& X_WB) const {
  std::optional<Near> found;
  for (std::size_t i = 0; i < trees_.size(); ++i) {
    const MeshTree* tree = world_.meshes[i].haptic_tree.get();
    if (tree == nullptr || world_.scene.bodies[i].fixed) continue;
    const Pose X_WG = X_WB[i] * world_.scene.bodies[i].haptic->X_BG;
    const Vec3 p = X_WG.inverseTimes(p_W);
    tree->forEachWithin(p, reach, [&](std::int32_t f) {
      const MeshTree::Facet& facet = tree->facet(f);
      const Vec3 q = closestOnTriangle(p, tree->corner(facet, 0), tree->corner(facet, 1), tree->corner(facet, 2));
      const double distance = (p - q).norm();
      if (distance >= reach || distance < 1e-9) return;
      reach = distance;
      found = Near{X_WG * q, X_WG.q * ((p - q) / distance), distance};
    });
  }
  return found;
}

FingerMarks::FingerMarks(const World& world, std::size_t fingers) : around_(world) {
  root_->setName("finger marks");
  osg::StateSet* state = root_->getOrCreateStateSet();
  state->setAttributeAndModes(shaders::glyph());
  addOpacity(*solid_, 1);
  osg::StateSet* faint = faint_->getOrCreateStateSet();
  faint->setAttributeAndModes(new osg::BlendFunc(osg::BlendFunc::SRC_ALPHA, osg::BlendFunc::ONE_MINUS_SRC_ALPHA));
  faint->setAttributeAndModes(new osg::Depth(osg::Depth::LEQUAL, 0, 1, false));
  faint->setRenderBinDetails(9, "DepthSortedBin");
  root_->addChild(solid_);
  root_->addChild(faint_);
  for (std::size_t i = 0; i < fingers; ++i) marks_.push_back(make(i));
}

FingerMarks::Marks FingerMarks::make(std::size_t finger) {
  const Vec3& color = finger == 0 ? kThumb : kIndex;
  Marks marks;
  marks.tip = placed(sphereGeometry(1, color), *solid_);
  marks.finger = placed(unitShaft(color), *solid_);
  marks.end = placed(sphereGeometry(1, color), *solid_);
  marks.line = placed(unitShaft(kLine), *faint_);
  marks.spot = placed(unitShaft(kSpot), *faint_);
  marks.ring = placed(unitShaft(color), *faint_);
  marks.glow = placed(unitShaft(kGlow), *faint_);
  addOpacity(*marks.line, 0.75F);
  addOpacity(*marks.spot, 0.55F);
  addOpacity(*marks.ring, 0.9F);
  marks.glow_opacity = new osg::Uniform("opacity", 0.0F);
  marks.glow->getOrCreateStateSet()->addUniform(marks.glow_opacity);
  return marks;
}

void FingerMarks::follow(const FingerView& view, const Vec3& towards_W, const std::vector<Pose>& X_WB, Marks& marks) {
  const double r = view.radius;
  marks.tip->setMatrix(osg::Matrixd::scale(r, r, r) * osg::Matrixd::translate(toOsg(view.p_WP)));
  marks.finger->setMatrix(
      alongZ(view.p_WP, towards_W - view.p_WP, {kFingerThick * r, kFingerThick * r, kFingerLength}));
  const Vec3 end = view.p_WP + kFingerLength * (towards_W - view.p_WP).normalized();
  marks.end->setMatrix(osg::Matrixd::scale(kFingerThick * r, kFingerThick * r, kFingerThick * r) *
                       osg::Matrixd::translate(toOsg(end)));
  const std::optional<double> ground = around_.below(view.p_WP, X_WB);
  const double high = ground ? view.p_WP.z() - r - *ground : 0;
  setShown(*marks.line, high > 0.002);
  setShown(*marks.spot, ground.has_value());
  setShown(*marks.ring, ground.has_value());
  if (ground) {
    const Vec3 at(view.p_WP.x(), view.p_WP.y(), *ground + kFloats);
    if (high > 0.002) marks.line->setMatrix(alongZ(at, Vec3::UnitZ(), {kLineRadius, kLineRadius, high}));
    marks.spot->setMatrix(alongZ(at, Vec3::UnitZ(), {r, r, kSpotThick}));
    marks.ring->setMatrix(alongZ(at, Vec3::UnitZ(), {0.3 * r, 0.3 * r, 2 * kSpotThick}));
  }
  const auto near = around_.nearest(view.p_WP, r + kGlowReach, X_WB);
  setShown(*marks.glow, near.has_value());
  if (!near) return;
  const double gap = std::max(0.0, near->distance - r);
  const double size = kGlowRadius * (0.5 + 0.5 * (1 - gap / kGlowReach));
  marks.glow->setMatrix(alongZ(near->p_W - kGlowThick / 2 * near->nhat_W, near->nhat_W, {size, size, kGlowThick}));
  marks.glow_opacity->set(static_cast<float>(0.15 + 0.8 * (1 - gap / kGlowReach)));
}

void FingerMarks::update(const std::vector<FingerView>& fingers, const std::vector<Pose>& X_WB) {
  Vec3 middle = Vec3::Zero();
  int valid = 0;
  for (const FingerView& finger : fingers) {
    if (!finger.valid) continue;
    middle += finger.p_WP;
    ++valid;
  }
  if (valid > 0) middle /= valid;
  for (std::size_t i = 0; i < marks_.size(); ++i) {
    const bool is = i < fingers.size() && fingers[i].valid;
    for (osg::Node* node : {marks_[i].tip.get(), marks_[i].finger.get(), marks_[i].end.get(), marks_[i].line.get(),
                            marks_[i].spot.get(), marks_[i].ring.get(), marks_[i].glow.get()})
      setShown(*node, is);
    if (is) follow(fingers[i], middle + kHandAbove * Vec3::UnitZ(), X_WB, marks_[i]);
  }
}

}  // namespace presa::view
