#include "apps/presa/device/calibrate.h"

#include <memory>

#include "apps/presa/commands/device/device_commands.h"

namespace presa {

void addCalibrate(CLI::App& app, int& status) {
  auto options = std::make_shared<device::CalibrateOptions>();
  CLI::App* command = app.add_subcommand(
      "calibrate", "Find where two devices stand to each other from a motion in which a link ties them together");
  command->add_option("RIG", options->rig, "rig of the two devices, about where they stand")
      ->required()
      ->check(CLI::ExistingFile);
  auto* samples =
      command
          ->add_option("--samples", options->samples,
                       "CSV of the linked motion: a_x_m,a_y_m,a_z_m,b_x_m,b_y_m,b_z_m, each in its base's frame")
          ->check(CLI::ExistingFile);
  command->add_option("--rehearse", options->seed, "without samples: modelled devices, misplaced as this seed says")
      ->excludes(samples)
      ->capture_default_str();
  command->add_option("--link", options->link, "from each reported position to the centre of the link [m]")
      ->check(CLI::Range(0.0, 0.2))
      ->capture_default_str();
  command->add_option("--out", options->out, "rig to write, with the second device where it was found");
  command->footer(
      "Exit status: 0 found, 1 the motion cannot tell (nothing is written), 2 bad input.\n"
      "Example:  presa device calibrate config/rigs/pinch_cube_percro.xml --rehearse 7 --out out/calibrated.xml");
  command->callback([options, &status] { status = device::calibrate(*options); });
}

}  // namespace presa
