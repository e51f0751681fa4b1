#include <gtest/gtest.h>

#include "experiments/faults/fault.h"
#include "framework/session/realtime_rights.h"
#include "tests/support/effort.h"

namespace presa::faults {
namespace {

// What a rating promises a hand in wall time: the force is zero within 20 ms of any fault. Rows of real processes are
// tested against this, also under sanitizers and on a shared machine; `presa device faults` holds their own bounds.
constexpr double kPromised = 20e-3;  // [s]

Fault tested(Fault fault) {
  if (fault.real_time) fault.bounds.detection = fault.bounds.zero = kPromised;
  return fault;
}

class Faults : public testing::TestWithParam<std::size_t> {};

TEST_P(Faults, KeepTheirBounds) {
  const Fault fault = tested(allFaults()[GetParam()]);
  if (fault.real_time && !realtimeRights().fifo.empty()) GTEST_SKIP() << "SCHED_FIFO: " << realtimeRights().fifo;
  for (std::uint64_t run = 0; run < unlessSanitized<std::uint64_t>(6, 2); ++run) {
    RandomStream random(1000, fault.name, run);
    const Outcome outcome = fault.run(random);
    EXPECT_EQ(brokenBy(fault, outcome), "")
        << fault.name << ", run " << run << ": zero at " << outcome.zero << " s, step " << outcome.step << " N";
  }
}

INSTANTIATE_TEST_SUITE_P(Rows, Faults, testing::Range<std::size_t>(0, allFaults().size()));

constexpr double kStall = 0.03;  // of a supervisor that is late by itself, beyond what is promised [s]

/// A run is repeated if the machine ran nobody for as long as the stall exceeds the bound, or if it held up the program
/// so that the supervisor began to stall before the fault: neither shows how late this supervisor is.
Outcome telling(const Fault& fault) {
  Outcome outcome;
  for (std::uint64_t run = 0; run < 20; ++run) {
    RandomStream random(1000, fault.name, run);
    outcome = fault.run(random);
    if (outcome.held_up_detection < kStall - kPromised && outcome.detection > kStall) break;
  }
  return outcome;
}

// A supervisor that is late by itself is not excused: its witness was not held up.
TEST(ProcessFaults, AStallingSupervisorBreaksItsRow) {
  if (!realtimeRights().fifo.empty()) GTEST_SKIP() << "SCHED_FIFO: " << realtimeRights().fifo;
  for (const Fault& row : processFaults(kStall)) {
    const Fault fault = tested(row);
    const Outcome outcome = telling(fault);
    EXPECT_EQ(brokenBy(fault, outcome), "detected too late") << fault.name << ": " << outcome.detection;
    EXPECT_GT(outcome.detection, kStall);
  }
}

// Time in which the machine ran nobody makes the bounds longer by just that.
TEST(FaultJudge, GivesTheMachineItsTime) {
  const Fault fault{0, "", "", {.detection = 0.003, .zero = 0.005, .energy = true}, {}};
  Outcome late;
  late.detection = 0.0049;
  late.zero = 0.0069;
  EXPECT_EQ(brokenBy(fault, late), "detected too late");
  late.held_up_detection = late.held_up_zero = 0.002;
  EXPECT_EQ(brokenBy(fault, late), "");
  late.zero = 0.0071;
  EXPECT_EQ(brokenBy(fault, late), "zero too late");
}

// The judge reports each kind of violation.
TEST(FaultJudge, FindsWhatIsBroken) {
  const Fault fault{0, "", "", {.detection = 0.003, .zero = 0.005, .energy = true}, {}};
  Outcome good;
  good.detection = 0.003;
  good.zero = 0.005;
  good.step = 1;
  good.energy = good.energy_allowed = 1e-6;
  EXPECT_EQ(brokenBy(fault, good), "");
  Outcome bad = good;
  bad.step = 1.001;
  EXPECT_EQ(brokenBy(fault, bad), "force step above the slew limit");
  bad = good;
  bad.detection = -1;
  EXPECT_EQ(brokenBy(fault, bad), "detected too late");
  bad = good;
  bad.zero = 0.0051;
  EXPECT_EQ(brokenBy(fault, bad), "zero too late");
  bad = good;
  bad.energy = 2e-6;
  EXPECT_EQ(brokenBy(fault, bad), "energy given to the hand");
}

}  // namespace
}  // namespace presa::faults
