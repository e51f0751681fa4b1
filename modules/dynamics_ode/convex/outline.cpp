#include "modules/dynamics_ode/convex/outline.h"

#include <algorithm>
#include <cmath>

namespace presa::ode {
namespace {

constexpr double kSamePlane = 1e-9;      // 1 - cosine
constexpr double kSameDepth = 1e-3;      // in relation to `near`
constexpr std::size_t kBetweenNone = 2;  // contacts of which none is between others

/// Twice the area of a, b, c; positive: counter-clockwise.
template <class Point>
double turn(const Point& a, const Point& b, const Point& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

template <class Point>
double apart(const Point& a, const Point& b) {
  return std::hypot(b.x - a.x, b.y - a.y);
}

}  // namespace

// Convex hull by monotone chain; then corners nearer than `near` to the line between their neighbours go, too.
void Outline::findCorners(double near) {
  std::sort(points_.begin(), points_.end(), [](const Point& a, const Point& b) {
    return a.x < b.x || (a.x == b.x && (a.y < b.y || (a.y == b.y && a.contact < b.contact)));
  });
  corners_.clear();
  std::size_t kept = 0;  // of the side before
  const auto add = [&](const Point& p) {
    while (corners_.size() >= kept + 2 && turn(corners_[corners_.size() - 2], corners_.back(), p) <= 0)
      corners_.pop_back();
    corners_.push_back(p);
  };
  for (const Point& p : points_) add(p);
  kept = corners_.size() - 1;
  for (std::size_t i = points_.size() - 1; i-- > 0;) add(points_[i]);
  corners_.pop_back();  // the first point again
  for (std::size_t i = 0; i < corners_.size() && corners_.size() > 2;) {
    const std::size_t n = corners_.size();
    const Point &a = corners_[(i + n - 1) % n], &b = corners_[(i + 1) % n];
    if (std::abs(turn(a, corners_[i], b)) > near * apart(a, b)) {
      ++i;
    } else {
      corners_.erase(corners_.begin() + static_cast<std::ptrdiff_t>(i));
      i = i > 0 ? i - 1 : 0;
    }
  }
}

bool Outline::inOnePlane(double near) const {
  const Point& a = corners_.front();
  const Point& b = *std::max_element(corners_.begin(), corners_.end(),
                                     [&](const Point& p, const Point& q) { return apart(a, p) < apart(a, q); });
  const Point& c = *std::max_element(corners_.begin(), corners_.end(), [&](const Point& p, const Point& q) {
    return std::abs(turn(a, b, p)) < std::abs(turn(a, b, q));
  });
  const double area = turn(a, b, c), length = apart(a, b);
  if (!(length > near)) return false;
  const bool is_line = std::abs(area) <= near * length;
  return std::all_of(points_.begin(), points_.end(), [&](const Point& p) {
    const double to_b = is_line ? ((p.x - a.x) * (b.x - a.x) + (p.y - a.y) * (b.y - a.y)) / (length * length)
                                : turn(a, p, c) / area,
                 to_c = is_line ? 0 : turn(a, b, p) / area;
    const double depth = a.depth + to_b * (b.depth - a.depth) + to_c * (c.depth - a.depth);
    return std::abs(depth - p.depth) < kSameDepth * near;
  });
}

void Outline::removeFrom(std::vector<BodyContact>& contacts, std::size_t first, std::size_t of, double near) {
  const Vec3 nhat = contacts[of].nhat_AB_W;
  const Vec3 x_W = nhat.unitOrthogonal(), y_W = nhat.cross(x_W);
  points_.clear();
  for (std::size_t i = first; i < contacts.size(); ++i) {
    if (contacts[i].nhat_AB_W.dot(nhat) < 1 - kSamePlane) continue;
    if (i < of) return;  // looked at with an earlier one
    const Vec3& p = contacts[i].p_W;
    points_.push_back({x_W.dot(p), y_W.dot(p), contacts[i].depth, i});
  }
  if (points_.size() <= kBetweenNone) return;
  findCorners(near);
  if (!inOnePlane(near)) return;
  for (const Point& p : points_) contacts[p.contact].B = -1 - contacts[p.contact].B;
  for (const Point& p : corners_) contacts[p.contact].B = -1 - contacts[p.contact].B;
}

void Outline::remove(std::vector<BodyContact>& contacts, std::size_t first, double near) {
  for (std::size_t i = first; i < contacts.size(); ++i) {
    if (contacts[i].B >= 0) removeFrom(contacts, first, i, near);
  }
  const auto begin = contacts.begin() + static_cast<std::ptrdiff_t>(first);
  contacts.erase(std::remove_if(begin, contacts.end(), [](const BodyContact& c) { return c.B < 0; }), contacts.end());
}

}  // namespace presa::ode
