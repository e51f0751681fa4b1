// Separating axis test with Gauss maps and clipping (Gregorius, "Robust contact creation for physics simulations",
// GDC 2013). A face wins over a pair of edges unless the edges are separated by kPrefer more: faces give several points,
// and their normals do not jump.
#include "framework/geometry/convex_contact/manifold.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "framework/geometry/convex_contact/nearest.h"
#include "framework/geometry/index.h"

namespace presa {
namespace {

constexpr double kPrefer = 1e-4;         // in relation to the smaller hull
constexpr double kKeep = 5e-3;           // the same, of the axis of the step before
constexpr double kOblique = 1e-4;        // 1 - cosine between a face and the way to a round body beside it
constexpr double kParallelEdges = 1e-6;  // squared sine of edges that span no plane
constexpr double kThrough = 1e-7;        // distance from a hull's centre of an edge through it, in relation to the hull
constexpr std::size_t kMaxPolygon = 64;
constexpr std::size_t kFewCorners = 32;  // to which the outline of a face with more than kMaxPolygon is thinned
constexpr double kSameGap = 1e-6;        // of contacts, whatever the size of the hulls [m]

double sizeOf(const Hull& hull) { return (hull.vertices.front() - hull.centre).norm() + hull.radius; }

struct FaceAxis {
  std::size_t face = 0;
  double gap = -1e300;
};

FaceAxis separateByFaces(const Hull& A, const Hull& B) {
  FaceAxis best;
  for (std::size_t f = 0; f < A.faces.size(); ++f) {
    double lowest = 1e300;
    for (const Vec3& v : B.vertices) lowest = std::min(lowest, A.faces[f].nhat.dot(v));
    const double gap = lowest - A.faces[f].offset;
    if (gap > best.gap) best = {f, gap};
  }
  return best;
}

struct EdgeAxis {
  const Hull::Edge *a = nullptr, *b = nullptr;
  Vec3 nhat = Vec3::Zero();  // from A into B
  double gap = -1e300;
};

Vec3 along(const Hull& hull, const Hull::Edge& edge) {
  return hull.vertices[index(edge.to)] - hull.vertices[index(edge.from)];
}

/// By edge and face: along(edge) . normal of the other hull's face.
void project(const Hull& edges, const Hull& faces, std::vector<double>& out) {
  out.resize(edges.edges.size() * faces.faces.size());
  std::size_t next = 0;
  for (const Hull::Edge& edge : edges.edges) {
    const Vec3 d = along(edges, edge);
    for (const Hull::Face& face : faces.faces) out[next++] = d.dot(face.nhat);
  }
}

}  // namespace

// The arcs of two edges on the Gauss map of A - B cross: only such pairs make a face of it. A segment's arc is the great
// circle square to it.
bool ManifoldMaker::makesFace(const Hull& A, const Hull& B, std::size_t a, std::size_t b) const {
  const Hull::Edge &ea = A.edges[a], &eb = B.edges[b];
  const auto a_on = [&](std::int32_t face) { return -a_on_b_[a * B.faces.size() + index(face)]; };
  const auto b_on = [&](std::int32_t face) { return b_on_a_[b * A.faces.size() + index(face)]; };
  if (ea.left < 0 && eb.left < 0) return true;
  if (eb.left < 0) return b_on(ea.left) * b_on(ea.right) < 0;
  const double cba = a_on(eb.left), dba = a_on(eb.right);
  if (ea.left < 0) return cba * dba < 0;
  if (cba * dba >= 0) return false;
  const double adc = b_on(ea.left), bdc = b_on(ea.right);
  return adc * bdc < 0 && cba * bdc > 0;
}

namespace {

EdgeAxis axisOf(const Hull& A, const Hull& B, const Hull::Edge& a, const Hull::Edge& b) {
  Vec3 normal = A.directions[index(a.direction)].cross(B.directions[index(b.direction)]);
  const double sine = normal.squaredNorm();
  if (sine < kParallelEdges) return {};
  normal /= std::sqrt(sine);
  const Vec3& p_a = A.vertices[index(a.from)];
  double outward = normal.dot(p_a - A.centre);
  if (std::abs(outward) < kThrough * sizeOf(A)) outward = normal.dot(B.centre - A.centre);
  if (outward < 0) normal = -normal;
  return {&a, &b, normal, normal.dot(B.vertices[index(b.from)] - p_a)};
}

// A cylinder may have had another stand-in in the step before, with other faces and edges.
bool isOf(const ContactAxis& axis, const Hull& A, const Hull& B) {
  using Kind = ContactAxis::Kind;
  if (axis.kind == Kind::kFaceOfA) return index(axis.a) < A.faces.size();
  if (axis.kind == Kind::kFaceOfB) return index(axis.b) < B.faces.size();
  return axis.kind == Kind::kEdges && index(axis.a) < A.edges.size() && index(axis.b) < B.edges.size();
}

double faceGap(const Hull& A, const Hull& B, std::int32_t face) {
  double lowest = 1e300;
  for (const Vec3& v : B.vertices) lowest = std::min(lowest, A.faces[index(face)].nhat.dot(v));
  return lowest - A.faces[index(face)].offset;
}

struct Polygon {
  std::array<Vec3, kMaxPolygon> points;
  std::size_t count = 0;
  void add(const Vec3& p) {
    if (count < kMaxPolygon) points[count++] = p;
  }
};

/// Keeps what lies behind the plane nhat . p <= offset.
void clip(Polygon& polygon, const Vec3& nhat, double offset) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const Vec3 &p = polygon.points[i], &q = polygon.points[(i + 1) % polygon.count];
    const double at_p = nhat.dot(p) - offset, at_q = nhat.dot(q) - offset;
    if (at_p <= 0) kept.add(p);
    if (at_p * at_q < 0) kept.add(p + at_p / (at_p - at_q) * (q - p));
  }
  polygon = kept;
}

