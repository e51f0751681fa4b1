#include "modules/view_osg/felt_relief.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "framework/geometry/closest_point.h"
#include "framework/geometry/tangent_frame.h"
#include "framework/haptics/surface_effects.h"
#include "modules/view_osg/osg_convert.h"
#include "modules/view_osg/shaders.h"

namespace presa::view {
namespace {

constexpr double kCell = 1.5e-4;        // [m]
constexpr int kBlock = 4;               // cells: a block is drawn whole, or not where the face has ended
constexpr double kPatchRadius = 0.015;  // radius of a patch [m]
constexpr double kReliefLift = 2e-4;    // distance from the face, against flicker [m]
constexpr double kOnFace = 2e-5;        // a point this near to the surface is on it [m]
constexpr double kFaceWithin = 2e-3;    // the touched face is this near to the touched point: textures press it in [m]
const Vec3 kHollow(0.02, 0.05, 0.16), kCrest(1.0, 0.86, 0.55);

struct FlatSide {
  Vec3 nhat_B, p_B;  // unit normal; a point of the face, nearest to what was asked
};

/// The nearest flat side of the body within `reach` of p_B.
std::optional<FlatSide> faceNear(const Geometry& haptic, const MeshTree* tree, const Vec3& p_B, double reach) {
  const Vec3 p_G = haptic.X_BG.inverseTimes(p_B);
  Vec3 nhat_G = Vec3::Zero(), at_G = p_G;
  double nearest = reach;
  if (const auto* box = std::get_if<Box>(&haptic.shape)) {
    const Vec3 half = box->size / 2, inside = p_G.cwiseMax(-half).cwiseMin(half);
    if ((p_G - inside).norm() > reach) return std::nullopt;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const double side = inside[axis] < 0 ? -1 : 1, away = std::abs(side * half[axis] - p_G[axis]);
      if (away > nearest) continue;
      nearest = away;
      nhat_G = side * Vec3::Unit(axis);
      at_G = inside;
      at_G[axis] = side * half[axis];
    }
  } else if (tree != nullptr) {
    tree->forEachWithin(p_G, reach, [&](std::int32_t f) {
      const MeshTree::Facet& facet = tree->facet(f);
      const Vec3 &a = tree->corner(facet, 0), &b = tree->corner(facet, 1), &c = tree->corner(facet, 2);
      const Vec3 closest = closestOnTriangle(p_G, a, b, c);
      if ((p_G - closest).norm() > nearest) return;
      nearest = (p_G - closest).norm();
      nhat_G = (b - a).cross(c - a).normalized();
      at_G = closest;
    });
  }
  if (nhat_G.isZero()) return std::nullopt;
  return FlatSide{haptic.X_BG.q * nhat_G, haptic.X_BG * at_G};
}

}  // namespace

/// Corners and triangles of all patches, for one drawing call.
struct FeltRelief::Patch {
  osg::ref_ptr<osg::Vec3Array> corners = new osg::Vec3Array, normals = new osg::Vec3Array(osg::Array::BIND_PER_VERTEX);
  osg::ref_ptr<osg::Vec4Array> colors = new osg::Vec4Array(osg::Array::BIND_PER_VERTEX);
  std::vector<double> heights;  // of the corners [m]
  osg::ref_ptr<osg::DrawElementsUInt> triangles = new osg::DrawElementsUInt(GL_TRIANGLES);

  void color() {
    if (heights.empty()) return;
    const auto [low, high] = std::ranges::minmax(heights);
    for (const double height : heights) {
      const double share = high > low ? (height - low) / (high - low) : 1;
      colors->push_back(osg::Vec4(toOsg(Vec3(kHollow + share * (kCrest - kHollow))), 1.0F));
    }
  }
};

FeltRelief::FeltRelief(const World& world) : world_(world) {
  surface_->setName("texture");
  surface_->setDataVariance(osg::Object::DYNAMIC);
  surface_->setUseDisplayList(false);
  surface_->setUseVertexBufferObjects(true);
  osg::StateSet* state = surface_->getOrCreateStateSet();
  state->setAttributeAndModes(shaders::glyph());
  state->addUniform(new osg::Uniform("opacity", 1.0F));
  surface_->setNodeMask(0);
}

