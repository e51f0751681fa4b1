#include "framework/geometry/long_work.h"

#include <utility>

namespace presa {
namespace {

// of the thread that loads: a picture that builds something on its own thread has nobody to tell
thread_local LongWorkListener::Heard listener;

}  // namespace

LongWorkListener::LongWorkListener(Heard heard) { listener = std::move(heard); }
LongWorkListener::~LongWorkListener() { listener = nullptr; }

GoOn toldToListener(std::string what) {
  if (!listener) return {};
  return [what = std::move(what)](double share) { return !listener || listener(what, share); };
}

}  // namespace presa
