#include "apps/presa/import/solids.h"

#include <cmath>

#include "apps/common/terminal/text.h"
#include "framework/geometry/srgb.h"
#include "framework/scene/xml/value_rule.h"

namespace presa::robot {
namespace {

constexpr double kEndless = 10;   // edge of a plane without an end [m]
constexpr double kSlab = 0.1;     // thickness of a plane [m]
constexpr double kZero = 1e-12;   // what rounding leaves of zero
constexpr double kWelded = 1e-6;  // of a mesh's diagonal: vertices nearer than this become one where it is read
constexpr double kShrunk = 1e-4;  // of a solid's size: 0.01 mm of 100 mm
constexpr int kFine = 3;          // subdivisions of a sphere: chord error below 0.5 % of the radius

using terminal::format;

Vec3 slabOf(const Part& part) {
  const auto edge = [](double size) { return size > 0 ? size : kEndless; };
  return {edge(part.size.x()), edge(part.size.y()), kSlab};
}

/// In the frame of placeOf.
TriMesh ownSurface(const Part& part, const Robot& robot) {
  switch (part.solid) {
    case Solid::kPlane:
      return makeBox(slabOf(part));
    case Solid::kBox:
      return makeBox(part.size);
    case Solid::kSphere:
      return makeSphere(part.size.x(), kFine);
    case Solid::kCapsule:
      return makeCapsule(part.size.x(), part.size.y(), 48);
    case Solid::kCylinder:
      return makeCylinder(part.size.x(), part.size.y(), 48);
    case Solid::kMesh:
      return robot.meshes[part.mesh];
    case Solid::kEllipsoid:
      break;
  }
  TriMesh ball = makeSphere(1, kFine);
  for (Vec3& vertex : ball.vertices) vertex = vertex.cwiseProduct(part.size);
  return ball;
}

}  // namespace

std::string numberText(const std::string& name, double value) {
  return " " + name + "=\"" + xml::numberText(value) + "\"";
}

std::string vectorText(const std::string& name, const Vec3& v) {
  const Vec3 exact = v.unaryExpr([](double x) { return std::abs(x) < kZero ? 0.0 : x; });
  return format(" %s=\"%.9g %.9g %.9g\"", name.c_str(), exact.x(), exact.y(), exact.z());
}

std::string poseText(const Pose& pose) {
  constexpr double kTurn = 1e-9;
  const std::string moved = pose.p.isZero(kZero) ? "" : vectorText("pos", pose.p);
  if (pose.q.vec().norm() < kTurn) return moved;
  return moved + format(" quat=\"%.9g %.9g %.9g %.9g\"", pose.q.w(), pose.q.x(), pose.q.y(), pose.q.z());
}

std::string primitiveText(const Part& part, const std::string& pose) {
  const auto round = [&](const char* shape) {
    return format("<%s radius=\"%.9g\" length=\"%.9g\"%s/>", shape, part.size.x(), part.size.y(), pose.c_str());
  };
  switch (part.solid) {
    case Solid::kPlane:
      return "<box" + vectorText("size", slabOf(part)) + pose + "/>";
    case Solid::kBox:
      return "<box" + vectorText("size", part.size) + pose + "/>";
    case Solid::kSphere:
      return "<sphere" + numberText("radius", part.size.x()) + pose + "/>";
    case Solid::kCapsule:
      return round("capsule");
    case Solid::kCylinder:
      return round("cylinder");
    default:
      return {};
  }
}

Pose placeOf(const Part& part) {
  return part.solid == Solid::kPlane ? part.X_LG * Pose{Vec3(0, 0, -kSlab / 2), Quat::Identity()} : part.X_LG;
}

TriMesh surfaceOf(const Part& part, const Robot& robot) {
  TriMesh mesh = ownSurface(part, robot);
  const Pose X_LG = placeOf(part);
  for (Vec3& vertex : mesh.vertices) vertex = X_LG * vertex;
  return mesh;
}

namespace {

void append(TriMesh& to, const TriMesh& mesh) {
  const auto first = static_cast<std::int32_t>(to.vertices.size());
  to.vertices.insert(to.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
  for (const TriMesh::Triangle& t : mesh.triangles) to.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
}

/// Whether edges of two of its parts become one where a mesh is read.
bool growsTogether(TriMesh mesh) {
  const AxisBox box = boundsOf(mesh);
  weld(mesh, kWelded * (box.high - box.low).norm());
  return checkMesh(mesh).non_manifold > 0;
}

}  // namespace

TriMesh together(const std::vector<TriMesh>& solids) {
  TriMesh all;
  for (const TriMesh& mesh : solids) append(all, mesh);
  if (!growsTogether(all)) return all;
  TriMesh apart;
  for (std::size_t i = 0; i < solids.size(); ++i) {
    TriMesh mesh = solids[i];
    const AxisBox box = boundsOf(mesh);
    const Vec3 middle = (box.low + box.high) / 2;
    for (Vec3& vertex : mesh.vertices) vertex -= kShrunk * static_cast<double>(i + 1) * (vertex - middle);
    append(apart, mesh);
  }
  return apart;
}

std::string coloredObj(const std::vector<Part>& parts, const Robot& robot) {
  std::string vertices, faces;
  std::int32_t first = 1;
  for (const Part& part : parts) {
    const TriMesh mesh = surfaceOf(part, robot);
    const Vec3 shown = part.color.unaryExpr([](double c) { return srgb::fromLinear(c); });
    for (const Vec3& v : mesh.vertices)
      vertices += format("v %.8g %.8g %.8g %.4g %.4g %.4g\n", v.x(), v.y(), v.z(), shown.x(), shown.y(), shown.z());
    for (const TriMesh::Triangle& t : mesh.triangles)
      faces += format("f %d %d %d\n", t[0] + first, t[1] + first, t[2] + first);
    first += static_cast<std::int32_t>(mesh.vertices.size());
  }
  return vertices + faces;
}

}  // namespace presa::robot
