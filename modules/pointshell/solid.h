#pragma once
#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "framework/geometry/field_sweep.h"
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
  /// Signed distance of a point in body coordinates, as SeenPoints::distance; infinity outside of the field's grid, where
  /// that knows a bound only [m].
  double distance(const Vec3& p_B) const noexcept;
};

/// A solid as points of a tool see it, which are given in the tool's frame T. Thread: haptic; nonblocking.
class SeenSolid {
 public:
  SeenSolid(const Solid& solid, const Pose& X_BT) noexcept;

  /// Signed distances of up to FieldSweep::kMax points [m], at most two thousandths of a voxel below the exact ones and
  /// never above them, in single precision. The fastest way to sort out points.
  void distances(std::span<const Eigen::Vector3f> points_T, std::array<float, FieldSweep::kMax>& out) const noexcept;

  /// Never above the distance of the solid itself [m].
  double lowerBound(const Eigen::Vector3f& p_T) const noexcept {
    return solid_.lowerBound(X_BT_.p + R_BT_ * p_T.cast<double>());
  }
  /// Unit, outward, of the surface nearest to p, in T.
  Vec3 normal(const Eigen::Vector3f& p_T) const noexcept;
  /// As lectures print it: the depth stored in the voxel in which p is, negative inside [m], and its centre in T. Of a
  /// primitive: at p itself.
  double voxelAt(const Eigen::Vector3f& p_T, Vec3& center_T) const noexcept;

 private:
  friend class SeenPoints;
  double exact(const Eigen::Vector3f& p_T) const noexcept;

  const Solid& solid_;
  Pose X_BT_, X_GT_;
  Mat3 R_BT_, R_GT_;
  double voxel_ = 0;
  Mat3 turn_ = Mat3::Zero();  // from T into voxels of the field
  Vec3 shift_ = Vec3::Zero();
};

/// Up to FieldSweep::kMax points of a tool, as exactly as the solid is known. Thread: haptic; nonblocking.
class SeenPoints {
 public:
  static constexpr std::size_t kMax = FieldSweep::kMax;  ///< points at once

  /// The solid must outlive it.
  explicit SeenPoints(const SeenSolid& solid) noexcept;
  /// Adds a point.
  void add(const Eigen::Vector3f& p_T) noexcept;
  std::size_t count() const noexcept { return count_; }  ///< points added
  /// Looks all of them up.
  void lookUp() noexcept;

  double distance(std::size_t i) const noexcept { return distance_[i]; }  ///< signed [m]
  /// Gradient of distance(), in T: what a motion of the point changes. A sharp edge bends it at once, and
  /// SeenSolid::normal() gradually.
  Vec3 slope(std::size_t i) const noexcept;

 private:
  const SeenSolid& solid_;
  std::optional<FieldSweep> sweep_;  // none: a primitive
  std::size_t count_ = 0;
  std::array<Eigen::Vector3f, kMax> points_T_;
  std::array<double, kMax> distance_;
};

/// Size and cost of the distance fields.
struct FieldSettings {
  double voxel = 0;            ///< [m]; 0: 1/200 of the mesh's longest side
  std::size_t max_bytes = 0;   ///< of all of them together
  double shell_thickness = 0;  ///< of open meshes [m]; 0: they are refused
};

/// The touchable bodies of a world. Equal meshes share their field as long as anybody has it, and fields that took long are
/// kept in the user's cache. An open mesh is a solid of the points within half of the shell's thickness. Throws
/// std::invalid_argument for an open mesh without a thickness, for one that its voxels do not resolve, and for fields
/// above their memory. Thread: before a run.
std::vector<Solid> solidsOf(const World& world, const FieldSettings& settings);

}  // namespace presa