void FeltRelief::load() {
  loaded_ = true;
  for (const PluginElement& element : surfaceEffectsOf(world_.scene)) {
    auto effect = makeSurfaceEffect(element, world_);
    if (const auto* height = dynamic_cast<const FeltHeight*>(effect.get()))
      felt_.push_back({element.body, std::move(effect), height});
  }
}

double FeltRelief::heightOn(std::int32_t body, const Vec3& p_T, const Pose& X_BT) const {
  double sum = 0;
  for (const Felt& felt : felt_) sum += felt.body == body ? felt.height->heightAt(p_T, X_BT) : 0;
  return sum;
}

void FeltRelief::add(Patch& patch, const FingerContact& finger, const Pose& X_WB) const {
  const auto body = static_cast<std::size_t>(finger.body);
  const Geometry& haptic = *world_.scene.bodies[body].haptic;
  const MeshTree* tree = body < world_.meshes.size() ? world_.meshes[body].haptic_tree.get() : nullptr;
  const std::optional<FlatSide> face = faceNear(haptic, tree, finger.p_BC, kFaceWithin);
  if (!face) return;
  const Pose X_BT = tangentFrame(face->nhat_B, face->p_B), X_WT = X_WB * X_BT;
  const osg::Vec3 normal = toOsg(Vec3(X_WT.q * Vec3::UnitZ()));
  const Vec3 middle_T = X_BT.inverseTimes(face->p_B);
  constexpr double kWide = kBlock * kCell;
  const auto first = [](double at) { return static_cast<int>(std::floor((at - kPatchRadius) / kWide)); };
  const auto corner = [&](int ix, int iy) {
    const Vec3 p_T(ix * kCell, iy * kCell, 0);
    patch.corners->push_back(toOsg(X_WT * Vec3(p_T.x(), p_T.y(), kReliefLift)));
    patch.normals->push_back(normal);
    patch.heights.push_back(heightOn(finger.body, p_T, X_BT));
  };
  const int blocks = static_cast<int>(std::ceil(2 * kPatchRadius / kWide));
  for (int bx = first(middle_T.x()); bx <= first(middle_T.x()) + blocks; ++bx) {
    for (int by = first(middle_T.y()); by <= first(middle_T.y()) + blocks; ++by) {
      const Vec3 p_T((bx + 0.5) * kWide, (by + 0.5) * kWide, 0);
      if ((p_T - middle_T).norm() > kPatchRadius || !faceNear(haptic, tree, X_BT * p_T, kOnFace)) continue;
      const auto base = static_cast<unsigned>(patch.corners->size());
      for (int i = 0; i <= kBlock; ++i)
        for (int j = 0; j <= kBlock; ++j) corner(bx * kBlock + i, by * kBlock + j);
      for (unsigned i = 0; i < kBlock; ++i) {
        for (unsigned j = 0; j < kBlock; ++j) {
          const unsigned a = base + i * (kBlock + 1) + j, b = a + kBlock + 1;
          for (const unsigned index : {a, b, b + 1, a, b + 1, a + 1}) patch.triangles->push_back(index);
        }
      }
    }
  }
}

void FeltRelief::update(bool shown, const ContactExchange& contacts, const std::vector<Pose>& X_WB) {
  if (shown && !loaded_) load();
  shown = shown && !felt_.empty();
  surface_->setNodeMask(shown ? ~0U : 0U);
  if (!shown) return;
  Patch patch;
  for (const FingerContact& finger : contacts.fingers) {
    if (finger.mode == ContactMode::kNone || finger.body < 0) continue;
    const auto body = static_cast<std::size_t>(finger.body);
    const bool felt = std::ranges::any_of(felt_, [&](const Felt& of) { return of.body == finger.body; });
    if (felt && body < X_WB.size()) add(patch, finger, X_WB[body]);
  }
  patch.color();
  surface_->setVertexArray(patch.corners);
  surface_->setNormalArray(patch.normals);
  surface_->setColorArray(patch.colors);
  surface_->removePrimitiveSet(0, surface_->getNumPrimitiveSets());
  surface_->addPrimitiveSet(patch.triangles);
  surface_->dirtyBound();
}

}  // namespace presa::view
