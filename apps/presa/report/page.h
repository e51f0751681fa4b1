#pragma once

namespace presa::page {

/// Style sheet and script of the report, as they stand in the page.
extern const char* const kStyle;
extern const char* const kScript;

}  // namespace presa::page
