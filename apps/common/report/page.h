#pragma once
#include <string>

namespace presa::page {

/// Beginning and end of a self-contained page. `style`: rules of this page, in addition to those of all pages.
std::string head(const std::string& title, const std::string& style = {});
std::string tail();
/// The style sheet of every page.
const char* style();
/// A figure rendered for a page, as a file of its own, with the style definitions of the page.
std::string picture(const std::string& figure_html, const std::string& title);

}  // namespace presa::page
