#pragma once
#include <array>
#include <cstddef>

namespace presa::view {

/// Chooses the fraction of the window's resolution at which software rendering keeps the frame time. No drawing here.
class FrameBudget {
 public:
  static constexpr double kLongest = 0.030;   ///< maximum frame time [s]
  static constexpr double kMinShare = 0.625;  ///< minimum share; below it texts on stones and edges are lost

  double share() const { return kShares[at_]; }
  /// Adds a frame time [s]. True: the share has changed.
  bool add(double seconds);

 private:
  static constexpr std::array kShares{1.0, 0.75, kMinShare};  ///< between 0.75 and 1 scaling costs more than it saves
  static constexpr std::size_t kJudged =
      9;  ///< frames per decision, by their median, so that single delayed frames do not count
  bool changeTo(std::size_t at);

  std::size_t at_ = 0, count_ = 0;
  std::array<double, kJudged> times_{};
};

}  // namespace presa::view