std::size_t faceAlong(const Hull& hull, const Vec3& nhat) {
  const auto less = [&](const Hull::Face& a, const Hull::Face& b) { return a.nhat.dot(nhat) < b.nhat.dot(nhat); };
  return static_cast<std::size_t>(std::max_element(hull.faces.begin(), hull.faces.end(), less) - hull.faces.begin());
}

/// Every so many corners of a face stand for all.
std::size_t strideOf(const Hull::Face& face) {
  return face.loop.size() > kMaxPolygon ? (face.loop.size() + kFewCorners - 1) / kFewCorners : 1;
}

/// The outline of the face along `nhat`; of a segment or point, itself.
Polygon outlineAlong(const Hull& hull, const Vec3& nhat) {
  Polygon polygon;
  if (hull.faces.empty()) {
    for (const Vec3& v : hull.vertices) polygon.add(v);
    return polygon;
  }
  const Hull::Face& face = hull.faces[faceAlong(hull, nhat)];
  for (std::size_t i = 0; i < face.loop.size(); i += strideOf(face)) polygon.add(hull.vertices[index(face.loop[i])]);
  return polygon;
}

/// kMaxPoints of many points, among them the deepest, the one farthest from it, and the two that make the largest area
/// with these.
void reduce(std::array<Manifold::Point, kMaxPolygon>& points, std::size_t& count, const Vec3& nhat, double same_depth) {
  if (count <= Manifold::kMaxPoints) return;
  const Vec3 along = nhat.unitOrthogonal();
  const auto take = [&](std::size_t place, auto score) {
    std::size_t best = place;
    for (std::size_t i = place; i < count; ++i) {
      if (score(points[i]) > score(points[best])) best = i;
    }
    std::swap(points[place], points[best]);
  };
  const Vec3 origin = points[0].p_W;
  // among points of nearly one depth a fixed direction decides, so that the choice does not flicker
  take(0, [&](const Manifold::Point& x) {
    return -std::floor(x.gap / same_depth) * 1e3 + along.dot(x.p_W - origin) / (1 + (x.p_W - origin).norm());
  });
  const Vec3 p = points[0].p_W;
  take(1, [&](const Manifold::Point& x) { return (x.p_W - p).squaredNorm(); });
  const Vec3 side = nhat.cross(points[1].p_W - p);
  take(2, [&](const Manifold::Point& x) { return side.dot(x.p_W - p); });
  take(3, [&](const Manifold::Point& x) { return -side.dot(x.p_W - p); });
  count = Manifold::kMaxPoints;
}

