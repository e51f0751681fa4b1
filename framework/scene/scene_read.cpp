#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <map>
#include <utility>

#include "framework/scene/joints/joint_parts.h"
#include "framework/scene/manifest.h"
#include "framework/scene/scene_parts.h"
#include "framework/scene/xml/value_rule.h"

namespace presa {
namespace {

using xml::Element;

Vec3 readVec3(const Element& element, const std::string& attribute, const Vec3& fallback) {
  const std::vector<double> v = element.numbers(attribute);
  return v.size() == 3 ? Vec3(v[0], v[1], v[2]) : fallback;
}

/// Half angles are reduced in degrees, where this is exact: a turn of 180 degrees has a cosine of exactly 0.
Quat turnAbout(const Vec3& axis, double degrees) {
  int quarter = 0;
  const double rest = std::remquo(degrees / 2, 90.0, &quarter) * (EIGEN_PI / 180);
  double c = std::cos(rest), s = std::sin(rest);
  if (quarter & 1) {
    const double old_c = c;
    c = -s;
    s = old_c;
  }
  if (quarter & 2) {
    c = -c;
    s = -s;
  }
  return {c, s * axis.x(), s * axis.y(), s * axis.z()};
}

/// Scales by the largest entry first, so that the squares of huge or tiny entries neither overflow nor underflow.
Quat unitQuat(const std::vector<double>& wxyz) {
  Eigen::Vector4d v(wxyz[0], wxyz[1], wxyz[2], wxyz[3]);
  v /= v.cwiseAbs().maxCoeff();
  v /= v.norm();
  return {v[0], v[1], v[2], v[3]};
}

Shape readShape(const Element& shape, const std::string& directory) {
  const std::string kind = shape.name();
  const double radius = shape.number("radius", 0), length = shape.number("length", 0);
  if (kind == "box") return Box{readVec3(shape, "size", Vec3::Zero())};
  if (kind == "sphere") return Sphere{radius};
  if (kind == "cylinder") return Cylinder{radius, length};
  if (kind == "capsule") return Capsule{radius, length};
  MeshRef mesh{resolvePath(shape.attribute("file"), directory), readVec3(shape, "scale", Vec3::Ones())};
  if (!shape.boolean("decompose", false)) return mesh;
  const Decomposition usual;
  mesh.decompose = {static_cast<std::size_t>(shape.number("max_pieces", static_cast<double>(usual.max_pieces))),
                    shape.number("max_error", usual.max_error)};
  return mesh;
}

std::optional<Geometry> readGeometry(const Element& body, const std::string& role, const std::string& directory) {
  const std::vector<Element> geometries = body.children(role);
  if (geometries.empty()) return std::nullopt;
  const Element& geometry = geometries[0];
  return Geometry{readShape(geometry.children().at(0), directory), readPose(geometry), geometry.where(),
                  geometry.attribute("shading") == "smooth"};
}

bool isPlaced(const Element& shape) {
  return shape.hasAttribute("pos") || shape.hasAttribute("euler_deg") || shape.hasAttribute("quat");
}

std::optional<Geometry> readPhysics(const Element& body, const std::string& directory) {
  std::optional<Geometry> geometry = readGeometry(body, "physics", directory);
  if (!geometry) return std::nullopt;
  const std::vector<Element> shapes = body.children("physics")[0].children();
  if (shapes.size() == 1) {
    if (isPlaced(shapes[0])) geometry->X_BG = geometry->X_BG * readPose(shapes[0]);
    return geometry;
  }
  Compound compound;
  for (const Element& shape : shapes)
    compound.parts.push_back({readShape(shape, directory), readPose(shape), shape.where()});
  geometry->shape = std::move(compound);
  return geometry;
}

Material readMaterial(const Element& element) {
  Material material;
  material.name = element.attribute("name");
  material.stiffness = element.number("stiffness", 0);
  material.damping = element.number("damping", 0);
  material.restitution = element.number("restitution", 0);
  material.color = readVec3(element, "color", material.color);
  const std::string texture = element.attribute("texture");
  material.texture = texture == "stone"   ? Material::Texture::kStone
                     : texture == "earth" ? Material::Texture::kEarth
                                          : Material::Texture::kNone;
  for (const Element& friction : element.children("friction")) {
    material.friction_static = friction.number("static", 0);
    material.friction_dynamic = friction.number("dynamic", 0);
    material.torsional_radius = friction.number("torsion", 0);
    material.rolling = friction.number("rolling", 0);
    for (const Element& changed : friction.children("changed"))
      material.changed_friction = {changed.number("static", 0), changed.number("dynamic", 0)};
  }
  material.where = element.where();
  return material;
}

/// Index of each name: avoids a linear search per reference in scenes with thousands of bodies.
using IndexByName = std::map<std::string, std::size_t>;

template <class Named>
IndexByName indexByName(const std::vector<Named>& all) {
  IndexByName index_of;
  for (std::size_t i = 0; i < all.size(); ++i) index_of.try_emplace(all[i].name, i);
  return index_of;
}

std::vector<std::size_t> indicesOf(const std::vector<std::string>& names, const IndexByName& index_of) {
  std::vector<std::size_t> indices;
  for (const std::string& name : names) indices.push_back(index_of.at(name));
  return indices;
}

/// "ixx iyy izz ixy ixz iyz"
Mat3 readInertia(const Element& physics) {
  const std::vector<double> m = physics.numbers("inertia");
  Mat3 inertia;
  inertia << m[0], m[3], m[4], m[3], m[1], m[5], m[4], m[5], m[2];
  return inertia;
}

Body readBody(const Element& element, const IndexByName& materials, const std::string& directory) {
  Body body;
  body.name = element.attribute("name");
  body.fixed = element.boolean("fixed", false);
  body.X_WB = readPose(element);
  body.material = materials.at(element.attribute("material"));
  body.visual = readGeometry(element, "visual", directory);
  body.haptic = readGeometry(element, "haptic", directory);
  body.physics = readPhysics(element, directory);
  for (const Element& physics : element.children("physics")) {
    if (body.fixed) continue;
    body.mass = optionalNumber(physics, "mass");
    body.density = optionalNumber(physics, "density");
    body.force_W = readVec3(physics, "force", body.force_W);
    if (physics.hasAttribute("center")) body.p_BCm = readVec3(physics, "center", Vec3::Zero());
    if (physics.hasAttribute("inertia")) body.inertia_B = readInertia(physics);
  }
  if (!body.fixed) {
    body.v_WCm = readVec3(element, "velocity", body.v_WCm);
    body.w_WB = readVec3(element, "angular_velocity", body.w_WB);
  }
  body.where = element.where();
  return body;
}

Assembly readAssembly(const Element& element, const std::vector<Body>& bodies) {
  Assembly assembly;
  assembly.snap_distance = element.number("reach", assembly.snap_distance);
  assembly.snap_angle_deg = element.number("reach_angle_deg", assembly.snap_angle_deg);
  assembly.tolerance = element.number("tolerance", assembly.tolerance);
  assembly.tolerance_angle_deg = element.number("tolerance_angle_deg", assembly.tolerance_angle_deg);
  assembly.snap_force = element.number("pull", assembly.snap_force);
  for (const Element& field : element.children("field"))
    assembly.workspace = {readVec3(field, "pos", Vec3::Zero()), readVec3(field, "size", Vec3::Zero())};
  assembly.elapsed = element.number("spent", assembly.elapsed);
  for (const Element& words : element.children("words")) assembly.words = readWords(words);
  const IndexByName elements = indexByName(assembly.words.elements), body_indices = indexByName(bodies);
  const std::vector<Element> goals = element.children("goal");
  for (const Element& goal : goals) {
    assembly.goals.push_back({.name = goal.attribute("name"),
                              .bodies = indicesOf(xml::splitWords(goal.attribute("bodies")), body_indices),
                              .X_WB = readPose(goal),
                              .fold = static_cast<std::size_t>(goal.number("fold", 1)),
                              .after = {}});
    assembly.goals.back().snap_distance = goal.number("reach", 0);
    if (const std::string name = goal.attribute("element"); !name.empty())
      assembly.goals.back().element = indicesOf({name}, elements).front();
  }
  const IndexByName goal_indices = indexByName(assembly.goals);
  for (std::size_t g = 0; g < goals.size(); ++g)
    assembly.goals[g].after = indicesOf(xml::splitWords(goals[g].attribute("after")), goal_indices);
  return assembly;
}

ToolCoupling readCoupling(const Element& tool) {
  ToolCoupling coupling;
  coupling.stiffness = tool.number("stiffness", coupling.stiffness);
  coupling.turn_stiffness = tool.number("turn_stiffness", coupling.turn_stiffness);
  coupling.damping = tool.number("damping", coupling.damping);
  coupling.turn_damping = tool.number("turn_damping", coupling.turn_damping);
  coupling.max_force = tool.number("max_force", coupling.max_force);
  coupling.max_torque = tool.number("max_torque", coupling.max_torque);
  coupling.damping_along = tool.boolean("damping_along", coupling.damping_along);
  return coupling;
}

DeviceRole readDevice(const Element& element, const std::string& directory) {
  DeviceRole device;
  device.role = element.attribute("role");
  device.fingertip_radius = element.number("fingertip_radius", device.fingertip_radius);
  for (const Element& limits : element.children("limits")) {
    device.limits.force = limits.number("force", device.limits.force);
    device.limits.force_rate = limits.number("force_rate", device.limits.force_rate);
    device.limits.torque = limits.number("torque", device.limits.torque);
    device.limits.torque_rate = limits.number("torque_rate", device.limits.torque_rate);
    device.limits.watchdog_ms = limits.number("watchdog_ms", device.limits.watchdog_ms);
  }
  if (std::optional<Geometry> tool = readGeometry(element, "tool", directory)) {
    const Element told = element.children("tool")[0];
    device.tool = {*std::move(tool), readCoupling(told)};
    if (told.hasAttribute("put_down")) device.tool->put_down = static_cast<int>(told.number("put_down", 0));
  }
  device.where = element.where();
  return device;
}

/// Maps the word in an attribute to an enum value; the schema has checked that it is one of the allowed words.
template <class Value>
Value choose(const Element& element, const std::string& attribute, Value fallback,
             std::initializer_list<std::pair<const char*, Value>> words) {
  for (const auto& [word, value] : words) {
    if (element.attribute(attribute) == word) return value;
  }
  return fallback;
}

HapticSettings readHaptics(const Element& element) {
  using H = HapticSettings;
  H settings;
  settings.renderer = element.attribute("renderer");
  settings.tool_renderer = element.attribute("tools", kDefaultToolRenderer);
  const Manifest* renderer = findManifest(settings.renderer);
  settings.proxy = renderer != nullptr && renderer->hasProxy();
  settings.pose = choose(element, "pose", settings.pose, {{"hold", H::PoseUse::kHold}});
  return settings;
}

CollisionSettings readCollision(const Element& element) {
  using C = CollisionSettings;
  C settings;
  settings.index =
      choose(element, "index", settings.index, {{"obb", C::Index::kObb}, {"hcollide", C::Index::kHcollide}});
  settings.margin = element.number("margin", 0);
  return settings;
}

DynamicsSettings readDynamics(const Element& element) {
  using D = DynamicsSettings;
  D settings;
  settings.engine = element.attribute("engine");
  settings.coupling = choose(element, "coupling", settings.coupling,
                             {{"explicit", D::Coupling::kExplicit},
                              {"averaged", D::Coupling::kAveraged},
                              {"haptic_rate", D::Coupling::kHapticRate}});
  settings.solver = choose(element, "solver", settings.solver,
                           {{"direct", D::Solver::kDirect},
                            {"iterative", D::Solver::kIterative},
                            {"newton", D::Solver::kNewton},
                            {"small_steps", D::Solver::kSmallSteps}});
  settings.iterations = static_cast<std::size_t>(element.number("iterations", 0));
  settings.substeps = static_cast<std::size_t>(element.number("substeps", 0));
  settings.friction = choose(element, "friction", settings.friction, {{"pyramid", D::Friction::kPyramid}});
  settings.rotation = choose(element, "rotation", settings.rotation,
                             {{"engine", D::Rotation::kEngine},
                              {"none", D::Rotation::kNone},
                              {"euler", D::Rotation::kEuler},
                              {"matrix", D::Rotation::kMatrix}});
  settings.sleeping = element.boolean("sleeping", settings.sleeping);
  settings.max_held = static_cast<std::size_t>(element.number("max_held", static_cast<double>(settings.max_held)));
  return settings;
}

}  // namespace

Pose readPose(const Element& element) {
  Pose pose;
  pose.p = readVec3(element, "pos", Vec3::Zero());
  const std::vector<double> quat = element.numbers("quat");
  if (quat.size() == 4) {
    pose.q = unitQuat(quat);
  } else if (element.hasAttribute("euler_deg")) {
    const Vec3 turn = readVec3(element, "euler_deg", Vec3::Zero());
    pose.q =
        turnAbout(Vec3::UnitX(), turn.x()) * turnAbout(Vec3::UnitY(), turn.y()) * turnAbout(Vec3::UnitZ(), turn.z());
    pose.q.normalize();
  }
  return pose;
}

bool Scene::surfacesChange() const {
  return haptics.proxy && std::any_of(bodies.begin(), bodies.end(), [&](const Body& body) {
           return body.haptic && materialOf(body).changed_friction;
         });
}

Scene readScene(const Element& root, const std::string& file, const std::string& directory) {
  Scene scene;
  scene.name = root.attribute("name");
  scene.description = root.attribute("description");
  scene.file = file;
  scene.default_rig = resolvePath(root.attribute("rig"), directory);
  for (const Element& world : root.children("world")) scene.gravity = readVec3(world, "gravity", scene.gravity);
  for (const Element& rates : root.children("rates")) {
    scene.rates.haptic = rates.number("haptic", scene.rates.haptic);
    scene.rates.collision = rates.number("collision", scene.rates.collision);
    scene.rates.dynamics = rates.number("dynamics", scene.rates.dynamics);
    scene.rates.view = rates.number("view", scene.rates.view);
  }
  for (const Element& haptics : root.children("haptics")) scene.haptics = readHaptics(haptics);
  for (const Element& collision : root.children("collision")) scene.collision = readCollision(collision);
  for (const Element& dynamics : root.children("dynamics")) scene.dynamics = readDynamics(dynamics);
  for (const Element& material : materialElements(root)) scene.materials.push_back(readMaterial(material));
  const IndexByName materials = indexByName(scene.materials);
  for (const Element& body : root.children("body")) scene.bodies.push_back(readBody(body, materials, directory));
  scene.joints = readJoints(root, scene.bodies);
  for (const Element& device : deviceElements(root)) scene.devices.push_back(readDevice(device, directory));
  for (const Element& assembly : root.children("assembly")) scene.assembly = readAssembly(assembly, scene.bodies);
  scene.plugin_elements = readPluginElements(root);
  scene.bus = readBus(root);
  return scene;
}

}  // namespace presa
