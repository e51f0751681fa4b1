#include "apps/presa/device/record_link.h"

#include <unistd.h>

#include <cmath>
#include <cstdio>

#include "apps/common/terminal/interruption.h"
#include "apps/common/terminal/text.h"
#include "framework/core/diagnostics/refuse.h"
#include "framework/core/exchange/event_ring.h"
#include "framework/core/schedule/clock.h"
#include "framework/record/haptic_observer.h"
#include "framework/session/load_world.h"
#include "framework/session/run.h"

namespace presa::device {
namespace {

using terminal::format;

enum RecordCode { kNoSamples = 400 };

constexpr std::uint64_t kTicksPerSample = 10;                                 // 10 ms
constexpr double kBegin = 3;                                                  // [s] before a motion can be wide
constexpr std::size_t kRoom = 1024;                                           // samples between two polls: 10 s
constexpr std::int64_t kShowEvery = 500'000'000, kTellEvery = 2'000'000'000;  // [ns] on a terminal, elsewhere

/// Passes every tenth pair of fingertips on to the main thread.
class LinkObserver final : public HapticObserver {
 public:
  explicit LinkObserver(EventRing<LinkedSample>& samples) : HapticObserver("link_observer"), samples_(samples) {}

  void observe(const HapticSample& sample) noexcept override {
    if (sample.tick.index % kTicksPerSample != 0 || sample.device.count() != 2) return;
    const FingerInput &a = sample.device.fingers[0], &b = sample.device.fingers[1];
    if (a.valid && b.valid && !a.lost && !b.lost) samples_.push({a.p_WH, b.p_WH});
  }
  std::vector<std::string> stages() const override { return {"record where both devices are"}; }

 private:
  EventRing<LinkedSample>& samples_;
};

/// A scene with nothing to touch, so that the devices get no force; a scene has at least one body.
std::string emptyScene(const std::vector<std::string>& roles) {
  std::string xml =
      "<scene version=\"1.0\" name=\"link\"><world gravity=\"0 0 -9.81\"/><materials><material name=\"none\" "
      "stiffness=\"1\"/></materials>"
      "<body name=\"floor\" fixed=\"true\" material=\"none\"><visual><box size=\"1 1 0.01\"/></visual></body><devices>";
  for (const std::string& role : roles) xml += "<device role=\"" + role + "\" fingertip_radius=\"0.008\"/>";
  return xml + "</devices></scene>";
}

/// The progress on stderr: how long, and how far the motion has spread so far.
class Progress {
 public:
  explicit Progress(const LinkRecording& recording) : recording_(recording), terminal_(isatty(STDERR_FILENO) == 1) {}
  ~Progress() {
    if (shown_ && terminal_) std::fputs("\n", stderr);
  }

  void show(const std::vector<LinkedSample>& samples) {
    const std::int64_t now = monotonicNs();
    if (now < next_) return;
    next_ = now + (terminal_ ? kShowEvery : kTellEvery);
    shown_ = true;
    const double seconds = static_cast<double>(samples.size() * kTicksPerSample) * 1e-3;
    const LinkedBases fit = fitBases(samples);
    std::fprintf(stderr, "%s%s  %.0f of %.0f s, spread %.0f, %.0f and %.0f mm%s%s", terminal_ ? "\r" : "",
                 recording_.doing.c_str(), seconds, recording_.seconds, fit.spread[0] * 1e3, fit.spread[1] * 1e3,
                 fit.spread[2] * 1e3, seconds > kBegin && fit.condition > kMaxCondition ? ": lead it wider" : "",
                 terminal_ ? "\x1b[K" : "\n");
  }

 private:
  const LinkRecording& recording_;
  bool terminal_, shown_ = false;
  std::int64_t next_ = 0;
};

}  // namespace

RecordedLink recordLink(const LinkRecording& recording) {
  RunOptions options;
  options.duration = recording.seconds;
  options.realtime = recording.realtime;
  Diagnostics diagnostics;
  Loaded loaded =
      loadWorldFromText({emptyScene(recording.roles), recording.name, recording.rig_xml}, options, diagnostics);
  if (diagnostics.hasErrors()) throw InputError(std::move(diagnostics));

  EventRing<LinkedSample> fingertips(kRoom);
  RunControl control;
  Session::Options session;
  session.more.push_back(std::make_unique<LinkObserver>(fingertips));
  RecordedLink recorded;
  terminal::Interruption interruption;
  {
    Run run(std::move(loaded), control, std::move(session));
    Progress progress(recording);
    run.onPoll([&] {
      for (LinkedSample at; fingertips.pop(at);)
        recorded.samples.push_back({recording.bases[0].inverseTimes(at.p_A), recording.bases[1].inverseTimes(at.p_B)});
      progress.show(recorded.samples);
      if (terminal::Interruption::came()) control.stop_requested = true;
    });
    run.execute();
  }
  recorded.stopped = terminal::Interruption::came();
  if (recorded.samples.empty() && !recorded.stopped)
    refuse(kNoSamples, recording.name, "the devices gave no samples", "presa device doctor looks for the reason");
  return recorded;
}

}  // namespace presa::device
