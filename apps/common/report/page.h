#pragma once
#include <string>

namespace presa::page {

/// A self-contained page: what stands before and after its content.
std::string head(const std::string& title);
std::string tail();
/// The figure, as rendered for a page, as a file of its own: what the page defines goes with it.
std::string picture(const std::string& figure_html, const std::string& title);

}  // namespace presa::page
