#include "modules/pointshell/solid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>
#include <stdexcept>
#include <string>

#include "framework/geometry/long_work.h"
#include "framework/haptics/touchables.h"
#include "modules/pointshell/field_cache.h"

namespace presa {
namespace {

constexpr double kVoxelsAlong = 200;  // of the mesh's longest side, where the scene says nothing
constexpr double kVoxelsThick = 4;    // of a thin shell: its inside then has samples, and each side a normal

using SharedField = std::shared_ptr<const DistanceField>;

std::string millimetres(double length) { return std::to_string(1e3 * length) + " mm"; }

/// The fields in use: who draws them gets the same ones. Thread: any.
class FieldsInUse {
 public:
  /// Null: nobody has it.
  SharedField find(const std::shared_ptr<const TriMesh>& mesh, double thickness, double voxel) {
    const std::lock_guard lock(mutex_);
    std::erase_if(fields_, [](const Known& known) { return known.field.expired(); });
    for (const Known& known : fields_) {
      if (known.voxel == voxel && known.thickness == thickness && known.mesh.lock() == mesh) return known.field.lock();
    }
    return nullptr;
  }
  void add(const std::shared_ptr<const TriMesh>& mesh, double thickness, double voxel, const SharedField& field) {
    const std::lock_guard lock(mutex_);
    fields_.push_back({mesh, thickness, voxel, field});
  }

