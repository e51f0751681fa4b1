#pragma once
#include <vector>

#include "apps/studies/cost/result.h"

namespace presa::cost {

/// Writes every decimated mesh that the study's knobs ask for. Throws InputError when a source cannot be read.
std::vector<Result::Mesh> makeMeshes(const Study& study);

}  // namespace presa::cost
