#pragma once
#include <string>
#include <vector>

#include "experiments/stability/case.h"

/// Piles without fingers: energy, speeds, displacement and rest, from the poses and velocities of a run alone.
namespace presa::stability {

/// One run of a pile, watched in every dynamics step.
class Pile {
 public:
  /// `body`: whose height is drawn and whose displacement is judged.
  Pile(const StudySpec& spec, const std::string& body);
  void run() { run_.run(); }

  /// Energy that appeared from nothing, in relation to `released`, the energy in gravity that the pile can set free
  /// [J].
  Finding energy(double released, double bound_percent) const;
  Finding fastest(double bound, const std::string& oracle) const;  ///< speed of any body [m/s]
  Finding upward(double bound) const;                              ///< upward speed of any body [m/s]
  Finding displacement(double bound_mm) const;                     ///< max of `body` since the start
  /// For a pile that must fall: height of `body` at the end, in relation to that at the start, up to 50 % [%].
  Finding heightLeft(const std::string& oracle) const;
  /// Speed of any body in the second half of the run, up to 1 mm/s.
  Finding restSpeed() const;
  Finding restsWithin(double bound) const;  ///< time until every free body sleeps [s]

 private:
  void see(const ObjectState& state);
  Finding withHeight(Finding finding) const;
  double energyOf(const ObjectState& state) const;

  StudyRun run_;
  std::size_t body_;
  double energy_ = 0, created_ = 0;  // now, and the sum of its rises [J]
  double fastest_ = 0, upward_ = 0, farthest_ = 0, late_ = 0;
  double all_asleep_ = -1;  // time since which every free body sleeps [s]; < 0: not yet
  bool started_ = false, failed_ = false;
  Curve height_;
};

}  // namespace presa::stability
