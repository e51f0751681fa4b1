#include "framework/geometry/point_shell.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

#include "framework/core/math/random.h"

namespace presa {
namespace {

using Vec3f = PointShell::Vec3f;

constexpr double kSharpEdge = 0.9;          // cosine between the normals of two faces below which their edge is sharp
constexpr double kPerSpacing = 0.8;         // points that fit into an area of spacing^2
constexpr double kTriedPerPoint = 4;        // candidates
constexpr double kCoarsest = 256;           // points of the first level, about
constexpr std::uint64_t kShellSeed = 1961;  // of the places of candidates

/// A place on the surface that may become a point.
struct ShellCandidate {
  Vec3f p, normal;
};

/// Points already chosen, found by place. Cells share a slot of the table now and then; the distance decides.
class Chosen {
 public:
  Chosen(double spacing, std::size_t capacity)
      : per_cell_(1 / spacing), squared_(static_cast<float>(spacing * spacing)) {
    std::size_t slots = 64;
    while (slots < 2 * capacity) slots *= 2;
    head_.assign(slots, kNone);
    next_.reserve(capacity);
  }
  /// Whether no chosen point is nearer than the spacing. Points that face away from each other do not crowd each other.
  bool hasRoom(const ShellCandidate& one, const std::vector<ShellCandidate>& points) const {
    const Cell cell = cellOf(one.p);
    for (std::int64_t x = -1; x <= 1; ++x) {
      for (std::int64_t y = -1; y <= 1; ++y) {
        for (std::int64_t z = -1; z <= 1; ++z) {
          std::int32_t i = head_[slot({cell[0] + x, cell[1] + y, cell[2] + z})];
          for (; i != kNone; i = next_[static_cast<std::size_t>(i)]) {
            const ShellCandidate& other = points[static_cast<std::size_t>(i)];
            if ((other.p - one.p).squaredNorm() < squared_ && other.normal.dot(one.normal) > 0) return false;
          }
        }
      }
    }
    return true;
  }
  void add(const ShellCandidate& one) {
    const std::size_t at = slot(cellOf(one.p));
    next_.push_back(head_[at]);
    head_[at] = static_cast<std::int32_t>(next_.size()) - 1;
  }

 private:
  static constexpr std::int32_t kNone = -1;
  using Cell = std::array<std::int64_t, 3>;
  Cell cellOf(const Vec3f& p) const {
    Cell cell;
    for (std::size_t a = 0; a < 3; ++a)
      cell[a] = static_cast<std::int64_t>(std::floor(static_cast<double>(p[static_cast<Eigen::Index>(a)]) * per_cell_));
    return cell;
  }
  std::size_t slot(const Cell& cell) const {
    const auto u = [&](std::size_t a) { return static_cast<std::uint64_t>(cell[a]); };
    std::uint64_t h = u(0) * 0x9E3779B97F4A7C15U ^ u(1) * 0xC2B2AE3D27D4EB4FU ^ u(2) * 0x165667B19E3779F9U;
    h ^= h >> 29U;
    return static_cast<std::size_t>(h) & (head_.size() - 1);
  }

  double per_cell_;
  float squared_;
  std::vector<std::int32_t> head_, next_;
};

/// Where candidates are found on one mesh.
class Surface {
 public:
  explicit Surface(const TriMesh& mesh) : mesh_(mesh) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const Vec3 normal = (corner(t, 1) - corner(t, 0)).cross(corner(t, 2) - corner(t, 0));
      area_.push_back(normal.norm() / 2);
      normal_.push_back(normal.normalized());
    }
  }
  double area() const { return std::accumulate(area_.begin(), area_.end(), 0.0); }

  /// First what is sharp, then faces in random order.
  std::vector<ShellCandidate> candidates(double spacing) const {
    std::vector<ShellCandidate> all;
    addSharp(spacing, all);
    const auto first_face = static_cast<std::ptrdiff_t>(all.size());
    addFaces(kTriedPerPoint * kPerSpacing / (spacing * spacing), all);
    RandomStream random(kShellSeed, "point shell order");
    for (std::size_t i = all.size(); i > static_cast<std::size_t>(first_face) + 1; --i)
      std::swap(all[i - 1],
                all[static_cast<std::size_t>(first_face) + random.below(i - static_cast<std::size_t>(first_face))]);
    return all;
  }

