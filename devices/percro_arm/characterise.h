#pragma once
#include "devices/percro_arm/parameters.h"
#include "devices/percro_arm/characterisation/characterisation.h"

namespace presa::percro {

/// Everything below, for `presa device characterise percro_arm`: the modelled arm beside [Bergamasco2006].
Characterisation characterise(const Parameters& parameters);

std::vector<Characteristic> figures(const Parameters& parameters);
std::vector<DevicePlot> plots(const Parameters& parameters);
std::vector<Assumption> assumptions(const Parameters& parameters);

/// Largest jump of the reported position when both motors of the differential pass a count at once, from the encoders [m].
double measuredStep(const Parameters& parameters, double length);

}  // namespace presa::percro
