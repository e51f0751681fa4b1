#include "apps/presa/device/calibrate.h"

#include <memory>

#include "apps/presa/device/commands/device_commands.h"

namespace presa {

void addCalibrate(Command app, int& status) {
  auto options = std::make_shared<device::CalibrateOptions>();
  Command command = app.command(
      "calibrate", "Find where two devices stand to each other from a motion in which a link ties them together");
  command.option("RIG", options->rig, "rig of the two devices, about where they stand").required().existingFile();
  Option samples =
      command
          .option("--samples", options->samples,
                  "CSV of the linked motion: a_x_m,a_y_m,a_z_m,b_x_m,b_y_m,b_z_m, each in its base's frame")
          .existingFile();
  command
      .option("--record", options->record,
              "record the linked motion now, each device led by the other, into this CSV, and solve from it")
      .excludes(samples);
  command.option("--for", options->seconds, "seconds to record in each direction").within(5.0, 600).showDefault();
  command
      .option("--rehearse", options->seed,
              "modelled devices, misplaced as this seed says; with --record a simulated hand leads them")
      .excludes(samples)
      .showDefault();
  command.option("--link", options->link, "from each reported position to the centre of the link [m]")
      .within(0.0, 0.2)
      .showDefault();
  command.option("--out", options->out, "rig to write, with the second device where it was found");
  command.footer(
      "Exit status: 0 found, 1 the motion cannot tell (no rig is written), 2 bad input, 130 Ctrl-C (the samples are "
      "kept).\n"
      "Example:  presa device calibrate config/rigs/pinch_cube_percro.xml --rehearse 7 --out out/calibrated.xml\n"
      "          presa device calibrate config/rigs/pinch_cube_percro.xml --record out/link.csv --rehearse 7");
  command.action([options, command, &status] {
    options->rehearsal = command.given("--rehearse");
    status = device::calibrate(*options);
  });
}

}  // namespace presa
