#include "devices/simulated_subject/model/subject_parameters.h"

#include <algorithm>
#include <cmath>

namespace presa::subject {
namespace {

constexpr std::array<SubjectParameter, Population::kCount> kPopulation{{
    {"hand_mass", "kg", &SubjectParameters::hand_mass, uniform(0.05, 0.10), "Hajian & Howe 1997"},
    {"grip_stiffness", "N/m", &SubjectParameters::grip_stiffness, uniform(150, 600), "Hajian & Howe 1997"},
    {"grip_damping", "N s/m", &SubjectParameters::grip_damping, uniform(2, 5), "Hajian & Howe 1997"},
    {"posture_stiffness", "N/m", &SubjectParameters::posture_stiffness, uniform(150, 400),
     "Hajian & Howe 1997, elbow on the table"},
    {"posture_damping", "N s/m", &SubjectParameters::posture_damping, uniform(4, 8),
     "Hajian & Howe 1997, elbow on the table"},
    {"force_cv", "1", &SubjectParameters::force_cv, uniform(0.02, 0.04), "Jones, Hamilton & Wolpert 2002"},
    {"force_weber", "1", &SubjectParameters::force_weber, uniform(0.07, 0.10), "Pang, Tan & Durlach 1991"},
    {"reaction", "s", &SubjectParameters::reaction, uniform(0.13, 0.18),
     "twice the slip reflex of Johansson & Westling 1987"},
    {"loosening", "1/s", &SubjectParameters::loosening, logNormal(0.4, 0.4), "GUESS"},
    {"safety_margin", "1", &SubjectParameters::safety_margin, uniform(0.10, 0.40), "Westling & Johansson 1984"},
    {"slip_threshold", "m", &SubjectParameters::slip_threshold, logNormal(0.7e-3, 0.3),
     "between 0.4 mm (Ho & Srinivasan 1996) and 1 mm (Durlach 1989)"},
    {"clearance", "1", &SubjectParameters::clearance, absNormal(2, 0.5), "GUESS: 2.5 % one-sided"},
    {"device_mass", "kg", &SubjectParameters::device_mass, constant(0.10), "GUESS: Bergamasco et al. give none"},
    {"arm_stiffness", "N/m", &SubjectParameters::arm_stiffness, constant(50), "GUESS"},
    {"level_stiffness", "N/m", &SubjectParameters::level_stiffness, constant(1000), "GUESS: the digits are one hand"},
    {"muscle_time", "s", &SubjectParameters::muscle_time, constant(0.3),
     "GUESS: a force source at rest, a spring above 0.5 Hz"},
    {"force_noise", "N", &SubjectParameters::force_noise, constant(0.02), "GUESS"},
    {"noise_time", "s", &SubjectParameters::noise_time, constant(0.15), "GUESS"},
    {"noise_shared", "1", &SubjectParameters::noise_shared, constant(0.8), "GUESS"},
    {"tremor", "1", &SubjectParameters::tremor, constant(0.01), "Novak & Newell 2017: 8 to 12 Hz, grows with force"},
    {"position_noise", "m", &SubjectParameters::position_noise, constant(0.05e-3), "GUESS"},
    {"slip_threshold_sd", "1", &SubjectParameters::slip_threshold_sd, constant(0.2), "GUESS"},
    {"seen_slip", "m", &SubjectParameters::seen_slip, constant(0), "not watched for"},
    {"seen_reaction", "s", &SubjectParameters::seen_reaction, constant(0.22), "GUESS"},
    {"counts_device", "1", &SubjectParameters::counts_device, constant(1),
     "dF = k dX of Bergamasco et al., section 3.6.4"},
    {"finger_resolution", "m", &SubjectParameters::finger_resolution, constant(0), "left out"},
    {"extra_grip", "N", &SubjectParameters::extra_grip, constant(0), "left out"},
    {"trial_sd", "1", &SubjectParameters::trial_sd, constant(0), "left out"},
}};

constexpr std::string_view kHalfAperture = "half the 0.4 mm aperture of Ho & Srinivasan 1996";

}  // namespace

std::optional<Level> levelNamed(std::string_view name) noexcept {
  for (const Level level : {Level::kL0, Level::kL1, Level::kL2}) {
    if (nameOf(level) == name) return level;
  }
  return std::nullopt;
}

std::string_view nameOf(Level level) noexcept {
  switch (level) {
    case Level::kL0:
      return "L0";
    case Level::kL1:
      return "L1";
    case Level::kL2:
      return "L2";
  }
  return "";
}

double Spread::draw(RandomStream& stream) const {
  switch (kind) {
    case Kind::kConstant:
      return a;
    case Kind::kUniform:
      return stream.uniform(a, b);
    case Kind::kLogNormal:
      return stream.logNormal(a, b);
    case Kind::kAbsNormal:
      return std::abs(a + b * stream.normal());
  }
  return a;
}

double drawResolution(std::uint64_t seed, std::uint64_t subject, std::uint64_t trial) {
  RandomStream stream(seed, "device resolution", itemOf(subject, trial));
  return kDeviceResolution.draw(stream);
}

Population::Population(Level level) : parameters_(kPopulation) {
  if (level == Level::kL0) return;
  for (SubjectParameter& parameter : parameters_) {
    if (parameter.name != "finger_resolution" && parameter.name != "position_noise") continue;
    parameter.spread = constant(0.2e-3);
    parameter.source = kHalfAperture;
  }
  if (level == Level::kL2) set("muscle_time", constant(0));
}

bool Population::set(std::string_view name, Spread spread) noexcept {
  const auto found = std::find_if(parameters_.begin(), parameters_.end(),
                                  [&](const SubjectParameter& parameter) { return parameter.name == name; });
  if (found == parameters_.end()) return false;
  found->spread = spread;
  return true;
}

void Population::silence() noexcept {
  for (const char* name : {"force_cv", "force_noise", "tremor", "position_noise", "force_weber", "clearance"})
    set(name, constant(0));
}

SubjectParameters Population::draw(std::uint64_t seed, std::uint64_t subject) const {
  // one stream per parameter, so changing or adding a parameter does not affect the others
  const std::uint64_t person = RandomStream(seed, "traits", subject).bits();
  SubjectParameters parameters;
  for (const SubjectParameter& parameter : parameters_) {
    RandomStream stream(person, parameter.name);
    parameters.*parameter.value = parameter.spread.draw(stream);
  }
  return parameters;
}

}  // namespace presa::subject