/// Adds the points in which the faces along `nhat`, from `reference` into `other`, cover each other as seen along it.
/// `sign`: +1 where the reference is A. Points in `out` are kept if they are the deepest.
void clipAlong(const Hull& reference, const Hull& other, const Vec3& nhat, double margin, double sign, Manifold& out) {
  const Hull::Face& face = reference.faces[faceAlong(reference, nhat)];
  Polygon polygon = outlineAlong(other, -nhat);
  const std::size_t stride = strideOf(face);
  for (std::size_t i = 0; i < face.loop.size() && polygon.count > 0; i += stride) {
    const Vec3& p = reference.vertices[index(face.loop[i])];
    const Vec3& q = reference.vertices[index(face.loop[i + stride < face.loop.size() ? i + stride : 0])];
    const Vec3 outward = (q - p).cross(nhat);
    clip(polygon, outward, outward.dot(p));
  }
  std::array<Manifold::Point, kMaxPolygon> points;
  auto count = static_cast<std::size_t>(out.count);
  std::copy_n(out.points.begin(), count, points.begin());
  const double radii = reference.radius + other.radius, slant = face.nhat.dot(nhat);
  for (std::size_t i = 0; i < polygon.count && count < kMaxPolygon; ++i) {
    const double above = (face.nhat.dot(polygon.points[i]) - face.offset) / slant;
    if (above - radii > margin) continue;
    points[count++] = {polygon.points[i] - (above + other.radius - reference.radius) / 2 * nhat, above - radii};
  }
  reduce(points, count, nhat, 1e-4 * std::min(sizeOf(reference), sizeOf(other)));
  out.nhat_AB_W = sign * nhat;
  out.count = static_cast<int>(count);
  std::copy_n(points.begin(), count, out.points.begin());
}

void setPoint(const Vec3& on_a, const Vec3& on_b, double radius_a, double radius_b, double margin, const Vec3& nhat,
              Manifold& out) {
  const double apart = nhat.dot(on_b - on_a), gap = apart - radius_a - radius_b;
  if (gap > margin) return;
  out.nhat_AB_W = nhat;
  out.points[0] = {(on_a + radius_a * nhat + on_b - radius_b * nhat) / 2, gap};
  out.count = 1;
}

/// Two segments or points with radii.
void collideRound(const Hull& A, const Hull& B, double margin, Manifold& out) {
  const auto [on_a, on_b] = nearestOf(A.vertices.front(), A.vertices.back(), B.vertices.front(), B.vertices.back());
  const Vec3 apart = on_b - on_a;
  const Vec3 nhat = apart.norm() > 1e-12 ? Vec3(apart.normalized()) : Vec3::UnitZ();
  const Vec3 a = A.vertices.back() - A.vertices.front(), b = B.vertices.back() - B.vertices.front();
  const double lengths = a.squaredNorm() * b.squaredNorm();
  if (!(lengths > 0) || a.cross(b).squaredNorm() > kParallelEdges * lengths)
    return setPoint(on_a, on_b, A.radius, B.radius, margin, nhat, out);
  // lying along each other: the ends of the stretch that they share
  const double from_b = (B.vertices.front() - A.vertices.front()).dot(a), to_b = from_b + b.dot(a);
  Manifold both;
  for (const double s : {std::max(0.0, std::min(from_b, to_b)), std::min(a.squaredNorm(), std::max(from_b, to_b))}) {
    const Vec3 p = A.vertices.front() + std::clamp(s / a.squaredNorm(), 0.0, 1.0) * a;
    setPoint(p, closestOnSegment(p, B.vertices.front(), B.vertices.back()), A.radius, B.radius, margin, nhat, out);
    if (out.count == 1) both.points[static_cast<std::size_t>(both.count++)] = out.points[0];
    out.count = 0;
  }
  both.nhat_AB_W = nhat;
  out = both;
}

// A round body outside a polyhedron touches it with one point, at the end of the shortest way to its core. False where a
// segment lies along a face, and thus touches with more points.
bool besideFaces(const Hull& A, const Hull& B, const Vec3& nhat_face, double margin, Manifold& out) {
  Vec3 on_a, on_b;
  const bool apart = A.faces.empty() ? nearestOutside(B, A, on_b, on_a) : nearestOutside(A, B, on_a, on_b);
  if (!apart) return false;
  const Vec3 nhat = (on_b - on_a).normalized();
  const bool is_sphere = (A.faces.empty() ? A : B).vertices.size() == 1;
  if (!is_sphere && std::abs(nhat.dot(nhat_face)) > 1 - kOblique) return false;
  setPoint(on_a, on_b, A.radius, B.radius, margin, nhat, out);
  return true;
}

