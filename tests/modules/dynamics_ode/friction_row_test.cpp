#include <cmath>
#include <utility>

#include "modules/dynamics_ode/finger_constraint.h"
#include "tests/modules/dynamics_ode/support.h"

// The tangential rows of a friction law with a stiffness and a damping of its own.
namespace presa::ode {
namespace {

constexpr double kK = 1000, kNormal = 2, kForce = 0.5;  // [N/m], [N], [N]

/// A contact that presses with kNormal along -z and whose law renders `force` along x at the sample, `damped` of it by
/// damping.
FingerContact contactOf(double ratio, double damping, double force, double damped) {
  FingerContact contact;
  contact.mode = ContactMode::kStick;
  contact.body = 0;
  contact.stiffness = kK;
  contact.friction_static = contact.friction_dynamic = 10;
  contact.tangential_ratio = ratio;
  contact.tangential_damping = damping;
  contact.damped_W = Vec3(damped / kK, 0, 0);
  contact.p_WH = Vec3(0, 0, -kNormal / kK);
  contact.p_WP = contact.p_BP = Vec3(force / kK, 0, 0);
  return contact;
}

/// Force along x on the finger when the body moves with `v` along x and the finger with `v_WH`, from the row
/// t . v+ + slip f = motion.
double forceOf(const FingerContact& contact, double v, double h) {
  const auto row = makeFingerConstraint(contact, Vec3::Zero(), {}, 0, 0.02, h);
  EXPECT_TRUE(row);
  const Vec3 t2 = row->n_in.cross(row->t1), velocity(v, 0, 0);
  const double f_1 = (row->motion_1 - row->t1.dot(velocity)) / row->slip;
  const double f_2 = (row->motion_2 - t2.dot(velocity)) / row->slip;
  return -(f_1 * row->t1 + f_2 * t2).x();
}

// Backward Euler by hand: the displacement grows by h (v_P - v_H), where P moves with the body. Rounding alone.
TEST(FrictionRow, ContinuesTheRenderedForceWithTheLawsStiffnessAndDamping) {
  for (const double h : {0.005, 0.001}) {
    for (const double ratio : {0.25, 1.0, 3.0}) {
      for (const double damping : {0.0, 4.0}) {
        FingerContact contact = contactOf(ratio, damping, kForce, damping > 0 ? 0.2 : 0.0);
        const double elastic = kForce - (damping > 0 ? 0.2 : 0.0);
        for (const double v_H : {0.0, 0.02}) {
          contact.v_WH = Vec3(v_H, 0, 0);
          for (const double v_P : {0.0, -0.03, 0.05}) {
            const double expected = elastic + (h * ratio * kK + damping) * (v_P - v_H);
            EXPECT_NEAR(forceOf(contact, v_P, h), expected, 1e-9) << ratio << " " << damping << " " << v_P;
          }
        }
      }
    }
  }
}

// The normal row in the same way: k times the depth at the end of the step, and d times the closing velocity.
TEST(FingerRow, IsSpringAndDamperAtTheEndOfTheStep) {
  for (const double h : {0.005, 0.001}) {
    for (const double damping : {0.0, 3.0}) {
      FingerContact contact = contactOf(1, 0, 0, 0);
      contact.damping = damping;
      for (const double v_H : {0.0, 0.02}) {
        contact.v_WH = Vec3(0, 0, -v_H);
        const auto row = makeFingerConstraint(contact, Vec3::Zero(), {}, 0, 0.02, h);
        ASSERT_TRUE(row);
        for (const double v_P : {0.0, -0.03, 0.05}) {  // along -z, into the body
          const double f = (row->erp / h * row->depth + row->motion_n - row->n_in.dot(Vec3(0, 0, -v_P))) / row->cfm;
          EXPECT_NEAR(f, kNormal + (h * kK + damping) * (v_H - v_P), 1e-9) << h << " " << damping << " " << v_P;
        }
      }
    }
  }
}

TEST(FrictionRow, IsBoundedByTheFrictionOfItsMode) {
  FingerContact contact = contactOf(1, 0, kForce, 0);
  contact.friction_static = 0.8;
  contact.friction_dynamic = 0.3;
  for (const auto& [mode, mu] : {std::pair(ContactMode::kStick, 0.8), std::pair(ContactMode::kSlip, 0.3)}) {
    contact.mode = mode;
    const auto row = makeFingerConstraint(contact, Vec3::Zero(), {}, 0, 0.02, 0.005);
    ASSERT_TRUE(row);
    EXPECT_EQ(row->mu, mu);
    EXPECT_EQ(row->mu_dynamic, 0.3);
  }
}

TEST(FrictionRow, OfAViscousLawIsDampingAlone) {
  const FingerContact contact = contactOf(0, 5, kForce, kForce);
  EXPECT_NEAR(forceOf(contact, 0.04, 0.005), 5 * 0.04, 1e-9);
  EXPECT_NEAR(forceOf(contact, 0, 0.005), 0, 1e-9);
}

TEST(FrictionRow, OfALawWithoutStiffnessAndDampingIsFrictionless) {
  const auto row = makeFingerConstraint(contactOf(0, 0, 0, 0), Vec3::Zero(), {}, 0, 0.02, 0.005);
  ASSERT_TRUE(row);
  EXPECT_EQ(row->mu, 0);
  EXPECT_TRUE(std::isfinite(row->slip));
}

TEST(FrictionRow, OfAContactThatIsNoNumberIsRefused) {
  FingerContact contact = contactOf(1, 0, kForce, 0);
  EXPECT_TRUE(isUsable(contact));
  contact.tangential_ratio = std::nan("");
  EXPECT_FALSE(isUsable(contact));
  contact = contactOf(1, -1, kForce, 0);
  EXPECT_FALSE(isUsable(contact));
}

}  // namespace
}  // namespace presa::ode
