#include "framework/bus/scene_hash.h"

#include <bit>
#include <string_view>

#include "framework/core/math/fnv.h"

namespace presa::bus {
namespace {

class Hash {
 public:
  void add(std::uint64_t word) { hash_.addWord(word); }
  void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
  void add(std::string_view text) {
    hash_.add(text);
    hash_.add(std::uint8_t{0});
  }
  void add(const Vec3& v) {
    for (const double x : v) add(x);
  }
  void add(const Pose& X) {
    add(X.p);
    for (const double x : {X.q.w(), X.q.x(), X.q.y(), X.q.z()}) add(x);
  }
  void add(const TriMesh& mesh) {
    for (const Vec3& vertex : mesh.vertices) add(vertex);
    for (const TriMesh::Triangle& triangle : mesh.triangles) {
      for (const std::int32_t index : triangle) add(static_cast<std::uint64_t>(index));
    }
  }
  std::uint64_t value() const { return hash_.value(); }

 private:
  Fnv1a hash_;
};

struct AddShape {
  Hash& hash;
  void operator()(const MeshRef& mesh) const { hash.add(mesh.scale); }
  void operator()(const Box& box) const { hash.add(box.size); }
  void operator()(const Sphere& sphere) const { hash.add(sphere.radius); }
  void operator()(const Cylinder& rod) const { addRod(rod.radius, rod.length); }
  void operator()(const Capsule& rod) const { addRod(rod.radius, rod.length); }
  void operator()(const Compound&) const {}  // addParts
  void addRod(double radius, double length) const {
    hash.add(radius);
    hash.add(length);
  }
};

void addParts(Hash& hash, const Compound& compound, const BodyMeshes& meshes) {
  hash.add(std::uint64_t{compound.parts.size()});
  for (std::size_t k = 0; k < compound.parts.size(); ++k) {
    const ShapePart& part = compound.parts[k];
    hash.add(std::uint64_t{part.shape.index() + 1});
    hash.add(part.X_GP);
    std::visit(AddShape{hash}, part.shape);
    if (meshes.parts[k]) hash.add(*meshes.parts[k]);
  }
}

void addGeometry(Hash& hash, const std::optional<Geometry>& geometry, const TriMesh* mesh) {
  hash.add(std::uint64_t{geometry ? geometry->shape.index() + 1 : 0});
  if (!geometry) return;
  hash.add(geometry->X_BG);
  std::visit(AddShape{hash}, geometry->shape);
  if (mesh != nullptr) hash.add(*mesh);
}

}  // namespace

std::uint64_t sceneHash(const World& world) {
  Hash hash;
  for (std::size_t b = 0; b < world.scene.bodies.size(); ++b) {
    const Body& body = world.scene.bodies[b];
    hash.add(body.name);
    hash.add(std::uint64_t{body.fixed});
    hash.add(body.X_WB);
    addGeometry(hash, body.visual, world.meshes[b].visual.get());
    addGeometry(hash, body.haptic, world.meshes[b].haptic.get());
    addGeometry(hash, body.physics, world.meshes[b].physics.get());
    const auto* compound = body.physics ? std::get_if<Compound>(&body.physics->shape) : nullptr;
    if (compound != nullptr) addParts(hash, *compound, world.meshes[b]);
  }
  for (const DeviceRole& device : world.scene.devices) {
    hash.add(device.role);
    hash.add(device.fingertip_radius);
    if (device.tool) addGeometry(hash, device.tool->geometry, nullptr);
  }
  return hash.value();
}

}  // namespace presa::bus
