#include "modules/view_osg/field_slice.h"

#include <algorithm>
#include <cmath>
#include <osg/BlendFunc>
#include <osg/Depth>
#include <osg/LineWidth>
#include <osg/Texture2D>

#include "framework/haptics/renderers.h"
#include "modules/view_osg/hud_widgets.h"
#include "modules/view_osg/osg_convert.h"
#include "modules/view_osg/placed_nodes.h"
#include "modules/view_osg/scale_bar.h"
#include "modules/view_osg/shaders.h"

namespace presa::view {
namespace {

constexpr float kSheetOpacity = 0.86F, kOutlineWidth = 5;
constexpr double kRangeShare = 0.35, kLines = 5;  // of the tool's radius; lines on one side of zero
constexpr int kPalette = 256;
constexpr float kFieldLeft = 20, kFieldBottom = 92, kFieldWidth = 186, kFieldHeight = 70, kColors = 12;
// display colours, told apart by the colour-blind, too
const Vec3 kSurface(0.97, 0.97, 0.95), kInside(0.80, 0.33, 0.0), kOutside(0.05, 0.27, 0.58);
const osg::Vec4 kOutlineColor(0.0F, 0.62F, 0.30F, 1);

/// At `share` of the scale, -1 to 1.
Vec3 colorAt(double share) {
  const double far = std::pow(std::min(1.0, std::abs(share)), 0.7);
  return kSurface + far * ((share < 0 ? kInside : kOutside) - kSurface);
}

/// Over whatever lies in front, which would hide it.
void putOver(osg::StateSet& state, int bin) {
  state.setAttributeAndModes(new osg::BlendFunc(osg::BlendFunc::SRC_ALPHA, osg::BlendFunc::ONE_MINUS_SRC_ALPHA));
  state.setAttributeAndModes(new osg::Depth(osg::Depth::ALWAYS, 0, 1, false));
  state.setRenderBinDetails(bin, "RenderBin");
}

osg::ref_ptr<osg::Texture2D> textureOf(osg::Image& image) {
  osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(&image);
  texture->setResizeNonPowerOfTwoHint(false);
  for (const auto side : {osg::Texture::WRAP_S, osg::Texture::WRAP_T})
    texture->setWrap(side, osg::Texture::CLAMP_TO_EDGE);
  for (const auto use : {osg::Texture::MIN_FILTER, osg::Texture::MAG_FILTER})
    texture->setFilter(use, osg::Texture::LINEAR);
  return texture;
}

osg::ref_ptr<osg::Image> palette() {
  osg::ref_ptr<osg::Image> image = new osg::Image;
  image->allocateImage(kPalette, 1, 1, GL_RGB, GL_UNSIGNED_BYTE);
  for (int i = 0; i < kPalette; ++i) {
    const Vec3 color = colorAt(2.0 * i / (kPalette - 1) - 1);
    for (int c = 0; c < 3; ++c) image->data(i)[c] = static_cast<unsigned char>(std::lround(255 * color[c]));
  }
  return image;
}

void makeDynamic(osg::Geometry& geometry) {
  geometry.setDataVariance(osg::Object::DYNAMIC);
  geometry.setUseDisplayList(false);
  geometry.setUseVertexBufferObjects(true);
}

/// About the body's origin [m].
double radiusAround(const Body& body, const TriMesh* haptic) {
  if (!body.haptic) return 0;
  return body.haptic->X_BG.p.norm() + (haptic != nullptr ? radiusOf(*haptic) : boundingRadius(body.haptic->shape));
}

}  // namespace

void FieldSlice::load() {
  loaded_ = true;
  if (!world_.scene.hasTools()) return;
  fields_ = toolFieldsOf(world_);
  if (fields_.empty()) return;
  for (std::size_t b = 0; b < world_.scene.bodies.size(); ++b)
    radius_.push_back(radiusAround(world_.scene.bodies[b], world_.meshes[b].haptic.get()));
  for (std::size_t d = 0; d < world_.tools.size(); ++d) {
    if (!world_.tools[d]) continue;
    slices_.emplace_back();
    slices_.back().tool = d;
    slices_.back().box_T = boundsOf(*world_.tools[d]);
  }
  chooseScale();
  for (Slice& slice : slices_) makeSheet(slice);
  addScale();
}

// One scale for all: of the smallest tool, and coarser than voxels, between which the field is straight.
void FieldSlice::chooseScale() {
  double radius = 1e9, voxel = 0;
  for (const Slice& slice : slices_) radius = std::min(radius, (slice.box_T.high - slice.box_T.low).norm() / 2);
  for (const ToolField& field : fields_) voxel = std::max(voxel, field.voxel);
  step_ = std::max(roundLength(kRangeShare * radius / kLines), roundLength(2.5 * voxel));
  range_ = kLines * step_;
}

void FieldSlice::makeSheet(Slice& slice) const {
  slice.place = placed(slice.sheet, space_);
  slice.place->addChild(slice.outline);
  slice.values->setDataVariance(osg::Object::DYNAMIC);
  makeDynamic(*slice.sheet);
  makeDynamic(*slice.outline);
  osg::StateSet* state = slice.sheet->getOrCreateStateSet();
  state->setAttributeAndModes(shaders::slice());
  state->setTextureAttributeAndModes(0, textureOf(*slice.values));
  state->setTextureAttributeAndModes(1, textureOf(*palette()));
  state->addUniform(new osg::Uniform("distances", 0));
  state->addUniform(new osg::Uniform("palette", 1));
  state->addUniform(new osg::Uniform("range", static_cast<float>(range_)));
  state->addUniform(new osg::Uniform("step", static_cast<float>(step_)));
  state->addUniform(new osg::Uniform("opacity", kSheetOpacity));
  putOver(*state, 11);
  state = slice.outline->getOrCreateStateSet();
  state->setAttributeAndModes(shaders::line());
  state->setAttributeAndModes(new osg::LineWidth(kOutlineWidth));
  state->addUniform(new osg::Uniform("line_color", kOutlineColor));
  putOver(*state, 12);
}

void FieldSlice::show(bool shown, const ViewFrame& frame, const std::vector<FingerView>& fingers) {
  if (shown && !loaded_) load();
  shown_ = shown && !slices_.empty();
  if (scale_) setShown(*scale_, shown_);
  for (Slice& slice : slices_) {
    const FingerView* finger = slice.tool < fingers.size() ? &fingers[slice.tool] : nullptr;
    slice.alive = shown_ && finger != nullptr && finger->valid;
    setShown(*slice.place, slice.alive && eye_);
    if (slice.alive) slice.X_WT = finger->X_WT;
  }
  if (!shown_) return;
  X_WB_ = frame.X_WB;
  if (!eye_) return;
  for (Slice& slice : slices_) draw(slice);
}

// The pictures of a run in lockstep come long after each other: what show() drew for the last camera is not yet right.
void FieldSlice::seenFrom(const CameraPose& pose) {
  const bool same = eye_ && *eye_ == pose.eye;
  eye_ = pose.eye;
  if (same || !shown_) return;
  for (Slice& slice : slices_) {
    setShown(*slice.place, slice.alive);
    draw(slice);
  }
}

void FieldSlice::draw(Slice& slice) const {
  if (!slice.alive) return;
  const SlicePlane plane = planeThrough(slice.box_T, slice.X_WT, *eye_);
  const SliceGrid grid = distancesOn(plane, fields_, X_WB_, radius_, range_);
  slice.place->setMatrix(toOsg(plane.X_WS));
  if (slice.values->s() != grid.columns || slice.values->t() != grid.rows) {
    slice.values->allocateImage(grid.columns, grid.rows, 1, GL_RED, GL_FLOAT);
    slice.values->setInternalTextureFormat(GL_R32F);
  }
  std::ranges::copy(grid.values, reinterpret_cast<float*>(slice.values->data()));
  slice.values->dirty();

  osg::ref_ptr<osg::Vec3Array> corners = new osg::Vec3Array;
  osg::ref_ptr<osg::Vec2Array> texels = new osg::Vec2Array;
  const float edge_x = 0.5F / static_cast<float>(grid.columns), edge_y = 0.5F / static_cast<float>(grid.rows);
  for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    corners->push_back(toOsg(Vec3(x * plane.half_x, y * plane.half_y, 0)));
    texels->push_back({x < 0 ? edge_x : 1 - edge_x, y < 0 ? edge_y : 1 - edge_y});
  }
  slice.sheet->setVertexArray(corners);
  slice.sheet->setTexCoordArray(0, texels);
  if (slice.sheet->getNumPrimitiveSets() == 0) slice.sheet->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLE_FAN, 0, 4));
  slice.sheet->dirtyBound();

  osg::ref_ptr<osg::Vec3Array> ends = new osg::Vec3Array;
  for (const Vec3& end : outlineOn(plane, *world_.tools[slice.tool], slice.X_WT)) ends->push_back(toOsg(end));
  slice.outline->setVertexArray(ends);
  slice.outline->removePrimitiveSet(0, slice.outline->getNumPrimitiveSets());
  slice.outline->addPrimitiveSet(new osg::DrawArrays(GL_LINES, 0, static_cast<int>(ends->size())));
  slice.outline->dirtyBound();
}

