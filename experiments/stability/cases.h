#pragma once
#include "experiments/stability/case.h"

/// One function per file under cases/.
namespace presa::stability {

Case graspInAir();
Case graspOnTable();
Case pressedOnTable();
Case pressedInCorner();
Case graspByLaw();
Case turnedDisc();
Case textureLoops();
Case graspShaken();
Case needleSpun();
Case graspAnySize();
Case stallWhileHolding();
Case endurance();
Case massRatio();
Case blockTower();
Case freeRotation();
Case coulombSlide();
Case coulombStick();
Case rolling();
Case hapticWall();
Case thinPlate();
Case grooves();

}  // namespace presa::stability
