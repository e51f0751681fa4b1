#pragma once
#include <string>

#include "apps/studies/lectures/lecture.h"

namespace presa::lectures {

/// The plot as a file of its own: measured points beside the closed form, both axes logarithmic.
std::string picture(const Lecture& lecture);
/// One self-contained page: the plot, the sentences, and the figures as a table.
std::string reportHtml(const Lecture& lecture, const std::string& command);
/// One line for each point, units in the header.
std::string toCsv(const Lecture& lecture);

}  // namespace presa::lectures
