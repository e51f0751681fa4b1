#pragma once
#include "experiments/stability/case.h"

/// One namespace per file under cases/.
namespace presa::stability {

namespace grasp_in_air {
Case make();
}
namespace grasp_on_table {
Case make();
}
namespace pressed_on_table {
Case make();
}
namespace pressed_in_corner {
Case make();
}
namespace grasp_by_law {
Case make();
}
namespace turned_disc {
Case make();
}
namespace texture_loops {
Case make();
}
namespace grasp_shaken {
Case make();
}
namespace needle_spun {
Case make();
}
namespace grasp_any_size {
Case make();
}
namespace stall_while_holding {
Case make();
}
namespace endurance {
Case make();
}
namespace pendulum {
Case make();
}
namespace hanging_chain {
Case make();
}
namespace chain_lifted {
Case make();
}
namespace drawer_stop {
Case make();
}
namespace mass_ratio {
Case make();
}
namespace block_tower {
Case make();
}
namespace free_rotation {
Case make();
}
namespace coulomb_slide {
Case make();
}
namespace coulomb_stick {
Case make();
}
namespace rolling {
Case make();
}
namespace haptic_wall {
Case make();
}
namespace thin_plate {
Case make();
}
namespace grooves {
Case make();
}
namespace ray_loops {
Case make();
}
namespace tall_tower {
Case make();
}
namespace falling_tower {
Case make();
}
namespace tower_on_tower {
Case make();
}
namespace mesh_stack {
Case make();
}
namespace capsule_lying {
Case make();
}
namespace spinning_coin {
Case make();
}
namespace poured_heap {
Case make();
}
namespace mesh_arch {
Case make();
}
namespace card_house {
Case make();
}
namespace overhang {
Case make();
}
namespace domino_row {
Case make();
}
namespace gravity_five_and_zero {
Case make();
}
namespace far_from_origin {
Case make();
}
namespace tiny_and_huge {
Case make();
}
namespace painleve_rod {
Case make();
}
namespace three_fingers {
Case make();
}
namespace five_fingers {
Case make();
}
namespace held_at_haptic_rate {
Case make();
}
namespace tea_tray {
Case make();
}
namespace two_hands {
Case make();
}
namespace hand_over {
Case make();
}
namespace peg_in_hole {
Case make();
}
namespace wall_of_343 {
Case make();
}
namespace random_grasping {
Case make();
}

}  // namespace presa::stability
