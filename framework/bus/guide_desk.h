#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "framework/assembly/guide_report.h"
#include "framework/bus/guide_link.h"
#include "framework/core/schedule/timing_stats.h"
#include "framework/scene/guide_orders.h"

namespace presa::bus {

/// The run's end of a guide in a viewer: follows one guide, checks its orders, and tells it the state of the assembly.
/// The first guide that sends an order leads until it has been silent for kSilence; any other is refused. Orders that
/// are wrong, late or too many have no effect and are counted; whether a body may be pulled at all is decided beside
/// the
/// dynamics (modules/assembly). In lockstep, where nothing waits for the clock, each publication waits for the guide's
/// order, so that the outcome does not depend on the machine.
/// Thread: the bus group's, unless stated otherwise; in lockstep the single thread of the run.
class GuideDesk {
 public:
  using Open = std::function<std::unique_ptr<OrderPost>()>;
  /// Time without orders after which a guide no longer leads; in lockstep without one on the newest publication [s].
  static constexpr double kSilence = 0.5;
  static constexpr std::uint64_t kOldest = 40;    ///< age of the states that an order may decide on [publications]
  static constexpr std::size_t kMostAtOnce = 32;  ///< orders of the guide read at one publication
  /// Draws begun or ended at one publication; more wait for the next. A recording takes one for each haptic tick.
  static constexpr int kMostChanges = 4;
  static constexpr double kUndoEvery = 0.2;  ///< shortest time between two undos [simulated s]

  GuideDesk(const Scene& scene, bool realtime, Open open);
  /// Before the run, in lockstep: the first publication waits for a guide as long as this returns true.
  void awaitGuide(std::function<bool()> go_on) { await_ = std::move(go_on); }
  void start(std::uint64_t run);
  /// Before a heartbeat is published: tells the guide the state of the assembly.
  void show(const Stamp& stamp, const AssemblyState& assembly) noexcept;
  /// After it: reads the orders that have arrived. `assembly`: as shown.
  void serve(const Stamp& stamp, const AssemblyState& assembly) noexcept;
  void stop() noexcept { post_.reset(); }

  const GuideOrders& orders() const noexcept { return orders_; }
  const GuideReport& report() const noexcept { return report_; }

  /// What a user of the run should know, one sentence each, since the last call. Any thread.
  std::vector<std::string> takeNotes();
  /// After the run: where the guide was and what it did, in one sentence.
  std::string summary() const;

 private:
  static constexpr std::uint64_t kFarthest = 4096;  // maximum lead of a number over the guide's last one
  static constexpr std::uint64_t kAgain = 20;       // publications after which a draw that does not pull begins anew
  void read(const Stamp& stamp, const AssemblyState& assembly);
  OrderRefusal judge(const GuideOrder& order, const Stamp& stamp) const;
  void obey(const GuideOrder& order, const Stamp& stamp, const AssemblyState& assembly);
  void follow(const GuideOrder& order, const Stamp& stamp);
  void hear(const GuideOrder& order, double time);
  bool isNews(const GuideEvent& event) const noexcept;
  void refuse(const GuideOrder& order, OrderRefusal refusal, double time);
  void noteSilence(double time, bool behind);
  void note(double time, const std::string& what);

  const Scene& scene_;
  const bool realtime_;
  Open open_;
  std::function<bool()> await_;
  std::unique_ptr<OrderPost> post_;
  std::uint64_t run_ = 0;
  std::uint64_t lead_ = 0, led_ = 0;  // the guide now, and the last one
  std::uint64_t number_ = 0, on_ = 0;
  std::int64_t heard_ns_ = 0;
  std::uint64_t told_ = 0;                           // events heard of led_
  double told_until_ = -1e300, led_from_ = -1e300;   // times of the newest event heard, now and when led_ began [s]
  bool finish_told_ = false;                         // and nothing placed or undone since
  int changes_ = 0;                                  // of draws at this publication
  double undone_at_ = -1e300;                        // [s]
  std::vector<std::uint64_t> begun_;                 // by goal: publication at which its draw began
  std::uint64_t taken_ = 0, refused_ = 0;            // orders
  std::array<std::int64_t, kOldest + 1> sent_ns_{};  // of the last publications
  DurationHistogram latency_;                        // from a publication to the order that decides on it [ns]
  int takeovers_ = 0, silences_ = 0;
  OrderRefusal refusal_ = OrderRefusal::kNone;
  std::uint64_t refused_guide_ = 0;
  std::array<bool, static_cast<std::size_t>(OrderRefusal::kTooMany) + 1> noted_{};  // since the guide leads
  GuideOrders orders_;
  GuideReport report_;
  std::mutex mutex_;
  std::vector<std::string> notes_;  // guarded by mutex_
};

/// A module whose run may have its guide in a viewer.
class Guidable {
 public:
  virtual ~Guidable() = default;
  /// Null when the run has its own guide, or none.
  virtual GuideDesk* guideDesk() noexcept = 0;
};

}  // namespace presa::bus
