#include <cmath>
#include <numbers>

#include "apps/common/terminal/text.h"
#include "apps/studies/lectures/lecture.h"
#include "apps/studies/lectures/rates.h"
#include "apps/studies/lectures/wall.h"
#include "experiments/stability/case.h"
#include "framework/geometry/tangent_frame.h"

namespace presa::lectures {
namespace {

constexpr double kBuzz = 80;                               // [Hz]
constexpr double kWavelength = 0.001, kWave = 0.0001;      // of the surface, and its amplitude [m]
constexpr double kBuzzStiffness = 1000, kPressed = 0.001;  // [N/m], [m]
constexpr double kTurn = 2 * std::numbers::pi;

/// A force that is held, and for how long.
struct Hold {
  double force = 0, from = 0, to = 0;
};

std::vector<Hold> drawn(double rate) {
  const double speed = kBuzz * kWavelength, duration = 2;  // whole waves, and the wall is long enough
  const Vec3 along = tangentFrame(-Vec3::UnitX(), Vec3::Zero()).q * Vec3::UnitX();  // across the crests
  const auto path = [=](double time) {
    const double way = speed * std::max(0.0, time - kBegin) - speed * duration / 2;
    return PrescribedFinger::State{Vec3(-kRadius + kPressed, 0, 0.1) + way * along,
                                   (time < kBegin ? 0 : speed) * along};
  };
  std::vector<Hold> holds;
  DeviceList devices;
  devices.push_back(std::make_unique<HeldFinger>(path, [&](const Vec3& force, double from, double to) {
    if (from > kBegin && to < kBegin + duration) holds.push_back({-force.x(), from, to});
  }));
  std::vector<std::string> sets = ratesOf(rate);
  for (const auto& [name, value] : {std::pair{"shape", std::string("sine")},
                                    {"amplitude", stability::number(kWave)},
                                    {"wavelength", stability::number(kWavelength)}})
    sets.push_back(std::string("material/glass/texture/") + name + "=" + value);
  sets.push_back("material/glass/stiffness=" + stability::number(kBuzzStiffness));
  StudyRun(stability::specOf("haptic_wall.xml", sets, kBegin + duration), std::move(devices)).run();
  return holds;
}

/// RMS of the force that is held less that of the place where the finger is, in amplitudes of the wave.
double heldError(const std::vector<Hold>& holds) {
  // the wave at the ticks, where the held force is right: its mean, sine and cosine
  double mean = 0, sine = 0, cosine = 0;
  const auto count = static_cast<double>(holds.size());
  for (const Hold& hold : holds) mean += hold.force / count;
  for (const Hold& hold : holds) {
    sine += 2 / count * (hold.force - mean) * std::sin(kTurn * kBuzz * hold.from);
    cosine += 2 / count * (hold.force - mean) * std::cos(kTurn * kBuzz * hold.from);
  }
  constexpr int kFine = 50;
  double squares = 0;
  for (const Hold& hold : holds) {
    for (int i = 0; i < kFine; ++i) {
      const double time = hold.from + (hold.to - hold.from) * (i + 0.5) / kFine;
      const double wave = mean + sine * std::sin(kTurn * kBuzz * time) + cosine * std::cos(kTurn * kBuzz * time);
      squares += (hold.force - wave) * (hold.force - wave);
    }
  }
  return std::sqrt(squares / (kFine * count)) / (kBuzzStiffness * kWave);
}

}  // namespace

Lecture buzzing() {
  using terminal::format;
  Lecture lecture;
  lecture.name = "buzzing";
  lecture.title = "Buzzing: waves of 80 Hz, held from tick to tick";
  lecture.description =
      "A finger on a prescribed path crosses waves of 1 mm and ± 0.1 mm at 80 mm/s. Between ticks the device holds the "
      "last force: how wrong is that, root of the mean square, in amplitudes of the wave?";
  lecture.knob = "haptic rate";
  lecture.x_label = "haptic period h [ms]";
  lecture.y_label = "RMS error of the held force [amplitudes]";
  lecture.oracle = "√(1 − sin ω / ω), ω = 2π 80 Hz h";
  lecture.tolerance = 0.02;  // a hold at each end of the path is left out: 2 of 334 at 167 Hz
  for (const double rate : kLectureRates) {
    const double omega = kTurn * kBuzz / rate;
    lecture.points.push_back(
        {1000 / rate, format("%g Hz", rate), heldError(drawn(rate)), std::sqrt(1 - std::sin(omega) / omega)});
  }
  const auto& points = lecture.points;
  lecture.sentences = {
      format("The held force is wrong by %.3f, %.3f, %.3f and %.3f of the wave's amplitude at 1000, 500, 250 and 167 "
             "Hz; a zero-order hold is wrong by %.3f, %.3f, %.3f and %.3f.",
             points[0].measured, points[1].measured, points[2].measured, points[3].measured, points[0].oracle,
             points[1].oracle, points[2].oracle, points[3].oracle),
      format("The largest difference is %.2g %%, of %.2g %% allowed.", 100 * lecture.largestOff(),
             100 * lecture.tolerance),
      format("Against 1000 Hz the error is %.2f times as large at 500 Hz, %.2f times at 250 Hz and %.2f times at 167 "
             "Hz, where two ticks meet each wave and the error is %.2f times the wave's own root mean square.",
             points[1].measured / points[0].measured, points[2].measured / points[0].measured,
             points[3].measured / points[0].measured, points[3].measured * std::numbers::sqrt2)};
  return lecture;
}

}  // namespace presa::lectures
