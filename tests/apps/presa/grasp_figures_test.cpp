#include "apps/common/grasp_figures.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "apps/common/losses.h"
#include "apps/common/report/report.h"
#include "apps/common/summary.h"
#include "apps/common/terminal/closing.h"
#include "apps/common/terminal/status_line.h"
#include "apps/common/verdict.h"
#include "tests/framework/record/monitor/synthetic_run.h"

namespace presa {
namespace {

using test::Feed;
using test::pinchWorld;

/// A grasp: 1 s on the table, 3 s held 0.1 m up and turned by 0.5 rad (or `turn`), then loosening: 4 N falling by 2
/// N/s, slip below 1.197 N.
struct Grasp {
  Feed feed{6, 4.0, 250};
  RunResult result;

  explicit Grasp(double wobble = 0, double turn = 0.5) {
    for (int i = 0; i < 6000; ++i) showTick(i, wobble, turn);
    result.world = feed.world;
    result.phases = {{"lift", 0, 1, PhaseIntent::kLift},
                     {"hold", 1, 4, PhaseIntent::kHold},
                     {"loosen", 4, 6, PhaseIntent::kRelease}};
    takeMonitor(feed.monitor, result);
  }

  void showTick(int i, double wobble, double turn) {
    const double t = i * 1e-3;
    const bool up = t >= 1;
    const Pose X_WB{Vec3(0, 0, up ? 0.135 : 0.035), Quat(Eigen::AngleAxisd(up ? turn : 0.0, Vec3::UnitX()))};
    feed.objects.bodies[1].X_WB_begin = feed.objects.bodies[1].X_WB_end = X_WB;
    ++feed.version;
    // ripple of exactly 2 % peak to peak over the mean, visible at every trace sample of 4 ms
    const double grip = t < 4 ? 4 * (1 + 0.01 * ((i / 4) % 2 == 0 ? 1 : -1)) : std::max(0.0, 4 - 2 * (t - 4));
    for (std::size_t f = 0; f < 2; ++f) {
      const ContactMode mode = grip <= 0               ? ContactMode::kNone
                               : t > 4 && grip < 1.197 ? ContactMode::kSlip
                                                       : ContactMode::kStick;
      feed.touch(f, mode, grip, f == 0 ? 0.75 * 0.981 : 1.25 * 0.981);
      const Vec3 p_BP(f == 0 ? -0.043 : 0.043, 0, 0.01 + (i % 8 == 0 ? wobble : 0));
      feed.contact.fingers[f].p_WP = X_WB * p_BP;
    }
    feed.tick();
  }
};

// Every figure of a grasp with known answers, on an object that turns while it is lifted.
TEST(GraspFigures, MatchAGraspThatIsKnownExactly) {
  const Grasp grasp;
  const auto figures = graspFigures(grasp.result);
  ASSERT_TRUE(figures);
  ASSERT_EQ(figures->fingers.size(), 2u);
  // means of 750 samples and a rotation there and back: a few hundred roundings of numbers near 1
  EXPECT_NEAR(figures->lift_height, 0.1, 1e-12);
  EXPECT_NEAR(figures->held_in_stick, 3.0, 1e-12);
  EXPECT_NEAR(figures->slip_limit, 0.2 * 9.81 / (2 * 0.8), 1e-12);
  ASSERT_TRUE(figures->turn);
  EXPECT_NEAR(figures->turn->object, 0.5, 1e-12);  // about the line between the fingers
  EXPECT_NEAR(figures->turn->hand, 0, 1e-12);
  EXPECT_NEAR(figures->turn->sideways, 0, 1e-15);
  EXPECT_NEAR(figures->fingers[0].weight_share, 0.75, 1e-12);
  EXPECT_NEAR(figures->fingers[1].weight_share, 1.25, 1e-12);
  for (const FingerGrasp& finger : figures->fingers) {
    EXPECT_EQ(finger.stick_fraction, 1);
    EXPECT_LT(finger.offset_range, 1e-15);
    ASSERT_TRUE(finger.grip_ripple);
    EXPECT_NEAR(*finger.grip_ripple, 0.02, 1e-12);
    ASSERT_TRUE(finger.slip);
    // 4 - 2 (t - 4) is below 1.197 N from the tick at 5.402 s on, between two trace samples: resolved at the haptic
    // rate
    EXPECT_NEAR(finger.slip->time, 5.402, 1e-12);
    EXPECT_NEAR(finger.slip->normal_force, 1.196, 1e-12);
    // the trace's sample before 5.402 s - 5 ms is that at 5.396 s, 1.208 N
    EXPECT_NEAR(finger.slip_step, 0.012, 1e-12);
  }
}

// The offset is measured in the object's coordinates: creep of a finger shows, whatever the motion of the object.
TEST(GraspFigures, OffsetRangeShowsCreepOnTheObject) {
  const Grasp grasp(2e-5);
  EXPECT_NEAR(graspFigures(grasp.result)->fingers[0].offset_range, 2e-5, 1e-15);
}

// Without a phase that holds there are no figures, and the summary has no such key.
TEST(GraspFigures, NeedAHold) {
  Grasp grasp;
  grasp.result.phases.erase(grasp.result.phases.begin() + 1);
  EXPECT_FALSE(graspFigures(grasp.result));
  EXPECT_FALSE(nlohmann::json::parse(summaryJson(grasp.result)).contains("grasp"));
}

// Scripts read these keys: names, units and nulls must not change.
TEST(Summary, KeepsItsKeys) {
  Grasp grasp;
  GroupTiming haptic;
  haptic.ticks = 6000;
  haptic.execution.add(12'000);
  grasp.result.rates = {{RateGroup::kHaptic, 1000, &haptic}};
  grasp.result.faults = {{1.5, "thumb: \"lost\""}};
  const auto json = nlohmann::json::parse(summaryJson(grasp.result));
  EXPECT_EQ(json["scene"], "pinch");
  EXPECT_EQ(json["mode"], "lockstep");
  EXPECT_EQ(json["duration_s"], 6.0);
  EXPECT_EQ(json["rates"]["haptic"]["ticks"], 6000);
  EXPECT_EQ(json["rates"]["haptic"]["execution_us"]["max"], 12.0);
  EXPECT_TRUE(json["rates"]["haptic"]["lateness_us"].is_null());
  EXPECT_TRUE(json["rates"]["haptic"]["period_us"].is_null());
  ASSERT_EQ(json["contact_points"].size(), 2u);
  EXPECT_EQ(json["contact_points"][1]["name"], "index");
  EXPECT_NEAR(json["contact_points"][0]["seconds"]["slip"].get<double>(), 0.598, 1e-9);  // ticks 5.402 … 5.999 s
  EXPECT_EQ(json["contact_points"][0]["pop_through"], 0);
  ASSERT_EQ(json["objects"].size(), 1u) << "free bodies only";
  EXPECT_EQ(json["objects"][0]["grasped"], true);
  EXPECT_EQ(json["objects"][0]["dropped"], false);
  EXPECT_EQ(json["faults"][0]["what"], "thumb: \"lost\"");
  EXPECT_EQ(json["state_hash"].get<std::string>().size(), 18u);
  EXPECT_FALSE(json.contains("recording"));
  EXPECT_EQ(json["grasp"]["fingers"].size(), 2u);
}

// A name from a scene file is text, never markup, and the page contains no address.
TEST(Report, EscapesNamesAndAsksNobody) {
  Grasp grasp;
  grasp.result.contact_points[0].name = "<script>alert('x')</script>";
  grasp.result.notes = {"a < b & c"};
  const std::string page = reportHtml(grasp.result);
  EXPECT_EQ(page.find("<script>alert"), std::string::npos);
  EXPECT_NE(page.find("&lt;script&gt;alert"), std::string::npos);
  EXPECT_NE(page.find("a &lt; b &amp; c"), std::string::npos);
  EXPECT_NE(page.find("default-src 'none'"), std::string::npos);
  EXPECT_EQ(page.find("http://"), std::string::npos);
  EXPECT_EQ(page.find("https://"), std::string::npos);
}

// A surface that a finger missed or passed through is reported with its time in every output; such a run is not good.
TEST(Losses, AreToldEverywhere) {
  Grasp grasp;
  grasp.feed.contact.coverage_lost = 2;
  grasp.feed.tick();
  takeMonitor(grasp.feed.monitor, grasp.result);
  EXPECT_EQ(grasp.result.coverage_lost.count, 2u);
  EXPECT_DOUBLE_EQ(grasp.result.coverage_lost.first, 6);
  grasp.result.coverage_lost = {37, 1.204};
  grasp.result.contact_points[1].summary.pop_through = 1;
  grasp.result.contact_points[1].summary.first_pop_through = 2.5;
  const std::string unseen =
      "the surface near a finger was not fully known in 37 ticks (first at 1.204 s): forces there are wrong";
  const std::string passed =
      "finger 'index' got past a surface 1 time (first at 2.500 s): its forces after that are wrong";
  EXPECT_EQ(lossesOf(grasp.result), (std::vector{unseen, passed}));
  EXPECT_EQ(verdictOf(grasp.result).outcome, Verdict::Outcome::kNeutral);
  const std::string closing = closingText(grasp.result, "", "", false, 0);
  EXPECT_NE(closing.find("warning: " + unseen + "\n"), std::string::npos) << closing;
  EXPECT_NE(closing.find("warning: " + passed + "\n"), std::string::npos) << closing;
  const std::string page = reportHtml(grasp.result);
  EXPECT_NE(page.find("<p class=\"warning\">Warning: the surface near a finger was not fully known in 37 ticks"),
            std::string::npos);
  EXPECT_NE(page.find("got past a surface 1 time"), std::string::npos);
  const auto json = nlohmann::json::parse(summaryJson(grasp.result));
  EXPECT_EQ(json["coverage_lost"]["ticks"], 37);
  EXPECT_EQ(json["coverage_lost"]["first_s"], 1.204);
  EXPECT_EQ(json["contact_points"][1]["first_pop_through_s"], 2.5);
  EXPECT_EQ(json["warnings"], (std::vector{unseen, passed}));
  LiveStatus status;
  status.losses = 38;
  EXPECT_NE(statusText(status, 1, 200, false).find("38 lost"), std::string::npos);
}

// With a single finger the report names it.
TEST(Losses, NameTheFingerWhereThereIsOne) {
  Grasp grasp;
  grasp.result.coverage_lost = {1, 0.5};
  grasp.result.contact_points.resize(1);
  EXPECT_EQ(lossesOf(grasp.result).at(0),
            "the surface near finger 'thumb' was not fully known in 1 tick (first at 0.500 s): forces there are wrong");
}

// XML allows the control characters above U+007F in a name; U+009B begins an escape sequence.
TEST(Closing, ShowsWhatATerminalWouldObey) {
  Grasp grasp;
  grasp.result.contact_points[0].name = "thumb\u009B2J";
  grasp.result.contact_points[0].summary.pop_through = 1;
  const std::string closing = closingText(grasp.result, "", "", false, 0);
  EXPECT_EQ(closing.find("\u009B"), std::string::npos) << closing;
  EXPECT_NE(closing.find("thumb\\u{9B}2J"), std::string::npos) << closing;
}

// A run without losses does not mention them.
TEST(Losses, WhichThereAreNotAreNotToldOf) {
  const Grasp grasp;
  EXPECT_TRUE(lossesOf(grasp.result).empty());
  EXPECT_EQ(closingText(grasp.result, "", "", false, 0).find("warning"), std::string::npos);
  EXPECT_EQ(reportHtml(grasp.result).find("class=\"warning\""), std::string::npos);
  const auto json = nlohmann::json::parse(summaryJson(grasp.result));
  EXPECT_TRUE(json["warnings"].empty());
  EXPECT_EQ(json["coverage_lost"]["ticks"], 0);
  EXPECT_TRUE(json["coverage_lost"]["first_s"].is_null());
  EXPECT_TRUE(json["contact_points"][0]["first_pop_through_s"].is_null());
  EXPECT_EQ(statusText({}, 1, 200, false).find("lost"), std::string::npos);
}

// An early loss of the object or a fault makes the verdict bad, regardless of all other figures.
TEST(Verdict, DropOrFaultIsBad) {
  Grasp grasp(0, 0);
  EXPECT_EQ(verdictOf(grasp.result).outcome, Verdict::Outcome::kGood);
  EXPECT_EQ(verdictOf(Grasp().result).outcome, Verdict::Outcome::kNeutral);  // the object turned
  grasp.result.faults = {{1, "gone"}};
  EXPECT_EQ(verdictOf(grasp.result).outcome, Verdict::Outcome::kBad);
  grasp.result.faults.clear();
  grasp.result.objects[0].summary.dropped = true;
  EXPECT_EQ(verdictOf(grasp.result).outcome, Verdict::Outcome::kBad);
}

/// The sentences of a verdict, one a line.
std::string detailsOf(const RunResult& result) {
  std::string all;
  for (const std::string& one : verdictOf(result).details) all += one + "\n";
  return all;
}

// A phase may have any name: what it is for decides.
TEST(Verdict, GoesByIntentsAndKnowsNoName) {
  Grasp grasp(0, 0);
  const Verdict before = verdictOf(grasp.result);
  for (RunResult::Phase& phase : grasp.result.phases) phase.name = "x";
  EXPECT_EQ(verdictOf(grasp.result).headline, before.headline);
  EXPECT_EQ(verdictOf(grasp.result).details, before.details);
  EXPECT_NE(before.headline.find("cube lifted by 100.0 mm, held in stick for 3.00 of 3.00 s"), std::string::npos)
      << before.headline;
  grasp.result.phases[0].intent = PhaseIntent::kNone;
  EXPECT_EQ(verdictOf(grasp.result).headline.find("lifted"), std::string::npos);
}

// Only a motion that says when it lets go can tell a drop from a release; of another one is told what happened, and no
// more.
TEST(Verdict, IsNeutralAboutAMotionWithoutIntents) {
  Grasp grasp(0, 0);
  for (RunResult::Phase& phase : grasp.result.phases) phase.intent = PhaseIntent::kNone;
  grasp.result.objects[0].summary.lost_at = 5.5;
  EXPECT_FALSE(graspFigures(grasp.result));
  EXPECT_EQ(verdictOf(grasp.result).outcome, Verdict::Outcome::kNeutral);
  EXPECT_NE(detailsOf(grasp.result).find("cube: Out of the fingers from 5.500 s on."), std::string::npos)
      << detailsOf(grasp.result);
  EXPECT_NE(detailsOf(grasp.result).find("does not say what its phases are for"), std::string::npos);
  grasp.result.phases.clear();  // a person
  EXPECT_EQ(detailsOf(grasp.result).find("phases"), std::string::npos) << detailsOf(grasp.result);
}

// A motion that never lets go has figures of its hold, and no sentence about slips of a release.
TEST(Verdict, JudgesAHoldWithoutARelease) {
  Grasp grasp(0, 0);
  grasp.result.phases.back().intent = PhaseIntent::kNone;
  const auto figures = graspFigures(grasp.result);
  ASSERT_TRUE(figures);
  EXPECT_TRUE(std::isinf(figures->release_begin));
  EXPECT_NEAR(figures->held_in_stick, 3.0, 1e-12);
  EXPECT_EQ(detailsOf(grasp.result).find("lip"), std::string::npos) << detailsOf(grasp.result);
  EXPECT_TRUE(nlohmann::json::parse(summaryJson(grasp.result)).at("grasp").at("release_s").is_null());
}

// After Ctrl-C the hand closes on what fades: what was rendered then is in no figure and no plot, what the device was
// sent is, and the report marks the stop.
TEST(Verdict, TellsWhenTheUserStopped) {
  Grasp grasp(0, 0);
  grasp.result.stopped_at = 3.2;
  grasp.result.interrupted = true;
  EXPECT_NE(detailsOf(grasp.result).find("Stopped by you at 3.200 s; forces faded until 6.000 s."), std::string::npos)
      << detailsOf(grasp.result);
  EXPECT_EQ(detailsOf(grasp.result).find("release began"), std::string::npos) << "it begins at 4 s";
  EXPECT_EQ(graspFigures(grasp.result)->hold_end, 3.2);
  EXPECT_EQ(nlohmann::json::parse(summaryJson(grasp.result)).at("stopped_s"), 3.2);
  EXPECT_NE(reportHtml(grasp.result).find("stopped by you"), std::string::npos);
}

// An impulse on the object that differs from the felt one by over 1 % is told, with finger, size and time.
TEST(Verdict, TellsOfImpulsesThatDiffer) {
  Grasp grasp;
  const auto details = [&] {
    std::string all;
    for (const std::string& one : verdictOf(grasp.result).details) all += one + "\n";
    return all;
  };
  ActionReaction::Result& reaction = grasp.result.contact_points[1].summary.reaction;
  reaction = {.worst = 0.0099, .time = 2.5, .windows = 10};
  EXPECT_EQ(details().find("impulse"), std::string::npos) << details();
  reaction.worst = 0.0323;
  EXPECT_NE(details().find("index felt differed by up to 3.2 % over 0.1 s (until 2.500 s)"), std::string::npos)
      << details();
}

}  // namespace
}  // namespace presa
