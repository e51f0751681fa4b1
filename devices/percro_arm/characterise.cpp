#include "devices/percro_arm/characterise.h"

namespace presa::percro {

std::vector<Assumption> assumptions(const Parameters& p) {
  const Geometry& g = p.geometry;
  return {
      {"tilt ratio tau_1", "1", g.tilt_ratio, "inferred from 55 and 130 um: mean of the two values"},
      {"drum radius r_b", "mm", g.drum_radius * 1e3,
       "inferred: smallest worst condition number from L = 441 to 1070 mm"},
      {"range of tilt, of yaw", "rad", g.tilt_range, "guess; yaw 0.698"},
      {"continuous torque of a motor", "N m", p.motors.continuous_torque, "inferred from 4 N, L = 1070 mm"},
      {"peak torque of a motor", "N m", p.motors.peak_torque, "inferred from 10 N, L = 1070 mm"},
      {"thermal time of the winding", "s", p.motors.thermal_time, "guess"},
      {"current loop", "Hz", p.motors.current_bandwidth, "guess"},
      {"rotor inertia", "kg m^2", p.motors.rotor_inertia, "guess: iron-less brushed motor of that torque"},
      {"barrel", "kg", p.masses.barrel, "inferred from 75 Hz, 23.74 N/mm and the damping"},
      {"centre of the barrel behind the tip", "m", p.masses.barrel_setback, "guess"},
      {"inertia of the barrel across", "kg m^2", p.masses.barrel_inertia, "guess"},
      {"counterweight (the barrel's motor)", "kg", p.masses.counterweight, "guess"},
      {"its arm", "m", p.masses.counterweight_arm, "inferred: balance at L = 1070 mm"},
      {"inertia of tilt and yaw parts", "kg m^2", p.masses.tilt_inertia, "guess"},
      {"a1 of the compliance", "1/N", p.structure.bend_linear, "inferred from 13.5 and 1.5 N/mm"},
      {"a3 of the compliance", "1/(N m^2)", p.structure.bend_cubic, "inferred from 13.5 and 1.5 N/mm"},
      {"damping over stiffness of the structure", "s", p.structure.damping_time,
       "guess: 0.1 of critical along the barrel"},
      {"dry friction of an angle's joint", "N m", p.friction.coulomb[0], "guess"},
      {"dry friction of the barrel", "N", p.friction.coulomb[2], "guess"},
      {"viscous friction of an angle's joint", "N m s", p.friction.viscous[0], "guess"},
      {"viscous friction of the barrel", "N s/m", p.friction.viscous[2], "guess"},
  };
}

Characterisation characterise(const Parameters& parameters) {
  return {.title = "PERCRO arm, modelled",
          .source = "Bergamasco et al., Design and validation of a complete haptic system for manipulative tasks",
          .figures = figures(parameters),
          .plots = plots(parameters),
          .assumptions = assumptions(parameters)};
}

}  // namespace presa::percro