double leastGap(const Manifold& manifold) {
  double gap = 1e300;
  for (int i = 0; i < manifold.count; ++i) gap = std::min(gap, manifold.points[static_cast<std::size_t>(i)].gap);
  return gap;
}

/// Two segments or points with radii: the nearest points, and the ends of the stretch along which they lie side by side.
void touchRound(const Hull& A, const Hull& B, const Vec3& on_a, const Vec3& on_b, double margin, Manifold& out) {
  const auto add = [&](const Vec3& p, const Vec3& q, double gap) {
    if (gap <= margin) out.points[static_cast<std::size_t>(out.count++)] = {(p + q) / 2, gap};
  };
  const double gap = out.nhat_AB_W.dot(on_b - on_a);
  const Vec3 &a = A.vertices.front(), along = A.vertices.back() - a;
  const double length = along.squaredNorm();
  const bool are_segments = length > 0 && B.vertices.size() > 1;
  for (std::size_t i = 0; are_segments && i < B.vertices.size(); ++i) {
    const Vec3& end = B.vertices[i];
    const Vec3 p = a + std::clamp((end - a).dot(along) / length, 0.0, 1.0) * along;
    const Vec3 q = closestOnSegment(p, B.vertices.front(), B.vertices.back());
    add(p, q, (q - p).norm() - A.radius - B.radius);
  }
  if (leastGap(out) > gap + kSameGap) add(on_a, on_b, gap);
}

}  // namespace

void touchAlong(const Hull& A, const Hull& B, const Vec3& nhat_AB_W, const Vec3& on_a, const Vec3& on_b, double margin,
                Manifold& out) noexcept {
  out.count = 0;
  out.nhat_AB_W = nhat_AB_W;
  const bool a_is_round = A.faces.empty(), b_is_round = B.faces.empty();
  const double gap = nhat_AB_W.dot(on_b - on_a);
  if (a_is_round && b_is_round) return touchRound(A, B, on_a, on_b, margin, out);
  const auto along = [&](const Hull& hull, const Vec3& nhat) {
    return hull.faces[faceAlong(hull, nhat)].nhat.dot(nhat);
  };
  const double of_a = a_is_round ? -1 : along(A, nhat_AB_W), of_b = b_is_round ? -1 : along(B, -nhat_AB_W);
  const bool oblique = (a_is_round || b_is_round) && std::max(of_a, of_b) < 1 - kOblique;
  if (oblique) return setPoint(on_a, on_b, 0, 0, margin, nhat_AB_W, out);
  if (of_a >= of_b) {
    clipAlong(A, B, nhat_AB_W, margin, 1, out);
  } else {
    clipAlong(B, A, -nhat_AB_W, margin, -1, out);
  }
  // faces that do not cover each other at the nearest points
  if (gap > margin || leastGap(out) <= gap + std::min(kSameGap, kPrefer * std::min(sizeOf(A), sizeOf(B)))) return;
  if (out.count < Manifold::kMaxPoints) ++out.count;
  out.points[static_cast<std::size_t>(out.count) - 1] = {(on_a + on_b) / 2, gap};
}

// The best pair of edges.
void ManifoldMaker::separateByEdges(const Hull& A, const Hull& B, EdgePair& best) const {
  for (std::size_t a = 0; a < A.edges.size(); ++a) {
    for (std::size_t b = 0; b < B.edges.size(); ++b) {
      if (!makesFace(A, B, a, b)) continue;
      const EdgeAxis axis = axisOf(A, B, A.edges[a], B.edges[b]);
      if (axis.gap <= best.gap) continue;
      best = {static_cast<std::int32_t>(a), static_cast<std::int32_t>(b), axis.nhat, axis.gap};
    }
  }
}

