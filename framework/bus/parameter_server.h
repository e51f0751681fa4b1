#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "framework/bus/state_bus.h"
#include "framework/scene/open_surfaces.h"
#include "framework/scene/surface_settings.h"

namespace presa::bus {

/// Parameter server of a run. Checks each command: run, parameter, range and order. A repeated command gets the same
/// answer and does not act again; a number far ahead of the sender's others is refused, so that a forged one cannot
/// make later ones look overtaken. Surface parameters are stored here for the haptic thread; other parameters act
/// through the Offer's functions. Forces, force limits and latched faults are out of reach.
/// Thread: the bus group's; in lockstep the single thread of the run.
class ParameterServer {
 public:
  using Open = std::function<std::unique_ptr<CommandPost>()>;
  /// An additional open parameter. The functions are called by serve().
  struct Offer {
    std::string name;
    std::function<double()> value, min, max;
    std::function<void(double)> set;  ///< called with a value within the current range
  };

  ParameterServer(const Scene& scene, Open open);
  /// Adds a parameter; before start().
  void offer(Offer offer) { offers_.push_back(std::move(offer)); }
  void start(std::uint64_t run);
  /// Processes all commands that have arrived. `time`: simulated time of the run [s].
  void serve(double time) noexcept;
  /// Stops listening.
  void stop() noexcept { post_.reset(); }
  const SurfaceSettings& surfaces() const noexcept { return surfaces_; }

  /// An accepted change: time [s], parameter, value.
  struct Done {
    double time;
    std::string name;
    double value;
  };
  const std::vector<Done>& done() const noexcept { return done_; }
  /// Number of accepted changes; done() holds the first kKept of them.
  std::size_t doneCount() const noexcept { return done_count_; }

 private:
  static constexpr std::size_t kKept = 32, kRemembered = 256;
  static constexpr std::uint64_t kFarthest = 4096;  // maximum lead over the sender's last judged number
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
  std::vector<double> surface_values_;  // commanded values, by slot
  SurfaceSettings surfaces_;
  std::vector<Offer> offers_;
  std::vector<OpenParameter> shown_;  // as offers_
  std::vector<Judged> judged_;        // last answer to each sender and parameter, oldest first
  std::vector<Done> done_;
  std::size_t done_count_ = 0;
};

/// A module whose run may take commands.
class Commandable {
 public:
  virtual ~Commandable() = default;
  /// Null when the run takes no commands.
  virtual ParameterServer* parameterServer() noexcept = 0;
};

}  // namespace presa::bus