 private:
  struct Known {
    std::weak_ptr<const TriMesh> mesh;
    double thickness, voxel;
    std::weak_ptr<const DistanceField> field;
  };
  std::mutex mutex_;
  std::vector<Known> fields_;
};

FieldsInUse& fieldsInUse() {
  static FieldsInUse fields;
  return fields;
}

/// Thickness of the shell that an open mesh becomes; 0: a solid.
double thicknessOf(const Body& body, const TriMesh& mesh, const FieldSettings& settings) {
  const MeshReport report = checkMesh(mesh);
  if (report.closed() && report.flipped_edges == 0) return 0;
  if (settings.shell_thickness > 0) return settings.shell_thickness;
  throw std::invalid_argument("the haptic mesh of body '" + body.name + "' is open or folded (" +
                              std::to_string(report.open_edges) +
                              " open edges): a distance field needs an inside; close the mesh, give a primitive, or "
                              "make it a thin shell with <pointshell shell_thickness=…>");
}

double voxelOf(const Body& body, const TriMesh& mesh, const FieldSettings& settings, double thickness) {
  const AxisBox bounds = boundsOf(mesh);
  const double usual = (bounds.high - bounds.low).maxCoeff() / kVoxelsAlong;
  const double most = thickness / kVoxelsThick;
  if (!(thickness > 0)) return settings.voxel > 0 ? settings.voxel : usual;
  if (!(settings.voxel > 0)) return std::min(usual, most);
  if (settings.voxel <= most) return settings.voxel;
  throw std::invalid_argument("the mesh of body '" + body.name + "' is open, and a shell_thickness of " +
                              millimetres(thickness) + " is less than four voxels of " + millimetres(settings.voxel) +
                              ": a voxel of at most " + millimetres(most) + ", or a thicker shell");
}

SharedField fieldOf(const Body& body, const std::shared_ptr<const TriMesh>& shared, const FieldSettings& settings,
                    std::size_t used) {
  const TriMesh& mesh = *shared;
  const double thickness = thicknessOf(body, mesh, settings), voxel = voxelOf(body, mesh, settings, thickness);
  const GoOn told = toldToListener("distance field of body '" + body.name + "'");
  bool stopped = false;
  const DistanceField::Settings wanted{
      .voxel = voxel, .max_bytes = settings.max_bytes - std::min(used, settings.max_bytes), .go_on = [&](double share) {
        return !(stopped = stopped || (told && !told(share)));
      }};
  if (SharedField known = fieldsInUse().find(shared, thickness, voxel); known && known->roomBytes() <= wanted.max_bytes)
    return known;
  DistanceField::Size size;
  if (std::optional<DistanceField> field = cachedField(mesh, thickness, wanted, size)) {
    auto made = std::make_shared<const DistanceField>(*std::move(field));
    fieldsInUse().add(shared, thickness, voxel, made);
    return made;
  }
  if (stopped) throw WorkStopped();
  throw std::invalid_argument("the distance field of body '" + body.name + "' needs " +
                              std::to_string((size.bytes >> 20U) + 1) + " MiB with voxels of " + millimetres(voxel) +
                              ", and " + std::to_string(wanted.max_bytes >> 20U) +
                              " MiB are left: a larger voxel, or more memory");
}

}  // namespace

double Solid::lowerBound(const Vec3& p_B) const noexcept {
  return field ? field->lowerBound(X_BG.inverseTimes(p_B)) : nearest(primitive, p_B).distance;
}

double Solid::distance(const Vec3& p_B) const noexcept {
  if (!field) return nearest(primitive, p_B).distance;
  const Vec3 p_G = X_BG.inverseTimes(p_B);
  const AxisBox box = field->box();
  const bool inside = (p_G.array() >= box.low.array()).all() && (p_G.array() <= box.high.array()).all();
  return inside ? field->at(p_G) : std::numeric_limits<double>::infinity();
}

SeenSolid::SeenSolid(const Solid& solid, const Pose& X_BT) noexcept
    : solid_(solid),
      X_BT_(X_BT),
      X_GT_((solid.field ? solid.X_BG : std::get<Primitive>(solid.primitive.shape).X_AG).inverse() * X_BT),
      R_BT_(X_BT.q.toRotationMatrix()),
      R_GT_(X_GT_.q.toRotationMatrix()) {
  if (!solid.field) return;
  voxel_ = solid.voxel();
  turn_ = R_GT_ / voxel_;
  shift_ = (X_GT_.p - solid.field->origin()) / voxel_;
}

// As nearest(primitive, p).distance, without the direction.
double SeenSolid::exact(const Eigen::Vector3f& p_T) const noexcept {
  const auto& primitive = std::get<Primitive>(solid_.primitive.shape);
  const Vec3 p = X_GT_.p + R_GT_ * p_T.cast<double>();
  if (primitive.kind == Primitive::Kind::kSphere) return p.norm() - primitive.radius;
  if (primitive.kind == Primitive::Kind::kCapsule) {
    const double beyond = std::max(0.0, std::abs(p.z()) - primitive.half_length);
    return std::sqrt(p.x() * p.x() + p.y() * p.y() + beyond * beyond) - primitive.radius;
  }
  Vec3 out = p.cwiseAbs() - primitive.half;
  if (primitive.kind == Primitive::Kind::kCylinder)
    out = {std::hypot(p.x(), p.y()) - primitive.radius, std::abs(p.z()) - primitive.half_length, -1e9};
  const double deepest = out.maxCoeff();
  return deepest <= 0 ? deepest : out.cwiseMax(0).norm();
}

void SeenSolid::distances(std::span<const Eigen::Vector3f> points_T,
                          std::array<float, FieldSweep::kMax>& out) const noexcept {
  constexpr float kRounding = 1e-3F;  // of a place in single precision, in a grid of up to 3000 voxels along a side
  if (!solid_.field) {
    for (std::size_t i = 0; i < points_T.size(); ++i) out[i] = static_cast<float>(exact(points_T[i]));
    return;
  }
  FieldSweep sweep(*solid_.field);
  sweep.place(turn_.cast<float>(), shift_.cast<float>(), points_T);
  sweep.lookUp();
  const auto voxel = static_cast<float>(voxel_);
  for (std::size_t i = 0; i < points_T.size(); ++i) out[i] = voxel * (sweep.distance[i] - kRounding);
}

SeenPoints::SeenPoints(const SeenSolid& solid) noexcept : solid_(solid) {
  if (solid.solid_.field) sweep_.emplace(*solid.solid_.field);
}

void SeenPoints::add(const Eigen::Vector3f& p_T) noexcept {
  points_T_[count_++] = p_T;
  if (!sweep_) return;
  const Vec3 g = solid_.turn_ * p_T.cast<double>() + solid_.shift_;
  sweep_->add(g.x(), g.y(), g.z());
}

void SeenPoints::lookUp() noexcept {
  if (sweep_) sweep_->lookUpSlopes();
  for (std::size_t i = 0; i < count_; ++i)
    distance_[i] = sweep_ ? solid_.voxel_ * static_cast<double>(sweep_->distance[i]) : solid_.exact(points_T_[i]);
}

Vec3 SeenPoints::slope(std::size_t i) const noexcept {
  if (!sweep_) return solid_.normal(points_T_[i]);
  const Eigen::Vector3f slope(sweep_->slope[0][i], sweep_->slope[1][i], sweep_->slope[2][i]);
  return solid_.voxel_ * (solid_.turn_.transpose() * slope.cast<double>());
}

Vec3 SeenSolid::normal(const Eigen::Vector3f& p_T) const noexcept {
  if (!solid_.field) return R_BT_.transpose() * nearest(solid_.primitive, X_BT_.p + R_BT_ * p_T.cast<double>()).nhat;
  const DistanceField& field = *solid_.field;
  const Vec3 g = turn_ * p_T.cast<double>() + shift_;
  const Eigen::Vector3f gradient(field.inVoxels(g.x() + 1, g.y(), g.z()) - field.inVoxels(g.x() - 1, g.y(), g.z()),
                                 field.inVoxels(g.x(), g.y() + 1, g.z()) - field.inVoxels(g.x(), g.y() - 1, g.z()),
                                 field.inVoxels(g.x(), g.y(), g.z() + 1) - field.inVoxels(g.x(), g.y(), g.z() - 1));
  const Vec3 normal = turn_.transpose() * gradient.cast<double>();
  const double length = normal.norm();
  return length > 0 ? Vec3(normal / length) : Vec3(Vec3::UnitZ());
}

double SeenSolid::voxelAt(const Eigen::Vector3f& p_T, Vec3& center_T) const noexcept {
  center_T = p_T.cast<double>();
  if (!solid_.field) return exact(p_T);
  Vec3 center_G = Vec3::Zero();
  const double distance = solid_.field->nearestSample(X_GT_ * center_T, center_G);
  center_T = X_GT_.inverseTimes(center_G);
  return distance;
}

std::vector<Solid> solidsOf(const World& world, const FieldSettings& settings) {
  std::vector<Solid> solids;
  std::map<const TriMesh*, SharedField> fields;
  std::size_t used = 0;
  for (std::size_t b = 0; b < world.scene.bodies.size(); ++b) {
    const Body& body = world.scene.bodies[b];
    if (!body.haptic) continue;
    const auto index = static_cast<std::int32_t>(b);
    if (const std::optional<Primitive> primitive = primitiveOf(*body.haptic)) {
      solids.push_back({index, {index, -1, *primitive}, nullptr, {}});
      continue;
    }
    const std::shared_ptr<const TriMesh>& mesh = world.meshes[b].haptic;
    if (mesh == nullptr) continue;
    SharedField& field = fields[mesh.get()];
    if (!field) {
      field = fieldOf(body, mesh, settings, used);
      used += field->roomBytes();
    }
    solids.push_back({index, {}, field, body.haptic->X_BG});
  }
  return solids;
}

}  // namespace presa
