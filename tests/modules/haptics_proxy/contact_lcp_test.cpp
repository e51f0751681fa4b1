// The contact problem against its own definition: complementarity is checked, not the way to it.
#include "framework/haptics/contact_lcp.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace presa::contact_lcp_test {
namespace {

Vec6 rowOf(const PressedPoint& one) {
  Vec6 row;
  row << one.nhat, one.p.cross(one.nhat);
  return row;
}

class Random {
 public:
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  Vec3 inCube(double half) { return {between(-half, half), between(-half, half), between(-half, half)}; }

 private:
  std::mt19937 engine_{11};
};

ContactProblem problemOf(Random& random) {
  ContactProblem problem;
  problem.k = std::pow(10.0, random.between(3, 7));
  problem.Q.setZero();
  for (int i = 0; i < 8; ++i) {
    Vec6 v;
    v << 30 * random.inCube(1), random.inCube(1);
    problem.Q += v * v.transpose();
  }
  problem.Q.diagonal() += (Vec6() << 100, 100, 100, 0.1, 0.1, 0.1).finished();
  problem.r << random.inCube(10), random.inCube(0.5);
  return problem;
}

void expectSolved(const ContactProblem& problem, const BoundedList<PressedPoint>& contacts, const Vec6& u, int trial) {
  Vec6 left = problem.Q * u - problem.r;
  for (const PressedPoint& one : contacts) {
    left -= one.force * rowOf(one);
    const double slack = rowOf(one).dot(u) + one.gap + one.force / problem.k;
    EXPECT_GE(one.force, 0) << trial;
    EXPECT_GE(slack, -2e-12) << trial;
    EXPECT_NEAR(one.force > 0 ? slack : 0, 0, 2e-12) << trial;
  }
  EXPECT_LT(left.norm(), 2e-12 * problem.k + 1e-9 * problem.r.norm()) << trial;
}

TEST(ContactLcp, SolvesRandomProblemsExactly) {
  Random random;
  int most = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const ContactProblem problem = problemOf(random);
    BoundedList<PressedPoint> contacts(40);
    for (int i = 0; i < trial % 41; ++i)
      contacts.add(
          {.p = random.inCube(0.05), .nhat = random.inCube(1).normalized(), .gap = random.between(-0.001, 0.003)});
    Vec6 u = Vec6::Zero();
    const Pivots pivots = solveContacts(problem, contacts, u);
    ASSERT_TRUE(pivots.exact) << trial;
    most = std::max(most, pivots.count);
    expectSolved(problem, contacts, u, trial);
  }
  std::printf("at most %d pivots\n", most);
}

// Many points on one face bear alike: the problem has one solution even where a rigid one has many.
TEST(ContactLcp, FourCornersOfAFaceBearAlike) {
  BoundedList<PressedPoint> contacts(8);
  for (const double x : {-0.02, 0.02}) {
    for (const double y : {-0.02, 0.02}) contacts.add({.p = {x, y, -0.01}, .nhat = Vec3::UnitZ(), .gap = 0});
  }
  ContactProblem problem;
  problem.Q.diagonal() << 1000, 1000, 1000, 1, 1, 1;
  problem.r << 0, 0, -2, 0, 0, 0;
  problem.k = 200000;
  Vec6 u = Vec6::Zero();
  EXPECT_TRUE(solveContacts(problem, contacts, u).exact);
  for (const PressedPoint& one : contacts) EXPECT_NEAR(one.force, 0.5 * 800000 / 801000, 1e-9);
}

}  // namespace
}  // namespace presa::contact_lcp_test
