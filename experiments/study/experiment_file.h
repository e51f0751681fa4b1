#pragma once
#include <string>

namespace presa {

/// Path of a file below the folder experiments. That folder is named by PRESA_EXPERIMENTS; otherwise it is searched for
/// above the program and in the working directory. Throws InputError E615 with the folders that were tried.
std::string experimentFile(const std::string& name);

}  // namespace presa
