// A sheet of paper holds like a wall: no fingertip gets through, from any side, over edges and corners, fast and deep.
//
// Criteria, in coordinates of the plate, by closed forms of a box:
// - the fingertip never overlaps the plate;
// - it never changes sides unless a path round the plate exists. A god-object moves downhill towards the HIP. If both
//   lie over the
//   plate's face (within its outline), downhill leads along the face and never past its edge, so a proxy on the other
//   side afterwards
//   went through. The same holds when a whole approach stays over the face.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "framework/geometry/rotation_between.h"
#include "tests/modules/haptics_proxy/surface/support/finger_rig.h"
#include "tests/modules/haptics_proxy/surface/support/shapes.h"

namespace presa::test {
namespace {

constexpr double kSide = 0.12, kDepth = 0.1, kPeriod = 1e-3;

struct Approach {
  Vec3 aim, direction;  ///< a point of the plate's surface, and the direction of the HIP's motion, to 100 mm beyond it
  double before = 0;    ///< length of the path before `aim`, so that the fingertip starts free [m]
};

struct Count {
  int approaches = 0, through = 0, overlapping = 0, popped = 0;
  int not_free = 0;    ///< starts that the free fingertip did not reach
  double deepest = 0;  ///< largest overlap [m]
};

class Plate {
 public:
  Plate(double thickness, double radius, double speed, bool moving, std::uint64_t seed)
      : half_(kSide / 2, kSide / 2, thickness / 2),
        speed_(speed),
        moving_(moving),
        random_(seed),
        rig_(std::make_shared<const TriMesh>(cutBox(2 * half_, 1)), {.radius = radius, .fixed = !moving}) {}

  Count approach(int times) {
    Count count;
    for (int i = 0; i < times; ++i) {
      const Approach one = random();
      comeTo(one.aim - one.before * one.direction, count);
      push(one, count);
      ++count.approaches;
    }
    count.popped = static_cast<int>(rig_.all().pop_through);
    return count;
  }

 private:
  double uniform(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random_); }
  Vec3 direction() {
    std::normal_distribution<double> normal;
    const double x = normal(random_), y = normal(random_), z = normal(random_);
    return Vec3(x, y, z).normalized();
  }

  /// Half of the approaches aim at a face, a quarter at its edges, the rest at its corners and narrow sides.
  Approach random() {
    Approach approach;
    const double which = uniform(0, 1), up = uniform(0, 1) < 0.5 ? -1 : 1;
    approach.aim = {uniform(-half_.x(), half_.x()), uniform(-half_.y(), half_.y()), up * half_.z()};
    if (which > 0.5) approach.aim.x() = std::copysign(half_.x(), approach.aim.x());
    if (which > 0.75) approach.aim.y() = std::copysign(half_.y(), approach.aim.y());
    if (which > 0.9) approach.aim.z() = uniform(-half_.z(), half_.z());
    // inwards: opposite to the outward direction at the aim
    const Vec3 outwards(which > 0.5 ? std::copysign(1, approach.aim.x()) : 0,
                        which > 0.75 ? std::copysign(1, approach.aim.y()) : 0, which > 0.9 ? 0 : up);
    do {
      approach.direction = direction();
    } while (approach.direction.dot(outwards) > -0.1 * outwards.norm() ||
             (which <= 0.75 && approach.direction.z() * up > -0.1));
    if (uniform(0, 1) < 0.2) approach.direction = {0, 0, -up};  // head-on
    const double free = rig_.touch().radius + 0.1e-3 + uniform(0, speed_ * kPeriod);
    while (distance(approach.aim - approach.before * approach.direction) < free) approach.before += 0.1e-3;
    return approach;
  }

  /// Moves far from the plate, round it, and to the start, with a collision query in every tick and the plate at rest.
  void comeTo(const Vec3& start, Count& count) {
    constexpr double kAbove = 0.3;
    pose_ = {};
    const Vec3 above = last_P_ + Vec3(0, 0, std::copysign(kAbove, last_P_.z()));
    rig_.place(above);
    if (moving_) rig_.moveBody({}, {}, Vec3::Zero());
    const Vec3 begin = (Vec3(above.x() * 0.1, above.y() * 0.1, above.z())).normalized() * kAbove;
    const Vec3 end = start.normalized() * kAbove;
    const Quat turn = rotationBetween(begin, end);
    for (int i = 0; i <= 6; ++i) rig_.place(Quat::Identity().slerp(i / 6.0, turn) * begin);
    proxy_ = rig_.place(start).p_WP;
    if ((proxy_ - start).norm() > 1e-9) ++count.not_free;
  }