 private:
  const Vec3& corner(std::size_t t, std::size_t i) const {
    return mesh_.vertices[static_cast<std::size_t>(mesh_.triangles[t][i])];
  }
  // Ends of sharp edges come before their middles. Each end gets the mean normal of the sharp edges there.
  void addSharp(double spacing, std::vector<ShellCandidate>& all) const {
    std::vector<Vec3> at_corner(mesh_.vertices.size(), Vec3::Zero());
    std::vector<ShellCandidate> middles;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      for (std::size_t i = 0; i < 3; ++i) {
        const std::int32_t other = mesh_.adjacency[t][i];
        if (other < static_cast<std::int32_t>(t)) continue;  // none, or done from the other side
        const Vec3& across = normal_[static_cast<std::size_t>(other)];
        if (normal_[t].dot(across) > kSharpEdge) continue;
        const Vec3 sum = normal_[t] + across;
        const Vec3 normal = sum.norm() > 1e-6 ? Vec3(sum.normalized()) : normal_[t];
        const Vec3 &a = corner(t, i), &b = corner(t, (i + 1) % 3);
        at_corner[static_cast<std::size_t>(mesh_.triangles[t][i])] += normal;
        at_corner[static_cast<std::size_t>(mesh_.triangles[t][(i + 1) % 3])] += normal;
        const int parts = static_cast<int>(std::min(1e6, std::floor((b - a).norm() / spacing)));
        for (int k = 1; k < parts; ++k)
          middles.push_back({(a + (b - a) * k / parts).cast<float>(), normal.cast<float>()});
      }
    }
    for (std::size_t v = 0; v < at_corner.size(); ++v) {
      if (at_corner[v].norm() > 1e-6)
        all.push_back({mesh_.vertices[v].cast<float>(), at_corner[v].normalized().cast<float>()});
    }
    all.insert(all.end(), middles.begin(), middles.end());
  }
  void addFaces(double per_area, std::vector<ShellCandidate>& all) const {
    RandomStream random(kShellSeed, "point shell places");
    double owed = 0;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      for (owed += per_area * area_[t]; owed >= 1; --owed) {
        double u = random.uniform(), v = random.uniform();
        if (u + v > 1) u = 1 - u, v = 1 - v;
        const Vec3 p = corner(t, 0) + u * (corner(t, 1) - corner(t, 0)) + v * (corner(t, 2) - corner(t, 0));
        all.push_back({p.cast<float>(), normal_[t].cast<float>()});
      }
    }
  }

  const TriMesh& mesh_;
  std::vector<double> area_;
  std::vector<Vec3> normal_;
};

/// The planes, each halving the bounding box, in which the mesh is its own mirror image. A tool that is symmetric gets
/// points that are, so that what cancels on the tool cancels on its points.
class Mirrors {
 public:
  explicit Mirrors(const TriMesh& mesh) {
    const AxisBox box = boundsOf(mesh);
    centre_ = (box.low + box.high) / 2;
    const double same = 1e-7 * (box.high - box.low).norm();
    std::vector<std::array<std::int64_t, 3>> known;
    const auto key = [&](const Vec3& v) {
      return std::array{std::llround((v.x() - centre_.x()) / same), std::llround((v.y() - centre_.y()) / same),
                        std::llround((v.z() - centre_.z()) / same)};
    };
    for (const Vec3& v : mesh.vertices) {
      const auto k = key(v);
      known.push_back({k[0], k[1], k[2]});
    }
    std::sort(known.begin(), known.end());
    for (std::size_t axis = 0; axis < 3; ++axis) {
      mirrors_[axis] = std::all_of(known.begin(), known.end(), [&](std::array<std::int64_t, 3> k) {
        k[axis] = -k[axis];
        return isKnown(known, k);
      });
    }
  }
  /// The candidate and its mirror images, each once.
  std::vector<ShellCandidate> imagesOf(const ShellCandidate& one) const {
    std::vector<ShellCandidate> images{one};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!mirrors_[axis]) continue;
      const auto a = static_cast<Eigen::Index>(axis);
      const std::size_t count = images.size();
      for (std::size_t i = 0; i < count; ++i) {
        ShellCandidate image = images[i];
        image.p[a] = static_cast<float>(2 * centre_[a] - static_cast<double>(image.p[a]));
        image.normal[a] = -image.normal[a];
        images.push_back(image);
      }
    }
    for (std::size_t i = 0; i < images.size(); ++i) {
      const auto same = [&](const ShellCandidate& other) {
        return (other.p - images[i].p).norm() < 1e-6F * one.p.norm();
      };
      images.erase(std::remove_if(images.begin() + static_cast<std::ptrdiff_t>(i) + 1, images.end(), same),
                   images.end());
    }
    return images;
  }

 private:
  // rounding may put a coordinate into the next cell
  static bool isKnown(const std::vector<std::array<std::int64_t, 3>>& known, const std::array<std::int64_t, 3>& k) {
    for (std::int64_t x = -1; x <= 1; ++x) {
      for (std::int64_t y = -1; y <= 1; ++y) {
        for (std::int64_t z = -1; z <= 1; ++z) {
          if (std::binary_search(known.begin(), known.end(), std::array{k[0] + x, k[1] + y, k[2] + z})) return true;
        }
      }
    }
    return false;
  }
  Vec3 centre_;
  std::array<bool, 3> mirrors_{};
};

/// Whether all of them have room, and are not in each other's way.
bool allHaveRoom(const std::vector<ShellCandidate>& images, double spacing, const Chosen& index,
                 const std::vector<ShellCandidate>& chosen) {
  const auto apart = static_cast<float>(0.25 * spacing * spacing);  // beside a mirror, pairs may be half as far apart
  for (std::size_t i = 0; i < images.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if ((images[i].p - images[j].p).squaredNorm() < apart && images[i].normal.dot(images[j].normal) > 0) return false;
    }
  }
  return std::all_of(images.begin(), images.end(),
                     [&](const ShellCandidate& one) { return index.hasRoom(one, chosen); });
}

