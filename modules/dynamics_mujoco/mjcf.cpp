#include "modules/dynamics_mujoco/mjcf.h"

#include <algorithm>
#include <cstdio>

#include "framework/scene/physics_shapes.h"

namespace presa::mujoco {
namespace {

std::string number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, " %.17g", value);
  return text;
}

std::string numbers(const Vec3& v) { return number(v.x()) + number(v.y()) + number(v.z()); }

std::string pose(const Pose& X) {
  return " pos=\"" + numbers(X.p) + "\" quat=\"" + number(X.q.w()) + number(X.q.x()) + number(X.q.y()) +
         number(X.q.z()) + "\"";
}

std::string shape(const Shape& shape, const Body& body) {
  if (const auto* box = std::get_if<Box>(&shape)) return "type=\"box\" size=\"" + numbers(box->size / 2) + "\"";
  if (const auto* sphere = std::get_if<Sphere>(&shape))
    return "type=\"sphere\" size=\"" + number(sphere->radius) + "\"";
  if (const auto* rod = std::get_if<Cylinder>(&shape))
    return "type=\"cylinder\" size=\"" + number(rod->radius) + number(rod->length / 2) + "\"";
  if (const auto* rod = std::get_if<Capsule>(&shape))
    return "type=\"capsule\" size=\"" + number(rod->radius) + number(rod->length / 2) + "\"";
  Diagnostics diagnostics;
  diagnostics.error(580, body.physics->where,
                    "body '" + body.name + "': dynamics_mujoco has no mesh as physics geometry",
                    "use a box, sphere, cylinder or capsule, or engine=\"ode\"");
  throw InputError(diagnostics);
}

std::string geoms(const World& world, std::size_t i) {
  const Body& body = world.scene.bodies[i];
  std::string text;
  for (const PhysicsShape& one : physicsShapes(body, world.meshes[i])) {
    text += "<geom " + shape(*one.shape, body) + pose(one.X_BG) + " friction=\"" +
            number(world.scene.materialOf(body).friction_dynamic) + " 0 0\"/>\n";
  }
  return text;
}

std::string inertial(const BodyInertia& inertia) {
  const Mat3& I = inertia.inertia;
  return "<inertial pos=\"" + numbers(inertia.p_BCm) + "\" mass=\"" + number(inertia.mass) + "\" fullinertia=\"" +
         number(I(0, 0)) + number(I(1, 1)) + number(I(2, 2)) + number(I(0, 1)) + number(I(0, 2)) + number(I(1, 2)) +
         "\"/>\n";
}

}  // namespace

std::string mjcfOf(const World& world, double step) {
  const Scene& scene = world.scene;
  std::string bodies;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Body& body = scene.bodies[i];
    bodies += "<body name=\"" + body.name + "\"" + pose(body.X_WB) + ">\n";
    if (!body.fixed) bodies += "<freejoint/>" + inertial(world.inertias[i]);
    bodies += geoms(world, i) + "</body>\n";
  }
  const std::string iterations =
      scene.dynamics.iterations > 0 ? " iterations=\"" + std::to_string(scene.dynamics.iterations) + "\"" : "";
  const std::string solver = scene.dynamics.solver == DynamicsSettings::Solver::kIterative ? "CG" : "Newton";
  // capacity for six neighbours with four contacts each, of three rows, for each shape; MuJoCo's default stack grows
  // with the square of the rows, to 19 GB for 125 bodies
  std::size_t shapes = 0;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i)
    shapes += std::max<std::size_t>(1, physicsShapes(scene.bodies[i], world.meshes[i]).size());
  const std::size_t contacts = 100 + 24 * shapes;
  const std::size_t unknowns = 6 * scene.bodies.size();
  const std::size_t stack = 100000 + 6 * contacts * 200 + 4 * unknowns * unknowns;
  return "<mujoco model=\"" + scene.name +
         "\"><compiler balanceinertia=\"false\" boundmass=\"0\" boundinertia=\"0\"/>\n"
         "<size njmax=\"" +
         std::to_string(3 * contacts) + "\" nconmax=\"" + std::to_string(contacts) + "\" nstack=\"" +
         std::to_string(stack) +
         "\"/>\n"
         "<option timestep=\"" +
         number(step) + "\" gravity=\"" + numbers(scene.gravity) + "\" cone=\"elliptic\" solver=\"" + solver + "\"" +
         iterations + "/>\n<worldbody>\n" + bodies + "</worldbody></mujoco>\n";
}

}  // namespace presa::mujoco
