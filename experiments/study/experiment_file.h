#pragma once
#include <string>

namespace presa {

/// A file that ships below the folder experiments, wherever the program runs: PRESA_EXPERIMENTS may name that folder, else it is looked
/// for above the program and in the working directory. Throws InputError E610 with the folders that were tried.
std::string experimentFile(const std::string& name);

}  // namespace presa
