// The solid is cut by planes, each of a face that looks into the deepest hollow (as a binary space partition does),
// until the hull of what is left in every cell fills no hollow. Cells are half spaces, so that no cut needs a new
// surface: the corners of solid and cell are those of the clipped triangles, and corners of the cell inside the
// solid.
#include <algorithm>
#include <cmath>

#include "framework/geometry/closest_point.h"
#include "framework/geometry/convex.h"
#include "framework/geometry/surface_tree.h"

namespace presa {
namespace {

constexpr double kOnPlane = 1e-7;                             // in relation to the size of the mesh
constexpr std::size_t kSamples = 300;                         // patches of a cell that are looked at
constexpr std::size_t kCandidates = 10;                       // planes that are tried for a cut
constexpr std::size_t kHullVertices = 160;                    // of a cell, while it is cut
constexpr std::size_t kFewVertices = kMaxPieceFaces / 2 + 2;  // a hull of so many has no more faces (Euler)
constexpr double kLess = 1 - 1e-6;                            // volume left by a cut that takes a hollow away
constexpr double kUneven = 0.3;       // what an unfinished part costs, by its share of the surface squared
constexpr double kShareOfMean = 0.3;  // surface of a piece worth a cut of its own, by the mean of those still possible

struct Plane {
  Vec3 nhat = Vec3::UnitX();
  double offset = 0;
};

/// The part of a triangle within a cell.
struct Patch {
  std::vector<Vec3> corners;
  std::size_t triangle = 0;
};

struct Cell {
  std::vector<Patch> patches;
  std::vector<Plane> cuts;    // the cell is behind all of them
  std::vector<Vec3> corners;  // of the cell, where three cuts meet
  std::vector<Vec3> points;   // of the solid in the cell
  TriMesh hull;
  double volume = 0, hollow = 0;  // of the hull
  double area = 0;                // of the patches
  struct Deep {
    double hollow;
    std::size_t patch;
    Vec3 p;
  };
  std::vector<Deep> deep;  // deepest first
};

Plane planeOf(const TriMesh& mesh, std::size_t t) {
  const auto corner = [&](std::size_t i) { return mesh.vertices[static_cast<std::size_t>(mesh.triangles[t][i])]; };
  const Vec3 nhat = (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
  return {nhat, nhat.dot(corner(0))};
}

Vec3 centreOf(const std::vector<Vec3>& points) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

double areaOf(const std::vector<Vec3>& corners) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    sum += (corners[i] - corners[0]).cross(corners[i + 1] - corners[0]);
  return sum.norm() / 2;
}

/// Patches share their corners.
void dropEqual(std::vector<Vec3>& points) {
  std::sort(points.begin(), points.end(), [](const Vec3& a, const Vec3& b) {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  });
  points.erase(std::unique(points.begin(), points.end()), points.end());
}

class Cutter {
 public:
  Cutter(const TriMesh& mesh, double max_error) : mesh_(mesh), tree_(mesh), max_error_(max_error) {
    const AxisBox bounds = boundsOf(mesh);
    size_ = (bounds.high - bounds.low).norm();
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) planes_.push_back(planeOf(mesh, t));
  }

  std::optional<Cell> whole() const;
  /// The parts of a cell by the best of some planes; none when no plane divides it. A plane that finishes at least
  /// `min_share` of the cell's surface comes first.
  std::vector<Cell> cut(const Cell& cell, double min_share) const;
  bool isFinished(const Cell& cell) const { return cell.hollow <= max_error_; }

 private:
  std::vector<Cell> partsBy(const Cell& cell, const Plane& plane) const;
  bool measure(Cell& cell) const;
  double hollowAt(const std::vector<Plane>& hull, const Vec3& p, const Vec3& nhat) const;
  std::vector<Plane> candidates(const Cell& cell) const;
  std::optional<Cell> part(const Cell& cell, const Plane& plane) const;
  void addCorners(Cell& cell, const Cell& of) const;
  std::optional<Patch> clipped(const Patch& patch, const Plane& plane) const;

