// A finger between two free bodies: each receives its own part of the reaction.
#include "tests/modules/dynamics_ode/support.h"

namespace presa::ode {
namespace {

// Two cubes in free space, pushed apart by one fingertip with 0.5 N down and 0.4 N sideways each, for 20 ms: Newton's
// second law. The implicit spring yields by h^2 k / m as the cubes move within a step, here 0.05 %.
TEST(SharedFinger, EachBodyGetsItsOwnPart) {
  constexpr double kMass = 50, kStiffness = 1000, kTime = 0.02;
  WorldMaker maker;
  maker.gravity(Vec3::Zero()).friction(0);
  maker.box({0.05, 0.05, 0.05}, kMass, {{-0.03, 0, -0.025}, Quat::Identity()});
  maker.box({0.05, 0.05, 0.05}, kMass, {{0.03, 0, -0.025}, Quat::Identity()});
  Runner runner(maker.world());
  const Vec3 on_left(0.4, 0, 0.5), on_right(-0.4, 0, 0.5);  // forces of the bodies on the finger
  for (int n = 0; n < std::lround(kTime / kStep); ++n) {
    ContactExchange exchange(1, 2);
    exchange.time = runner.time;
    FingerContact& contact = exchange.fingers[0];
    contact.mode = ContactMode::kSlip;
    contact.stiffness = kStiffness;
    contact.body = 0;
    contact.p_WP = Vec3(0, 0, 0.00624);
    contact.p_WH = contact.p_WP - (on_left + on_right) / kStiffness;
    contact.contact_count = 2;
    for (const std::int32_t body : {0, 1}) {
      const Pose& X_WB = runner[static_cast<std::size_t>(body)].X_WB_end;
      const Vec3 force = body == 0 ? on_left : on_right;
      exchange.contacts.add({.body = body,
                             .p_BP = X_WB.inverseTimes(contact.p_WP),
                             .p_WP = contact.p_WP,
                             .nhat_B = X_WB.q.conjugate() * force.normalized(),
                             .stretch_W = force / kStiffness,
                             .stiffness = kStiffness,
                             .mode = ContactMode::kSlip,
                             .tangential_ratio = 0.5});
    }
    contact.p_BP = contact.p_BC = exchange.contacts[0].p_BP;
    contact.nhat_B = exchange.contacts[0].nhat_B;
    runner.step(exchange);
    EXPECT_NEAR((runner.bodies.fingerForce(0) + on_left + on_right).norm(), 0, 0.01);
  }
  EXPECT_NEAR((kMass * runner[0].v_WB + on_left * kTime).norm(), 0, 0.01 * 0.64 * kTime);
  EXPECT_NEAR((kMass * runner[1].v_WB + on_right * kTime).norm(), 0, 0.01 * 0.64 * kTime);
}

// A fingertip in a groove of two cubes slides along it at 0.1 m/s, its friction on the rough one alone: of the two, only
// that one is taken along, with mu f_n. Same tolerance.
TEST(SharedFinger, EachBodyGetsItsOwnFriction) {
  constexpr double kMass = 50, kStiffness = 1000, kTime = 0.02, kMu = 0.5, kNormalForce = 1;
  for (const std::int32_t rough : {0, 1}) {
    WorldMaker maker;
    maker.gravity(Vec3::Zero()).friction(0);
    maker.box({0.05, 0.05, 0.05}, kMass, {{0.03, 0, -0.025}, Quat::Identity()});
    maker.box({0.05, 0.05, 0.05}, kMass, {{-0.03, 0, 0.03}, Quat::Identity()});
    Runner runner(maker.world());
    for (int n = 0; n < std::lround(kTime / kStep); ++n) {
      ContactExchange exchange(1, 2);
      exchange.time = runner.time;
      FingerContact& contact = exchange.fingers[0];
      contact = {.mode = ContactMode::kSlip, .body = 0, .v_WH = Vec3(0, 0.1, 0), .stiffness = kStiffness};
      contact.contact_count = 2;
      for (const std::int32_t body : {0, 1}) {
        const Pose& X_WB = runner[static_cast<std::size_t>(body)].X_WB_end;
        const Vec3 nhat = body == 0 ? Vec3::UnitZ() : Vec3::UnitX();
        const double mu = body == rough ? kMu : 0;
        exchange.contacts.add({.body = body,
                               .p_BP = X_WB.inverseTimes(contact.p_WP),
                               .p_WP = contact.p_WP,
                               .nhat_B = X_WB.q.conjugate() * nhat,
                               .v_WH = contact.v_WH,
                               .stretch_W = (kNormalForce * nhat - mu * kNormalForce * Vec3::UnitY()) / kStiffness,
                               .stiffness = kStiffness,
                               .mode = ContactMode::kSlip,
                               .friction_static = mu,
                               .friction_dynamic = mu,
                               .tangential_ratio = 0.5});
      }
      runner.step(exchange);
    }
    for (const std::int32_t body : {0, 1}) {
      const double given = kMass * runner[static_cast<std::size_t>(body)].v_WB.y();
      EXPECT_NEAR(given, body == rough ? kMu * kNormalForce * kTime : 0, 0.01 * kMu * kNormalForce * kTime)
          << rough << body;
    }
  }
}

}  // namespace
}  // namespace presa::ode
