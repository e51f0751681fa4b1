// The user's control of time (pause, step, slow motion), with a view that only counts calls.
#include "apps/common/pacer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "framework/core/schedule/clock.h"

namespace presa {
namespace {

class CountingView final : public View {
 public:
  explicit CountingView(TimeControl& time_control) : View("counting", RateGroup::kView), time_control_(time_control) {}
  void step(const Tick&) noexcept override {}
  bool wantsStop() const noexcept override { return closed; }
  std::uint32_t undosWanted() const noexcept override { return 0; }
  std::uint32_t inputs() const noexcept override { return 0; }
  double sharpness() const noexcept override { return 1; }
  Screenshot screenshot() const override { return {}; }
  std::string videoTrouble() const override { return {}; }
  void setBanner(const std::string&, bool) override {}
  void setScreen(const ParticipantScreen&) override {}
  void setTimings(const std::array<const GroupTiming*, kRateGroupCount>&) noexcept override {}
  void offerPointer(const std::vector<std::size_t>&) override {}
  void offerFrames() override {}
  void offerTime(TimeControl&, double) noexcept override {}
  void drawOnWall(walls::Canvas&) noexcept override {}
  void refresh() noexcept override {
    if (++refreshed == act_at && act != nullptr) act(time_control_, *this);
  }
  int refreshed = 0, act_at = 5;
  bool closed = false;
  void (*act)(TimeControl&, CountingView&) = nullptr;

 private:
  TimeControl& time_control_;
};

struct Held {
  TimeControl time_control;
  RunControl control;
  CountingView counting{time_control};
  View* view = &counting;
  std::function<void(double)> meanwhile;
  Pacer pacer{time_control, view, control, meanwhile};
  void step(double time) { pacer.step({static_cast<std::uint64_t>(time * 60), time, 1.0 / 60}); }
};

// While paused, a step waits for the user and draws meanwhile; it continues on a single step, at the end of the pause,
// or when the window closes.
TEST(Pacer, AHeldRunWaitsForItsUser) {
  for (const auto act : {+[](TimeControl&time_control, CountingView&) { ++time_control.steps; },
                         +[](TimeControl&time_control, CountingView&) { time_control.paused = false; },
                         +[](TimeControl&, CountingView&view) { view.closed = true; }}) {
    Held held;
    held.time_control.paused = true;
    held.counting.act = act;
    held.step(1);
    EXPECT_EQ(held.counting.refreshed, held.counting.act_at);
  }
}

// Commands are read while paused, with and without a window: one of them continues the run.
TEST(Pacer, AHeldRunReadsCommands) {
  for (const bool window : {true, false}) {
    Held held;
    if (!window) held.view = nullptr;
    held.time_control.paused = true;
    int read = 0;
    held.meanwhile = [&](double time) {
      EXPECT_EQ(time, 1);
      if (++read == 5) held.time_control.paused = false;
    };
    held.step(1);
    EXPECT_EQ(read, 5);
  }
}

// Two requested steps are exactly two steps.
TEST(Pacer, MakesAsManyStepsAsWereAskedFor) {
  Held held;
  held.time_control.paused = true;
  held.time_control.steps = 2;
  held.counting.act = [](TimeControl&, CountingView& view) { view.closed = true; };
  held.step(1);
  held.step(2);
  EXPECT_EQ(held.counting.refreshed, 0);
  held.step(3);
  EXPECT_EQ(held.counting.refreshed, held.counting.act_at);
}

// Never faster than requested: 0.1 s at a quarter of the speed take at least 0.4 s, and the window is drawn meanwhile.
TEST(Pacer, SlowMotionTakesItsTime) {
  Held held;
  held.time_control.speed = 0.25;
  const std::int64_t begin = monotonicNs();
  for (int i = 0; i <= 6; ++i) held.step(i / 60.0);
  EXPECT_GE(static_cast<double>(monotonicNs() - begin) * 1e-9, 0.4 - 1e-3);
  EXPECT_GT(held.counting.refreshed, 5);
}

// After a long delay the run does not catch up, but keeps pace again.
TEST(Pacer, DoesNotRunAfterAStall) {
  Held held;
  held.step(0);
  sleepUntilNs(monotonicNs() + 300'000'000);
  held.step(0.01);
  const std::int64_t begin = monotonicNs();
  held.step(0.02);
  held.step(0.06);
  EXPECT_GE(static_cast<double>(monotonicNs() - begin) * 1e-9, 0.04 - 1e-3);
}

std::int64_t virtual_ns = 0;  // the wall's time of the tests below

struct Drawn {
  int pictures = 0;
  double wall = 0, longest_gap = 0;  // [s]
};

// Ten simulated seconds in virtual time; of each step of 1/60 s the picture costs `drawing`, all else `work` [ms].
Drawn drawnIn(int drawing, int work) {
  virtual_ns = 0;
  TimeControl time_control;
  RunControl control;
  View* view = nullptr;
  std::function<void(double)> meanwhile;
  Pacer pacer(time_control, view, control, meanwhile,
              {[]() noexcept { return virtual_ns; }, [](std::int64_t until) noexcept { virtual_ns = until; }});
  Drawn drawn;
  std::int64_t last = 0;
  for (std::uint64_t i = 0; i <= 600; ++i) {
    virtual_ns += work * 1'000'000;
    if (!time_control.skip_picture) {
      drawn.longest_gap = std::max(drawn.longest_gap, static_cast<double>(virtual_ns - last) * 1e-9);
      last = virtual_ns;
      ++drawn.pictures;
      virtual_ns += drawing * 1'000'000;
    }
    pacer.step({i, static_cast<double>(i) / 60, 1.0 / 60});
  }
  drawn.wall = static_cast<double>(virtual_ns) * 1e-9;
  return drawn;
}

// Drawing does not slow a run: its ten seconds take ten, but for the first step before time begins, and the delay of
// the last picture. The time that the work leaves free is drawn in: (10 s - 600 work) / drawing pictures.
TEST(Pacer, LeavesPicturesOutRatherThanTime) {
  for (const auto& [drawing, work] : {std::pair{31, 2}, {60, 5}, {120, 1}, {190, 3}}) {
    const Drawn drawn = drawnIn(drawing, work);
    const double late = (2.0 * drawing + work + 17) * 1e-3;
    EXPECT_LE(drawn.wall, 10 + late) << drawing;
    EXPECT_NEAR(drawn.pictures, (10 - 600 * work * 1e-3) / (drawing * 1e-3), 2 + drawn.pictures * 0.02) << drawing;
    EXPECT_LE(drawn.longest_gap, 0.25 + drawing * 1e-3);
  }
}

// A run that is slower than the clock by itself still shows 4 pictures a second; a fast one shows every step.
TEST(Pacer, ShowsFourPicturesASecondWhereTheRunIsLate) {
  const Drawn slow = drawnIn(40, 20);  // 12 s of work
  EXPECT_GE(slow.pictures, 4 * slow.wall);
  EXPECT_LE(slow.longest_gap, 0.25 + 20e-3);
  EXPECT_EQ(drawnIn(8, 4).pictures, 601);
}

}  // namespace
}  // namespace presa