  const TriMesh& mesh_;
  const SurfaceTree tree_;
  const double max_error_;
  double size_ = 0;
  std::vector<Plane> planes_;  // by triangle
};

std::optional<Cell> Cutter::whole() const {
  Cell cell;
  for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
    Patch patch{{}, t};
    for (const std::int32_t v : mesh_.triangles[t])
      patch.corners.push_back(mesh_.vertices[static_cast<std::size_t>(v)]);
    cell.patches.push_back(std::move(patch));
  }
  if (!measure(cell)) return std::nullopt;
  return cell;
}

/// How far the hull reaches beyond the surface at p: out of the hull, or half way to the surface across the hollow.
double Cutter::hollowAt(const std::vector<Plane>& hull, const Vec3& p, const Vec3& nhat) const {
  double out = 1e300;
  for (const Plane& plane : hull) {
    const double along = plane.nhat.dot(nhat);
    if (along > 0) out = std::min(out, (plane.offset - plane.nhat.dot(p)) / along);
  }
  if (!(out > kOnPlane * size_)) return 0;
  const double across = tree_.firstHit(p + kOnPlane * size_ * nhat, nhat, out);
  return across < out ? across / 2 : out;
}

/// Hull and hollows of a new cell. False when there is nothing of the solid in it.
bool Cutter::measure(Cell& cell) const {
  cell.points.clear();
  for (const Patch& patch : cell.patches) cell.area += areaOf(patch.corners);
  for (const Patch& patch : cell.patches)
    cell.points.insert(cell.points.end(), patch.corners.begin(), patch.corners.end());
  for (const Vec3& corner : cell.corners) {
    if (tree_.isInside(corner)) cell.points.push_back(corner);
  }
  dropEqual(cell.points);
  std::optional<TriMesh> hull = convexHull(cell.points, kHullVertices);
  if (!hull) return false;
  cell.hull = std::move(*hull);
  cell.volume = massProperties(cell.hull).volume;
  std::vector<Plane> hull_planes;
  for (std::size_t t = 0; t < cell.hull.triangles.size(); ++t) hull_planes.push_back(planeOf(cell.hull, t));
  const std::size_t stride = 1 + cell.patches.size() / kSamples;
  for (std::size_t i = 0; i < cell.patches.size(); i += stride) {
    const Patch& patch = cell.patches[i];
    const Vec3 centre = centreOf(patch.corners), &nhat = planes_[patch.triangle].nhat;
    Cell::Deep deepest{hollowAt(hull_planes, centre, nhat), i, centre};
    for (const Vec3& corner : patch.corners) {
      const Vec3 p = 0.9 * corner + 0.1 * centre;
      const double hollow = hollowAt(hull_planes, p, nhat);
      if (hollow > deepest.hollow) deepest = {hollow, i, p};
    }
    cell.hollow = std::max(cell.hollow, deepest.hollow);
    if (deepest.hollow > max_error_) cell.deep.push_back(deepest);
  }
  std::stable_sort(cell.deep.begin(), cell.deep.end(),
                   [](const Cell::Deep& a, const Cell::Deep& b) { return a.hollow > b.hollow; });
  return true;
}

/// The part of a patch behind a plane. One in the plane is on the side on which its solid is.
std::optional<Patch> Cutter::clipped(const Patch& patch, const Plane& plane) const {
  const double on_plane = kOnPlane * size_;
  Patch kept{{}, patch.triangle};
  bool behind = false, flat = true;
  for (std::size_t i = 0; i < patch.corners.size(); ++i) {
    const Vec3 &p = patch.corners[i], &q = patch.corners[(i + 1) % patch.corners.size()];
    const double at_p = plane.nhat.dot(p) - plane.offset, at_q = plane.nhat.dot(q) - plane.offset;
    behind = behind || at_p < -on_plane;
    flat = flat && std::abs(at_p) <= on_plane;
    if (at_p <= on_plane) kept.corners.push_back(p);
    const bool crosses = (at_p > on_plane && at_q < -on_plane) || (at_p < -on_plane && at_q > on_plane);
    if (crosses) kept.corners.push_back(p + at_p / (at_p - at_q) * (q - p));
  }
  if (flat) behind = planes_[patch.triangle].nhat.dot(plane.nhat) > 0;
  if (!behind || kept.corners.size() < 3) return std::nullopt;
  return kept;
}

