#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "framework/bus/state_bus.h"
#include "framework/scene/open_surfaces.h"
#include "framework/core/state/surface_settings.h"

namespace presa::bus {

/// Judges the commands that come to a run: whether they are meant for it, known, within their range and not overtaken. What was
/// judged once is answered again and does not act again; a number far ahead of its sender's others is refused, so that no forged one
/// makes all that follow look overtaken. Surfaces it keeps itself, for the haptic thread to read; the rest is acted
/// on by whoever offered it. Nothing here reaches a force, a limit or a latched fault.
/// Thread: that of the bus group; in lockstep, where there is one thread, anybody's.
class CommandDesk {
 public:
  using Open = std::function<std::unique_ptr<CommandPost>()>;
  /// What else may be set. The functions are called by serve().
  struct Offer {
    std::string name;
    std::function<double()> value, least, most;
    std::function<void(double)> set;  ///< within the range of that moment
  };

  CommandDesk(const Scene& scene, Open open);
  /// Before start().
  void offer(Offer offer) { offers_.push_back(std::move(offer)); }
  void start(std::uint64_t run);
  /// Everything that has arrived; `time` is the run's [s].
  void serve(double time) noexcept;
  /// From now on nobody listens.
  void stop() noexcept { post_.reset(); }
  const SurfaceSettings& surfaces() const noexcept { return surfaces_; }

  /// What was set, in words. After stop().
  struct Done {
    double time;
    std::string name;
    double value;
  };
  const std::vector<Done>& done() const noexcept { return done_; }
  /// Of these the first kKept are kept; how many there were.
  std::size_t doneCount() const noexcept { return done_count_; }

 private:
  static constexpr std::size_t kKept = 32, kRemembered = 256;
  static constexpr std::uint64_t kFarthest = 4096;  // commands that a sender may be ahead of the last that was judged
  struct Judged {
    std::uint64_t sender = 0;
    std::string parameter;
    Answer answer;
  };
  void offerSurface(const std::vector<OpenSurface>& open, std::size_t slot);
  Answer judge(const Command& command, double time);
  Answer decide(const Command& command, double time);
  void showChanged();

  Open open_;
  std::unique_ptr<CommandPost> post_;
  std::uint64_t run_ = 0;
  std::vector<double> surface_values_;  // by slot: asked for
  SurfaceSettings surfaces_;
  std::vector<Offer> offers_;
  std::vector<OpenParameter> shown_;  // as offers_
  std::vector<Judged> judged_;        // the last of each sender and parameter, the oldest first
  std::vector<Done> done_;
  std::size_t done_count_ = 0;
};

/// A module whose run may take commands.
class Commandable {
 public:
  virtual ~Commandable() = default;
  /// Null where it takes none.
  virtual CommandDesk* desk() noexcept = 0;
};

}  // namespace presa::bus
