#pragma once
#include <vector>

/// Reference for a row of falling dominoes: plates that turn about their lower front edges, meet without restitution
/// and then push each other, with friction between them [vanLeeuwen2010]. One degree of freedom, that of the front
/// domino; it shares nothing with a rigid-body engine.
namespace presa::stability {

struct DominoRow {
  double height = 0, thickness = 0, gap = 0;  ///< [m]; the gap between faces
  double friction = 0;                        ///< between dominoes
  double gravity = 9.81;                      ///< [m/s^2]
};

/// Times at which dominoes 1, 2, ... `count` - 1 are struck when domino 0 starts upright with `spin` [rad/s]; less when
/// the wave dies. Steps of 20 us, classical midpoint rule.
std::vector<double> strikes(const DominoRow& row, int count, double spin);

}  // namespace presa::stability
