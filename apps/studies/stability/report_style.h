#pragma once

namespace presa::stability {

/// Style sheet of the page of the hard cases, in addition to that of all pages.
extern const char* const kReportStyle;
/// Script of that page: opens all cases, or the one that the address names. The page works without it.
extern const char* const kReportScript;

}  // namespace presa::stability