void moveOnto(const PointShell::Exact& exact, std::vector<ShellCandidate>& candidates) {
  for (ShellCandidate& one : candidates) {
    Vec3 p = one.p.cast<double>(), normal = one.normal.cast<double>();
    exact(p, normal);
    one = {p.cast<float>(), normal.cast<float>()};
  }
}

PointShell::Ball ballAround(std::span<const Vec3f> points) {
  Vec3f low = points[0], high = points[0];
  for (const Vec3f& p : points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  PointShell::Ball ball{(low + high) / 2, 0};
  for (const Vec3f& p : points) ball.radius = std::max(ball.radius, (p - ball.center).norm());
  ball.radius *= 1 + 4 * std::numeric_limits<float>::epsilon();
  return ball;
}

std::uint32_t spread(std::uint32_t x) {  // ten bits, two zeros after each
  x = (x | (x << 16U)) & 0x030000FFU;
  x = (x | (x << 8U)) & 0x0300F00FU;
  x = (x | (x << 4U)) & 0x030C30C3U;
  return (x | (x << 2U)) & 0x09249249U;
}

std::uint32_t mortonOf(const Vec3f& p, double radius) {
  const auto bits = [&](float x) {
    return static_cast<std::uint32_t>(std::clamp((static_cast<double>(x) / radius + 1) * 512, 0.0, 1023.0));
  };
  return spread(bits(p.x())) | (spread(bits(p.y())) << 1U) | (spread(bits(p.z())) << 2U);
}

}  // namespace

PointShell::PointShell(const TriMesh& mesh, double spacing, std::size_t max_points, const Exact& exact) {
  const Surface surface(mesh);
  const double area = surface.area();
  spacing =
      std::max(spacing, std::sqrt(kPerSpacing * area / static_cast<double>(std::max<std::size_t>(max_points, 1))));
  radius_ = radiusOf(mesh);
  double coarsest = spacing;
  while (kPerSpacing * area / (coarsest * coarsest) > 4 * kCoarsest) coarsest *= 2;
  const Mirrors mirrors(mesh);
  std::vector<ShellCandidate> left = surface.candidates(spacing), chosen;
  if (exact) moveOnto(exact, left);
  for (double s = coarsest; s > 0.75 * spacing && chosen.size() < max_points; s /= 2) {
    Chosen index(s, left.size());
    for (const ShellCandidate& one : chosen) index.add(one);
    const std::size_t first = chosen.size();
    std::vector<ShellCandidate> rest;
    for (const ShellCandidate& one : left) {
      const std::vector<ShellCandidate> images = mirrors.imagesOf(one);
      if (chosen.size() + images.size() > max_points || !allHaveRoom(images, s, index, chosen)) {
        rest.push_back(one);
        continue;
      }
      for (const ShellCandidate& image : images) {
        index.add(image);
        chosen.push_back(image);
      }
    }
    left.swap(rest);
    std::sort(chosen.begin() + static_cast<std::ptrdiff_t>(first), chosen.end(),
              [&](const ShellCandidate& a, const ShellCandidate& b) {
                return mortonOf(a.p, radius_) < mortonOf(b.p, radius_);
              });
    for (std::size_t i = first; i < chosen.size(); ++i) {
      points_.push_back(chosen[i].p);
      normals_.push_back(chosen[i].normal);
    }
    addLevel(first, s);
  }
  for (const Vec3f& p : points_) radius_ = std::max(radius_, static_cast<double>(p.norm()));
}

void PointShell::addLevel(std::size_t first, double spacing) {
  Level level{.first_group = static_cast<std::uint32_t>(groups_.size()), .spacing = spacing};
  const auto first_block = blocks_.size();
  for (std::size_t p = first; p < points_.size(); p += kBlock) {
    const std::size_t end = std::min(p + kBlock, points_.size());
    blocks_.push_back({ballAround(std::span(points_).subspan(p, end - p)), static_cast<std::uint32_t>(p),
                       static_cast<std::uint32_t>(end)});
  }
  for (std::size_t b = first_block; b < blocks_.size(); b += kGroup) {
    const std::size_t end = std::min(b + kGroup, blocks_.size());
    const std::size_t from = blocks_[b].first, to = blocks_[end - 1].end;
    groups_.push_back({ballAround(std::span(points_).subspan(from, to - from)), static_cast<std::uint32_t>(b),
                       static_cast<std::uint32_t>(end)});
  }
  level.end_group = static_cast<std::uint32_t>(groups_.size());
  level.points = static_cast<std::uint32_t>(points_.size());
  if (points_.size() > first) levels_.push_back(level);
}

std::size_t PointShell::roomBytes() const noexcept {
  return (points_.capacity() + normals_.capacity()) * sizeof(Vec3f) +
         (blocks_.capacity() + groups_.capacity()) * sizeof(Range) + levels_.capacity() * sizeof(Level);
}

}  // namespace presa