  void push(const Approach& one, Count& count) {
    const double way = kDepth + one.before, stride = speed_ * kPeriod;
    const Vec3 start = one.aim - one.before * one.direction;
    bool through = false, overlapping = false;
    const int ticks = static_cast<int>(std::ceil(way / stride)) + 2;
    if (moving_) {
      while (!rig_.atDynamicsStep()) rig_.place(start);
    }
    for (int i = 1; i <= ticks; ++i) {
      // the same relative motion: either the finger moves in or the plate moves towards it
      const auto gone = [&](double steps) { return std::min(steps * stride, way); };
      Vec3 h_P = start + gone(i) * one.direction, h_W = h_P;
      if (moving_) {
        h_W = start;
        const auto poseAfter = [&](double steps) { return Pose{-gone(steps) * one.direction, Quat::Identity()}; };
        if (rig_.atDynamicsStep()) {
          begin_ = poseAfter(i - 1);
          end_ = poseAfter(i + 4);
          step_ = i - 1;
          rig_.moveBody(begin_, end_, -speed_ * one.direction);
        }
        pose_ = interpolate(begin_, end_, (i - 1 - step_) / 5.0);
        h_P = pose_.inverseTimes(h_W);
      }
      const Vec3 before = proxy_;
      proxy_ = pose_.inverseTimes(rig_.tick(h_W).p_WP);
      judge(before, proxy_, h_P, through, overlapping, count.deepest);
    }
    count.through += through;
    count.overlapping += overlapping;
    last_P_ = proxy_;
  }

  /// Distance from the plate; negative inside.
  double distance(const Vec3& p) const {
    const Vec3 beyond = p.cwiseAbs() - half_;
    const double outside = beyond.cwiseMax(Vec3::Zero()).norm();
    return outside > 0 ? outside : beyond.maxCoeff();
  }
  /// Whether p is over a face rather than at a narrow side, along which a fingertip may move down; margin 0.1 um, the
  /// lift of a point.
  bool over(const Vec3& p) const { return std::abs(p.x()) < half_.x() - 1e-7 && std::abs(p.y()) < half_.y() - 1e-7; }

  void judge(const Vec3& before, const Vec3& after, const Vec3& h, bool& through, bool& overlapping, double& deepest) {
    const double overlap = rig_.touch().radius - distance(after);
    deepest = std::max(deepest, overlap);
    // 1 % of the radius: above any relative tolerance; 0.1 um for a point
    if (!(overlap <= std::max(1e-7, 0.01 * rig_.touch().radius))) overlapping = true;
    if (over(before) && over(h) && before.z() * after.z() < 0) through = true;
  }

  const Vec3 half_;
  const double speed_;
  const bool moving_;
  std::mt19937_64 random_;
  FingerRig rig_;
  Pose pose_, begin_, end_;
  int step_ = 0;
  Vec3 proxy_ = Vec3::Zero(), last_P_{0, 0, 0.3};
};

void expectNoneThrough(double radius) {
  constexpr int kEach = 1250;  // 10 000 per radius
  std::uint64_t seed = 1;
  for (const double thickness : {0.5e-3, 0.05e-3}) {
    for (const double speed : {1.0, 3.0}) {
      for (const bool moving : {false, true}) {
        SCOPED_TRACE(testing::Message() << "radius " << radius * 1e3 << " mm, plate of " << thickness * 1e3 << " mm, "
                                        << speed << " m/s, " << (moving ? "plate" : "finger") << " moves, seed "
                                        << seed);
        const Count count = Plate(thickness, radius, speed, moving, seed++).approach(kEach);
        EXPECT_EQ(count.through, 0) << "of " << count.approaches;
        EXPECT_EQ(count.overlapping, 0) << "of " << count.approaches << ", deepest " << count.deepest * 1e6 << " um";
        EXPECT_EQ(count.popped, 0);
        EXPECT_EQ(count.not_free, 0);
      }
    }
  }
}

TEST(ThinPlate, HoldsAPoint) { expectNoneThrough(0); }
TEST(ThinPlate, HoldsATipOfATenthOfAMillimetre) { expectNoneThrough(0.1e-3); }
TEST(ThinPlate, HoldsATipOfOneMillimetre) { expectNoneThrough(1e-3); }
TEST(ThinPlate, HoldsATipOfEightMillimetres) { expectNoneThrough(8e-3); }
TEST(ThinPlate, HoldsATipOfFifteenMillimetres) { expectNoneThrough(15e-3); }

}  // namespace
}  // namespace presa::test
