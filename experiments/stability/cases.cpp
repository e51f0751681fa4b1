#include "experiments/stability/cases.h"

namespace presa::stability {

std::vector<Case> allCases() {
  return {grasp_in_air::make(),
          grasp_by_law::make(),
          turned_disc::make(),
          grasp_on_table::make(),
          pressed_on_table::make(),
          pressed_in_corner::make(),
          grasp_shaken::make(),
          needle_spun::make(),
          grasp_any_size::make(),
          stall_while_holding::make(),
          endurance::make(),
          mass_ratio::make(),
          block_tower::make(),
          free_rotation::make(),
          coulomb_slide::make(),
          coulomb_stick::make(),
          rolling::make(),
          haptic_wall::make(),
          thin_plate::make(),
          grooves::make(),
          texture_loops::make(),
          tall_tower::make(),
          falling_tower::make(),
          tower_on_tower::make(),
          mesh_stack::make(),
          capsule_lying::make(),
          poured_heap::make(),
          spinning_coin::make(),
          mesh_arch::make(),
          card_house::make(),
          overhang::make(),
          domino_row::make(),
          gravity_five_and_zero::make(),
          far_from_origin::make(),
          tiny_and_huge::make(),
          painleve_rod::make(),
          three_fingers::make(),
          five_fingers::make(),
          two_hands::make(),
          hand_over::make(),
          peg_in_hole::make()};
}

}  // namespace presa::stability
