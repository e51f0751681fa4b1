#pragma once
/// Texts of config/temple/*.xml, embedded at build time.
namespace presa::temple::shipped {
extern const char* const column;
extern const char* const facade;
}  // namespace presa::temple::shipped
