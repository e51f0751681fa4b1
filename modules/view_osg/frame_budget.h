#pragma once
#include <array>
#include <cstddef>

namespace presa::view {

/// In which share of a window's width and height a processor can draw what is seen so that frames come in time. No drawing here.
class FrameBudget {
 public:
  static constexpr double kLongest = 0.030;  ///< a frame may take [s]
  static constexpr double kLeast = 0.625;    ///< share; below it text on stones and edges are lost

  double share() const { return kShares[at_]; }
  /// A frame took that long [s]. True: the share is another one from now on.
  bool add(double seconds);

 private:
  static constexpr std::array kShares{1.0, 0.75, kLeast};  ///< more than 0.75 spares less than spreading it costs
  static constexpr std::size_t kJudged =
      9;  ///< frames, by their median: one that something else held up does not count
  bool changeTo(std::size_t at);

  std::size_t at_ = 0, count_ = 0;
  std::array<double, kJudged> times_{};
};

}  // namespace presa::view