/// Corners of the cell: those of the cell it is part of, and those on its last cut.
void Cutter::addCorners(Cell& cell, const Cell& of) const {
  const double on_plane = kOnPlane * size_;
  const auto in_cell = [&](const Vec3& p) {
    return std::all_of(cell.cuts.begin(), cell.cuts.end(),
                       [&](const Plane& cut) { return cut.nhat.dot(p) <= cut.offset + on_plane; });
  };
  for (const Vec3& corner : of.corners) {
    if (in_cell(corner)) cell.corners.push_back(corner);
  }
  const Plane& last = cell.cuts.back();
  for (std::size_t i = 0; i + 1 < cell.cuts.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Plane &a = cell.cuts[i], &b = cell.cuts[j];
      const Vec3 across = a.nhat.cross(b.nhat);
      const double volume = last.nhat.dot(across);
      if (std::abs(volume) < 1e-9) continue;
      const Vec3 p =
          (last.offset * across + a.offset * b.nhat.cross(last.nhat) + b.offset * last.nhat.cross(a.nhat)) / volume;
      if (in_cell(p)) cell.corners.push_back(p);
    }
  }
}

std::optional<Cell> Cutter::part(const Cell& cell, const Plane& plane) const {
  Cell part;
  for (const Patch& patch : cell.patches) {
    if (std::optional<Patch> kept = clipped(patch, plane)) part.patches.push_back(std::move(*kept));
  }
  part.cuts = cell.cuts;
  part.cuts.push_back(plane);
  addCorners(part, cell);
  if (!measure(part)) return std::nullopt;
  return part;
}

/// Planes of faces at the deepest hollows.
std::vector<Plane> Cutter::candidates(const Cell& cell) const {
  std::vector<Plane> planes;
  for (const Cell::Deep& deep : cell.deep) {
    if (planes.size() == kCandidates) break;
    const Plane& plane = planes_[cell.patches[deep.patch].triangle];
    const auto same = [&](const Plane& p) {
      return p.nhat.dot(plane.nhat) > 1 - 1e-6 && std::abs(p.offset - plane.offset) < 1e-4 * size_;
    };
    if (std::none_of(planes.begin(), planes.end(), same)) planes.push_back(plane);
  }
  return planes;
}

/// The parts on both sides of a plane; one where the plane takes only a hollow away; none where it changes nothing.
std::vector<Cell> Cutter::partsBy(const Cell& cell, const Plane& plane) const {
  std::vector<Cell> parts;
  for (const Plane& side : {plane, Plane{-plane.nhat, -plane.offset}}) {
    if (std::optional<Cell> one = part(cell, side)) parts.push_back(std::move(*one));
  }
  if (parts.size() == 1 && parts[0].volume > kLess * cell.volume) parts.clear();
  return parts;
}

/// A face whose plane finishes a piece comes first, as long as pieces of that size are few enough; among others a plane
/// that takes hollows away and leaves parts of one size.
std::vector<Cell> Cutter::cut(const Cell& cell, double min_share) const {
  std::vector<Cell> best, finishing;
  double best_score = 1e300, most_finished = 0;
  const auto look = [&](const Plane& plane) {
    std::vector<Cell> parts = partsBy(cell, plane);
    if (parts.empty()) return;
    double score = 0, finished = 0, share_finished = 0;
    for (const Cell& one : parts) {
      const double share = one.area / cell.area;
      score += one.volume / cell.volume;
      if (isFinished(one)) {
        finished += one.volume;
        share_finished += share;
      } else {
        score += kUneven * share * share;
      }
    }
    if (share_finished >= min_share && finished > (1 + 1e-9) * most_finished) {
      most_finished = finished;
      finishing = parts;
    }
    if (score >= best_score - 1e-9) return;
    best_score = score;
    best = std::move(parts);
  };
  for (const Plane& plane : candidates(cell)) look(plane);
  if (!finishing.empty()) return finishing;
  const AxisBox bounds = boundsOf(cell.hull);
  for (int axis = 0; axis < 3; ++axis) look({Vec3::Unit(axis), (bounds.low[axis] + bounds.high[axis]) / 2});
  return best;
}

