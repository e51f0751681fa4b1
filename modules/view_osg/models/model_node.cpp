#include "modules/view_osg/models/model_node.h"

#include <algorithm>
#include <array>
#include <map>
#include <mutex>
#include <numbers>
#include <osg/Geometry>
#include <osg/LOD>
#include <osg/observer_ptr>

#include "framework/geometry/srgb.h"
#include "modules/view_osg/models/model_images.h"
#include "modules/view_osg/models/model_levels.h"
#include "modules/view_osg/models/model_surface.h"
#include "modules/view_osg/models/model_textures.h"
#include "modules/view_osg/shaders.h"

namespace presa::view {
namespace {

constexpr double kModelCrease = 40 * std::numbers::pi / 180;         // as scene_nodes
constexpr double kFinePixels = 0.5, kQuickPixels = 1.5;              // max error of a level in the picture
constexpr double kQuickError = 0.0002;                               // finer levels are not drawn by software [m]
constexpr unsigned kColorUnit = 4, kNormalUnit = 5, kRoughUnit = 6;  // lighting and grain have 0 to 3
constexpr double kDarkest = 0.02;                                    // of a mean by which a map is divided

/// The arrays of a model, its levels and its states, kept while a node has them as its user data.
class ModelShapes : public osg::Referenced {
 public:
  explicit ModelShapes(std::shared_ptr<const Model> model) : model_(std::move(model)) {
    const ModelSurface surface = modelSurface(*model_, kModelCrease);
    parts_ = surface.parts;
    fillArrays(surface);
    for (const ModelLevel& level : levelsOf(surface)) addLevel(level);
  }

  osg::ref_ptr<osg::LOD> node(bool quick);

 private:
  using States = std::vector<osg::ref_ptr<osg::StateSet>>;  // by part

  struct Level {
    std::vector<osg::ref_ptr<osg::Geometry>> geometries;  // by part; null: none of its triangles is left
    double error;
  };

  void fillArrays(const ModelSurface& surface);
  void addLevel(const ModelLevel& level);
  const States& states(bool quick);
  osg::ref_ptr<osg::StateSet> stateOf(const ModelMaterial& material, bool quick) const;

