#include "apps/presa/device/calibrate.h"

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>
#include <optional>
#include <span>

#include "apps/common/atomic_file.h"
#include "apps/common/exit_status.h"
#include "apps/common/terminal/text.h"
#include "apps/presa/device/driver_symbol.h"
#include "apps/presa/device/record_link.h"
#include "apps/presa/device/rig_bases.h"
#include "apps/presa/device/samples_file.h"
#include "devices/percro_arm/calibration/calibration_plugin.h"
#include "framework/core/math/random.h"

namespace presa::device {
namespace {

constexpr const char* kWhere = "presa device calibrate";
constexpr double kMisplacement = 0.1, kTwist = 0.15;  // how far a rehearsal misplaces the second device [m], [rad]

double distance(const Pose& a, const Pose& b) { return (a.p - b.p).norm(); }
double degrees(const Pose& a, const Pose& b) {
  return 2 * std::atan2((a.q.conjugate() * b.q).vec().norm(), std::abs((a.q.conjugate() * b.q).w())) * 180 /
         std::numbers::pi;
}

/// A random pose near the given one: a device that was placed by hand.
Pose misplaced(const Pose& X_AB, std::uint64_t seed) {
  RandomStream stream(seed, "where the second device stands");
  const auto any = [&](double max) {
    const double x = stream.uniform(-max, max), y = stream.uniform(-max, max);
    return Vec3(x, y, stream.uniform(-max, max));
  };
  const Vec3 turn = any(kTwist);
  const Quat twist(Eigen::AngleAxisd(turn.norm(), turn.normalized()));
  return {X_AB.p + any(kMisplacement), (twist * X_AB.q).normalized()};
}

void tell(const RigBases& rig, const LinkedBases& fit, std::size_t samples) {
  const Pose nominal = rig.base(0).inverse() * rig.base(1);
  std::printf("%s stands %.2f mm and %.3f deg from where the rig says, seen from %s\n", rig.role(1).c_str(),
              distance(fit.X_AB, nominal) * 1e3, degrees(fit.X_AB, nominal), rig.role(0).c_str());
  std::printf("  %zu samples, spread %.0f, %.0f and %.0f mm, condition of the normal equations %.1f\n", samples,
              fit.spread[0] * 1e3, fit.spread[1] * 1e3, fit.spread[2] * 1e3, fit.condition);
  std::printf("  %.3f mm remain between the two; expected error %.3f mm, %.4f deg\n", fit.residual * 1e3,
              fit.position_error * 1e3, fit.angle_error * 180 / std::numbers::pi);
}

/// The joint's centres from what the devices report.
std::vector<LinkedSample> centres(std::vector<LinkedSample> samples, const CalibrationPlugin& driver, double link) {
  for (LinkedSample& s : samples) s = {driver.centre(s.p_A, link), driver.centre(s.p_B, link)};
  return samples;
}

/// Says what to do, and waits for Enter where somebody can press it.
void ask(const std::string& what) {
  std::fprintf(stderr, "%s\n", what.c_str());
  if (isatty(STDIN_FILENO) != 1) return;
  std::fputs("Press Enter to begin. ", stderr);
  for (int c = 0; c != '\n' && c != EOF;) c = std::getchar();
}

/// The fit of one direction alone: friction and compliance of the device that is led pull it one way.
void tellDirection(const std::string& leader, const LinkedBases& fit, const LinkedBases& all) {
  if (fit.refusal.empty())
    std::printf("  led by %s alone: %.3f mm and %.4f deg from the result of both\n", leader.c_str(),
                distance(fit.X_AB, all.X_AB) * 1e3, degrees(fit.X_AB, all.X_AB));
}

/// Records each device led by the other into one file, and how many samples the first direction has; none when it was
/// stopped, with what there is in the file.
std::optional<std::size_t> recordBoth(const CalibrateOptions& options, const RigBases& rig, const Pose& truth) {
  const Pose X_WB = options.rehearsal ? rig.base(0) * truth : rig.base(1);
  std::vector<LinkedSample> samples;
  std::size_t first = 0;
  for (const int leader : {1, 0}) {
    const std::string &leads = rig.role(leader), &led = rig.role(1 - leader);
    LinkRecording recording{
        .rig_xml = options.rehearsal ? rig.rehearsal(X_WB, leader, options.link, options.seed) : rig.resolved(),
        .name = options.rig,
        .seconds = options.seconds,
        .realtime = !options.rehearsal,
        .doing = leads + " leads " + led,
        .roles = {rig.role(0), rig.role(1)},
        .bases = {rig.base(0), X_WB}};
    if (!options.rehearsal)
      ask("Both devices are linked and give no force. Let go of the device of " + quote(led) + ", hold that of " +
          quote(leads) + " and lead both\nslowly to and fro, up and down, left and right for " +
          terminal::format("%.0f", options.seconds) + " s.");
    const RecordedLink recorded = recordLink(recording);
    samples.insert(samples.end(), recorded.samples.begin(), recorded.samples.end());
    writeFileAtomically(options.record, samplesText(samples));
    if (recorded.stopped) return std::nullopt;
    if (leader == 1) first = samples.size();
  }
  std::printf("Samples: %s\n", options.record.c_str());
  return first;
}

}  // namespace

int calibrate(const CalibrateOptions& options) {
  const RigBases rig(options.rig);
  const auto& driver =
      driverTable<CalibrationPlugin>(kWhere, rig.driver(), kCalibrationSymbol, "cannot be calibrated by a link");
  const bool records = !options.record.empty();
  const bool rehearsal = records ? options.rehearsal : options.samples.empty();
  const Pose truth = misplaced(rig.base(0).inverse() * rig.base(1), options.seed);
  if (rehearsal && driver.rehearse == nullptr)
    refuse(471, kWhere, "driver " + quote(rig.driver()) + " has no model to rehearse with");
  std::vector<LinkedSample> samples;
  std::optional<std::size_t> first;  // samples of the first direction of a recording
  if (rehearsal && !records) {
    samples = driver.rehearse(rig.base(0), truth, options.link, options.seed);
    if (samples.empty())
      refuse(476, options.rig, "the two devices cannot meet in the middle between them", "move their bases in the rig");
  } else {
    if (records && !(first = recordBoth(options, rig, truth))) return kExitInterrupted;
    samples = centres(readSamples(records ? options.record : options.samples), driver, options.link);
  }
  const LinkedBases fit = fitBases(samples);
  if (!fit.refusal.empty()) {
    std::fprintf(stderr, "%s: refused: %s\n", kWhere, fit.refusal.c_str());
    return kExitFault;
  }
  tell(rig, fit, samples.size());
  if (first) {
    const std::span<const LinkedSample> all(samples);
    tellDirection(rig.role(1), fitBases(all.first(*first)), fit);
    tellDirection(rig.role(0), fitBases(all.subspan(*first)), fit);
  }
  if (rehearsal)
    std::printf("  rehearsal with modelled devices: missed where it really stands by %.4f mm and %.5f deg\n",
                distance(fit.X_AB, truth) * 1e3, degrees(fit.X_AB, truth));
  if (options.out.empty()) return kExitOk;
  const std::string folder = std::filesystem::absolute(options.out).parent_path().string();
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed) refuse(472, "--out " + options.out, "nothing can be written there", failed.message());
  writeFileAtomically(options.out, rig.withSecondAt(rig.base(0) * fit.X_AB, folder));
  std::printf("Rig: %s\n", options.out.c_str());
  return kExitOk;
}

}  // namespace presa::device