/// Coplanar triangles counted once.
std::size_t facesOf(const TriMesh& hull) {
  std::vector<Plane> faces;
  for (std::size_t t = 0; t < hull.triangles.size(); ++t) {
    const Plane plane = planeOf(hull, t);
    const auto same = [&](const Plane& p) { return p.nhat.dot(plane.nhat) > 1 - 1e-10; };
    if (std::none_of(faces.begin(), faces.end(), same)) faces.push_back(plane);
  }
  return faces.size();
}

TriMesh pieceOf(const Cell& cell) {
  const std::optional<TriMesh> whole = convexHull(cell.points);
  return facesOf(*whole) <= kMaxPieceFaces ? *whole : *convexHull(cell.points, kFewVertices);
}

}  // namespace

std::vector<TriMesh> decompose(const TriMesh& mesh, std::size_t max_pieces, double max_error, const GoOn& go_on) {
  const Cutter cutter(mesh, max_error);
  std::vector<Cell> cells, done;
  if (std::optional<Cell> whole = cutter.whole()) cells.push_back(std::move(*whole));
  while (!cells.empty()) {
    double area = 0;
    for (const Cell& cell : cells) area += cell.area;
    const auto deepest =
        std::max_element(cells.begin(), cells.end(), [](const Cell& a, const Cell& b) { return a.hollow < b.hollow; });
    Cell cell = std::move(*deepest);
    cells.erase(deepest);
    const std::size_t pieces = cells.size() + done.size() + 1;
    if (go_on && !go_on(static_cast<double>(pieces) / static_cast<double>(std::max(max_pieces, pieces)))) return {};
    std::vector<Cell> parts;
    if (!cutter.isFinished(cell) && pieces < max_pieces) {
      const double its_pieces = static_cast<double>(max_pieces - done.size()) * cell.area / area;
      parts = cutter.cut(cell, kShareOfMean / its_pieces);
    }
    if (parts.empty()) {
      done.push_back(std::move(cell));
      continue;
    }
    for (Cell& part : parts) cells.push_back(std::move(part));
  }
  std::vector<TriMesh> pieces;
  for (const Cell& cell : done) pieces.push_back(pieceOf(cell));
  return pieces;
}

namespace {

template <class Look>
void forEachSample(const TriMesh& mesh, Look look) {
  for (const Vec3& v : mesh.vertices) look(v);
  for (const TriMesh::Triangle& t : mesh.triangles) {
    const auto corner = [&](std::size_t i) { return mesh.vertices[static_cast<std::size_t>(t[i])]; };
    look((corner(0) + corner(1) + corner(2)) / 3);
    for (std::size_t i = 0; i < 3; ++i) {
      if (t[i] < t[(i + 1) % 3]) look((corner(i) + corner((i + 1) % 3)) / 2);
    }
  }
}

/// A convex mesh, to measure from.
struct Piece {
  explicit Piece(const TriMesh& mesh) : tree(mesh) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) planes.push_back(planeOf(mesh, t));
  }
  bool holds(const Vec3& p) const {
    return std::all_of(planes.begin(), planes.end(),
                       [&](const Plane& plane) { return plane.nhat.dot(p) <= plane.offset; });
  }
  SurfaceTree tree;
  std::vector<Plane> planes;
};

}  // namespace

double hausdorffDistance(const TriMesh& mesh, const std::vector<TriMesh>& pieces) {
  if (pieces.empty()) return 0;
  const std::vector<Piece> all(pieces.begin(), pieces.end());
  double largest = 0;  // squared
  forEachSample(mesh, [&](const Vec3& p) {
    if (std::any_of(all.begin(), all.end(), [&](const Piece& piece) { return piece.holds(p); })) return;
    double nearest = 1e300;
    for (const Piece& piece : all) nearest = piece.tree.squaredDistance(p, nearest);
    largest = std::max(largest, nearest);
  });
  const SurfaceTree tree(mesh);
  for (const TriMesh& piece : pieces) {
    forEachSample(piece, [&](const Vec3& p) {
      if (tree.isInside(p)) return;
      largest = std::max(largest, tree.squaredDistance(p, 1e300));
    });
  }
  return std::sqrt(largest);
}

}  // namespace presa
