#include "modules/collision_fcl/reach.h"

namespace presa {

double motionBound(const RelativeMotion& motion, double horizon) {
  const double speed = (motion.v_WH - motion.v_WB - motion.w_WB.cross(motion.p_BoH_W)).norm();
  const double spin = motion.w_WB.norm();
  const double acceleration = reach::kAcceleration + spin * spin * motion.p_BoH_W.norm() + 2 * spin * speed;
  return speed * horizon + 0.5 * acceleration * horizon * horizon;
}

}  // namespace presa