  const std::shared_ptr<const Model> model_;
  std::vector<Model::Part> parts_;
  osg::ref_ptr<osg::Vec3Array> places_ = new osg::Vec3Array, normals_ = new osg::Vec3Array;
  osg::ref_ptr<osg::Vec4Array> colors_ = new osg::Vec4Array, tangents_;
  osg::ref_ptr<osg::Vec2Array> at_;
  std::vector<Level> levels_;
  std::array<States, 2> states_;  // fine and quick
};

void ModelShapes::fillArrays(const ModelSurface& surface) {
  const bool mapped = !model_->textures.empty();
  if (mapped) at_ = new osg::Vec2Array;
  for (const Model::Part& part : surface.parts) {
    const Vec3& factor = part.material.color;
    for (std::uint32_t v = part.first_vertex; v < part.first_vertex + part.vertex_count; ++v) {
      const ModelVertex& vertex = surface.vertices[v];
      places_->push_back({vertex.position[0], vertex.position[1], vertex.position[2]});
      normals_->push_back({vertex.normal[0], vertex.normal[1], vertex.normal[2]});
      const auto color = [&](int i) {
        return vertex.color[static_cast<std::size_t>(i)] * static_cast<float>(factor[i]);
      };
      colors_->push_back({color(0), color(1), color(2), 1});
      if (mapped) at_->push_back({vertex.at[0], vertex.at[1]});
    }
  }
  if (surface.tangents.empty()) return;
  tangents_ = new osg::Vec4Array;
  for (const auto& t : surface.tangents) tangents_->push_back({t[0], t[1], t[2], t[3]});
}

void ModelShapes::addLevel(const ModelLevel& level) {
  Level made{{}, level.error};
  for (const std::vector<std::uint32_t>& corners : level.corners) {
    made.geometries.emplace_back();
    if (corners.empty()) continue;
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setUseDisplayList(false);
    geometry->setUseVertexBufferObjects(true);
    geometry->setVertexArray(places_);
    geometry->setNormalArray(normals_, osg::Array::BIND_PER_VERTEX);
    geometry->setColorArray(colors_, osg::Array::BIND_PER_VERTEX);
    if (at_) geometry->setTexCoordArray(0, at_);
    if (tangents_) geometry->setTexCoordArray(1, tangents_);
    geometry->addPrimitiveSet(new osg::DrawElementsUInt(osg::PrimitiveSet::TRIANGLES, corners.begin(), corners.end()));
    made.geometries.back() = geometry;
  }
  levels_.push_back(std::move(made));
}

const ModelShapes::States& ModelShapes::states(bool quick) {
  States& states = states_[quick ? 1 : 0];
  if (states.empty())
    for (const Model::Part& part : parts_) states.push_back(stateOf(part.material, quick));
  return states;
}

osg::ref_ptr<osg::StateSet> ModelShapes::stateOf(const ModelMaterial& material, bool quick) const {
  osg::ref_ptr<osg::StateSet> state = new osg::StateSet;
  const shaders::Maps maps{.color = material.color_map >= 0,
                           .normal = material.normal_map >= 0,
                           .roughness = material.roughness_map >= 0 && !quick};
  state->setAttributeAndModes(shaders::model(maps, quick));
  const auto map = [&](const char* name, unsigned unit, int texture, TextureUse use) {
    state->setTextureAttribute(unit, textureOf(*model_, texture, use), osg::StateAttribute::ON);
    state->addUniform(new osg::Uniform(name, static_cast<int>(unit)));
  };
  if (maps.color)
    map("color_map", kColorUnit, material.color_map, quick ? TextureUse::kQuickColor : TextureUse::kColor);
  if (maps.normal) map("normal_map", kNormalUnit, material.normal_map, TextureUse::kNormal);
  if (maps.roughness) map("rough_map", kRoughUnit, material.roughness_map, TextureUse::kRoughness);
  state->addUniform(new osg::Uniform("relief", static_cast<float>(material.relief)));
  state->addUniform(new osg::Uniform("roughness", static_cast<float>(material.roughness)));
  state->addUniform(new osg::Uniform("metallic", static_cast<float>(material.metallic)));
  if (quick && maps.color) {
    const Vec3 mean = meanOf(*imageOf(*model_, material.color_map)).cwiseMax(kDarkest);
    const auto put = [&](const char* name, auto of) {
      state->addUniform(new osg::Uniform(name, osg::Vec3(osg::Vec3d(of(mean.x()), of(mean.y()), of(mean.z())))));
    };
    put("map_mean", [](double display) { return srgb::toLinear(display); });
    put("map_gain", [](double display) { return 1 / display; });
  }
  return state;
}

osg::ref_ptr<osg::LOD> ModelShapes::node(bool quick) {
  const States& states = this->states(quick);
  osg::ref_ptr<osg::LOD> node = new osg::LOD;
  node->setRangeMode(osg::LOD::PIXEL_SIZE_ON_SCREEN);
  const std::size_t finest = !quick ? 0
                                    : static_cast<std::size_t>(std::ranges::count_if(
                                          levels_, [](const Level& level) { return level.error <= kQuickError; })) -
                                          1;
  for (std::size_t i = finest; i < levels_.size(); ++i) {
    osg::ref_ptr<osg::Group> level = new osg::Group;
    for (std::size_t part = 0; part < states.size(); ++part) {
      if (!levels_[i].geometries[part]) continue;
      osg::ref_ptr<osg::Group> painted = new osg::Group;  // one geometry has two states: fine and quick
      painted->setStateSet(states[part]);
      painted->addChild(levels_[i].geometries[part]);
      level->addChild(painted);
    }
    node->addChild(level);
  }
  // OSG measures the model's bounding sphere: its diameter in pixels
  const double diameter = 2 * double{node->getBound().radius()}, pixels = quick ? kQuickPixels : kFinePixels;
  double max = 1e30;
  for (std::size_t i = finest; i < levels_.size(); ++i) {
    const bool last = i + 1 == levels_.size();
    const double min = last ? 0 : pixels * diameter / std::max(levels_[i + 1].error, 1e-12);
    node->setRange(static_cast<unsigned>(i - finest), static_cast<float>(std::min(min, max)), static_cast<float>(max));
    max = std::min(min, max);
  }
  node->setUserData(this);
  return node;
}

}  // namespace

osg::ref_ptr<osg::Node> modelNode(const std::shared_ptr<const Model>& model, bool quick) {
  static std::mutex guard;
  static std::map<const Model*, osg::observer_ptr<ModelShapes>> all;  // is never iterated in an order that shows
  const std::lock_guard lock(guard);
  std::erase_if(all, [](const auto& one) { return !one.second.valid(); });
  osg::ref_ptr<ModelShapes> shapes;
  if (!all[model.get()].lock(shapes)) {
    shapes = new ModelShapes(model);
    all[model.get()] = shapes;
  }
  return shapes->node(quick);
}

}  // namespace presa::view
