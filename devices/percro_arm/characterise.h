#pragma once
#include "devices/percro_arm/characterisation/characterisation.h"
#include "devices/percro_arm/parameters.h"

namespace presa::percro {

/// The modelled arm beside [Bergamasco2006], for `presa device characterise percro_arm`.
Characterisation characterise(const Parameters& parameters);

std::vector<Characteristic> figures(const Parameters& parameters);
std::vector<DevicePlot> plots(const Parameters& parameters);
std::vector<Assumption> assumptions(const Parameters& parameters);

/// Max jump of the reported position when both motors of the differential pass a count at once, measured on the encoder
/// model [m].
double measuredStep(const Parameters& parameters, double length);

}  // namespace presa::percro