void FieldSlice::addScale() {
  scale_ = new osg::Group;
  left_.addChild(scale_);
  scale_->addChild(roundedPanel({kFieldLeft, kFieldBottom, kFieldWidth, kFieldHeight}, 8, ink_.panel));
  const float left = kFieldLeft + kSideInset, width = kFieldWidth - 2 * kSideInset, bar = kFieldBottom + 28;
  constexpr int kSteps = 40;
  for (int i = 0; i < kSteps; ++i) {
    const float x = left + width * static_cast<float>(i) / kSteps,
                next = left + width * static_cast<float>(i + 1) / kSteps;
    const Vec3 color = colorAt((2.0 * i + 1) / kSteps - 1);
    scale_->addChild(
        polygon({{x, bar}, {next, bar}, {next, bar + kColors}, {x, bar + kColors}}, osg::Vec4(toOsg(color), 1)));
  }
  const float middle = left + width / 2;
  scale_->addChild(polygon({{middle - 1.5F, bar - 2},
                            {middle + 1.5F, bar - 2},
                            {middle + 1.5F, bar + kColors + 2},
                            {middle - 1.5F, bar + kColors + 2}},
                           {0, 0, 0, 1}));
  const auto words = [&](float x, float y, float size, const osg::Vec4& color, Label::Align align,
                         const std::string& text) {
    Label(*scale_, x, y, size, color, Typeface::kRegular, align).set(text);
  };
  words(left, bar + kColors + 9, 14, ink_.text, Label::Align::kLeft,
        printed("distance, lines of %.3g mm", 1e3 * step_));
  words(left, kFieldBottom + 10, 13, ink_.text, Label::Align::kLeft, printed("\xe2\x88\x92%.3g", 1e3 * range_));
  words(middle, kFieldBottom + 10, 13, ink_.text, Label::Align::kCenter, "0");
  words(left + width, kFieldBottom + 10, 13, ink_.text, Label::Align::kRight, printed("%.3g mm", 1e3 * range_));
}

void FieldSlice::appendAppearance(std::vector<double>& appearance) const {
  for (const Slice& slice : slices_) {
    if (!slice.alive || !eye_) continue;
    const Pose& X_WT = slice.X_WT;
    for (const double value :
         {X_WT.p.x(), X_WT.p.y(), X_WT.p.z(), X_WT.q.x(), X_WT.q.y(), X_WT.q.z(), eye_->x(), eye_->y(), eye_->z()})
      appearance.push_back(value);
  }
}

}  // namespace presa::view
