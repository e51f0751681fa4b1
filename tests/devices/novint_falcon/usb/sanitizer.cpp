// umockdev is preloaded, so the address sanitizer's library cannot be first; it works nevertheless.
#ifdef __SANITIZE_ADDRESS__
extern "C" const char* __asan_default_options();  // NOLINT: its name is the sanitizer's
extern "C" const char* __asan_default_options() { return "verify_asan_link_order=0"; }
#endif
