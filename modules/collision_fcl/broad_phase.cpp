#include "modules/collision_fcl/broad_phase.h"

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision_object.h>

#include <algorithm>

namespace presa {
namespace {

using Object = fcl::CollisionObject<double>;
using SphereShape = fcl::Sphere<double>;

struct Query {
  Vec3 center;
  double radius;
  std::vector<std::int32_t>* out;
  const Object* asking;
};

std::int32_t indexOf(const Object& object) {
  return static_cast<std::int32_t>(reinterpret_cast<std::intptr_t>(object.getUserData()));
}

// FCL compares bounding boxes; this compares the spheres.
bool keepNear(Object* a, Object* b, void* data) {
  Query& query = *static_cast<Query*>(data);
  const Object& object = a == query.asking ? *b : *a;
  const double radius = static_cast<const SphereShape*>(object.collisionGeometry().get())->radius;
  if ((object.getTranslation() - query.center).norm() <= radius + query.radius) query.out->push_back(indexOf(object));
  return false;
}

}  // namespace

struct BroadPhase::Tree {
  std::vector<std::shared_ptr<SphereShape>> spheres;
  std::vector<std::unique_ptr<Object>> objects;
  std::vector<Object*> moved;
  fcl::DynamicAABBTreeCollisionManager<double> manager;
  std::shared_ptr<SphereShape> asking_sphere = std::make_shared<SphereShape>(1.0);
  Object asking{asking_sphere};
  bool built = false;
};

BroadPhase::BroadPhase(std::size_t count) : tree_(std::make_unique<Tree>()) {
  for (std::size_t i = 0; i < count; ++i) {
    tree_->spheres.push_back(std::make_shared<SphereShape>(0.0));
    tree_->objects.push_back(std::make_unique<Object>(tree_->spheres.back()));
    tree_->objects.back()->setUserData(reinterpret_cast<void*>(static_cast<std::intptr_t>(i)));
  }
  tree_->moved.reserve(count);
}

BroadPhase::~BroadPhase() = default;

void BroadPhase::place(std::size_t i, const Vec3& center, double radius) {
  SphereShape& sphere = *tree_->spheres[i];
  Object& object = *tree_->objects[i];
  if (sphere.radius != radius) {
    sphere.radius = radius;
    sphere.computeLocalAABB();
  }
  object.setTranslation(center);
  object.computeAABB();
  tree_->moved.push_back(&object);
}

void BroadPhase::refresh() {
  if (!tree_->built) {
    std::vector<Object*> all;
    for (const auto& object : tree_->objects) all.push_back(object.get());
    tree_->manager.registerObjects(all);
    tree_->manager.setup();
    tree_->built = true;
  } else if (!tree_->moved.empty()) {
    tree_->manager.update(tree_->moved);
  }
  tree_->moved.clear();
}

void BroadPhase::near(const Vec3& center, double radius, std::vector<std::int32_t>& out) const {
  out.clear();
  Tree& tree = *tree_;
  tree.asking_sphere->radius = radius;
  tree.asking_sphere->computeLocalAABB();
  tree.asking.setTranslation(center);
  tree.asking.computeAABB();
  Query query{center, radius, &out, &tree.asking};
  tree.manager.collide(&tree.asking, &query, keepNear);
  std::ranges::sort(out);
}

}  // namespace presa
