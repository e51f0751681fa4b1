#pragma once
/// Texts of config/temple, embedded at build time.
namespace presa::temple::shipped {
extern const char* const column;
extern const char* const facade;
extern const char* const first;
extern const char* const parthenon_column;
extern const char* const parthenon_facade;
extern const char* const ruins_column;
extern const char* const ruins_facade;
extern const char* const words_en;
extern const char* const words_it;
}  // namespace presa::temple::shipped