Separation ManifoldMaker::separate(const Hull& A, const Hull& B) {
  const double radii = A.radius + B.radius;
  if (A.faces.empty() && B.faces.empty()) {
    const auto [on_a, on_b] = nearestOf(A.vertices.front(), A.vertices.back(), B.vertices.front(), B.vertices.back());
    const double apart = (on_b - on_a).norm();
    return {apart > 0 ? Vec3((on_b - on_a) / apart) : Vec3::UnitZ(), apart - radii};
  }
  const FaceAxis a = separateByFaces(A, B), b = separateByFaces(B, A);
  Separation best;
  if (a.gap > b.gap) {
    best = {A.faces[a.face].nhat, a.gap};
  } else {
    best = {-B.faces[b.face].nhat, b.gap};
  }
  if (best.gap < radii) {
    project(A, B, a_on_b_);
    project(B, A, b_on_a_);
    EdgePair edges;
    separateByEdges(A, B, edges);
    if (edges.gap > best.gap) best = {edges.nhat, edges.gap};
    Vec3 on_a, on_b;
    if (radii > 0 && best.gap > 0 &&
        (A.faces.empty() ? nearestOutside(B, A, on_b, on_a) : nearestOutside(A, B, on_a, on_b))) {
      best = {(on_b - on_a).normalized(), (on_b - on_a).norm()};
    }
  }
  best.gap -= radii;
  return best;
}

void ManifoldMaker::collide(const Hull& A, const Hull& B, double margin, ContactAxis& memory, Manifold& out) {
  using Kind = ContactAxis::Kind;
  ContactAxis before = std::exchange(memory, {});
  if (!isOf(before, A, B)) before = {};
  out.count = 0;
  const double radii = A.radius + B.radius;
  if (A.faces.empty() && B.faces.empty()) return collideRound(A, B, margin, out);
  const FaceAxis a = separateByFaces(A, B);
  if (a.gap - radii > margin) return;
  const FaceAxis b = separateByFaces(B, A);
  if (b.gap - radii > margin) return;
  project(A, B, a_on_b_);
  project(B, A, b_on_a_);
  EdgePair edges;
  separateByEdges(A, B, edges);
  if (edges.gap - radii > margin) return;
  const double size = std::min(sizeOf(A), sizeOf(B)), face_gap = std::max(a.gap, b.gap);
  if (radii > 0 && face_gap > 0) {
    const Vec3& nhat = a.gap > b.gap ? A.faces[a.face].nhat : B.faces[b.face].nhat;
    if (besideFaces(A, B, nhat, margin, out)) return;
  }
  memory = {Kind::kFaceOfA, static_cast<std::int32_t>(a.face), 0};
  if (b.gap > a.gap + kPrefer * size) memory = {Kind::kFaceOfB, 0, static_cast<std::int32_t>(b.face)};
  if (edges.gap > face_gap + kPrefer * size) memory = {Kind::kEdges, edges.a, edges.b};
  const double enough = std::max(face_gap, edges.gap) - kKeep * size;
  if (before.kind == Kind::kFaceOfA && faceGap(A, B, before.a) > enough) memory = before;
  if (before.kind == Kind::kFaceOfB && faceGap(B, A, before.b) > enough) memory = before;
  if (before.kind == Kind::kEdges && makesFace(A, B, index(before.a), index(before.b)) &&
      axisOf(A, B, A.edges[index(before.a)], B.edges[index(before.b)]).gap > enough) {
    memory = before;
  }
  if (memory.kind == Kind::kFaceOfA) return clipAlong(A, B, A.faces[index(memory.a)].nhat, margin, 1, out);
  if (memory.kind == Kind::kFaceOfB) return clipAlong(B, A, B.faces[index(memory.b)].nhat, margin, -1, out);
  const Hull::Edge &ea = A.edges[index(memory.a)], &eb = B.edges[index(memory.b)];
  const Vec3 nhat = axisOf(A, B, ea, eb).nhat;
  const auto [on_a, on_b] = nearestOf(A.vertices[index(ea.from)], A.vertices[index(ea.to)], B.vertices[index(eb.from)],
                                      B.vertices[index(eb.to)]);
  setPoint(on_a, on_b, A.radius, B.radius, margin, nhat, out);
  if (A.faces.empty()) return clipAlong(B, A, -nhat, margin, -1, out);
  clipAlong(A, B, nhat, margin, 1, out);
}

}  // namespace presa
