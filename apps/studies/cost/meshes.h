#pragma once
#include <vector>

#include "apps/studies/cost/result.h"

namespace presa::cost {

/// Writes every decimated mesh that the study's factors need. Throws InputError when a source mesh cannot be read.
std::vector<Result::Mesh> makeMeshes(const Study& study);

}  // namespace presa::cost
