#pragma once
#include <string>

namespace presa::page {

/// A self-contained page: what stands before and after its content.
std::string head(const std::string& title);
std::string tail();

}  // namespace presa::page
