#include "experiments/stability/cases.h"

namespace presa::stability {

std::vector<Case> allCases() {
  return {graspInAir(),  graspByLaw(),   turnedDisc(),   graspOnTable(),      pressedOnTable(), pressedInCorner(),
          graspShaken(), needleSpun(),   graspAnySize(), stallWhileHolding(), endurance(),      massRatio(),
          blockTower(),  freeRotation(), coulombSlide(), coulombStick(),      rolling(),        hapticWall(),
          thinPlate(),   grooves(),      textureLoops()};
}

}  // namespace presa::stability
