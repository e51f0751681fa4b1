#pragma once
#include <string>

namespace presa {

/// The number with so many decimals, "12.30"; never a negative zero.
std::string fixed(double value, int decimals);
/// The number with so many significant digits, "0.0123"; never a negative zero.
std::string significant(double value, int digits);

}  // namespace presa
