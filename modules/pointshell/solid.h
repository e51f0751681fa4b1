#pragma once
#include <memory>
#include <vector>

#include "framework/geometry/distance_field.h"
#include "framework/haptics/convex_piece.h"
#include "framework/scene/world.h"

namespace presa {

/// A body as tools meet it: an exact primitive, or the distance field of a mesh.
struct Solid {
  std::int32_t body = kNoBody;                 ///< index into Scene::bodies
  ConvexPiece primitive;                       ///< in body coordinates; counts where there is no field
  std::shared_ptr<const DistanceField> field;  ///< null: a primitive
  Pose X_BG;                                   ///< frame of the field

  double voxel() const noexcept { return field ? field->voxel() : 0; }  ///< 0: exact [m]
  /// Never above the distance of the solid itself [m]. Haptic thread; nonblocking.
  double lowerBound(const Vec3& p_B) const noexcept;
};

/// A solid as points of a tool see it, which are given in the tool's frame T. Thread: haptic; nonblocking.
class SeenSolid {
 public:
  SeenSolid(const Solid& solid, const Pose& X_BT) noexcept;

  /// Signed distance [m].
  double distance(const Eigen::Vector3f& p_T) const noexcept {
    if (solid_.field == nullptr) return exact(p_T);
    const Vec3 g = turn_ * p_T.cast<double>() + shift_;
    return voxel_ * static_cast<double>(solid_.field->inVoxels(g.x(), g.y(), g.z()));
  }

  /// Never above the distance of the solid itself [m].
  double lowerBound(const Eigen::Vector3f& p_T) const noexcept {
    return solid_.lowerBound(X_BT_.p + R_BT_ * p_T.cast<double>());
  }
  /// Gradient of distance(), in T: what a motion of p changes. A sharp edge bends it at once, and normal() gradually.
  Vec3 slope(const Eigen::Vector3f& p_T) const noexcept;
  /// Unit, outward, of the surface nearest to p, in T.
  Vec3 normal(const Eigen::Vector3f& p_T) const noexcept;
  /// As lectures print it: the depth stored in the voxel in which p is, negative inside [m], and its centre in T. Of a
  /// primitive: at p itself.
  double voxelAt(const Eigen::Vector3f& p_T, Vec3& center_T) const noexcept;

 private:
  double exact(const Eigen::Vector3f& p_T) const noexcept;

  const Solid& solid_;
  Pose X_BT_, X_GT_;
  Mat3 R_BT_, R_GT_;
  double voxel_ = 0;
  Mat3 turn_ = Mat3::Zero();  // from T into voxels of the field
  Vec3 shift_ = Vec3::Zero();
};

/// Size and cost of the distance fields.
struct FieldSettings {
  double voxel = 0;           ///< [m]; 0: 1/200 of the mesh's longest side
  std::size_t max_bytes = 0;  ///< of all of them together
};

/// The touchable bodies of a world. Equal meshes share their field, and fields that took long are kept in the user's
/// cache. Throws std::invalid_argument for an open mesh, and for fields above their memory. Thread: before a run.
std::vector<Solid> solidsOf(const World& world, const FieldSettings& settings);

}  // namespace presa
