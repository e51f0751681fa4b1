#pragma once

namespace presa::view {

/// An OpenGL context without a display: EGL, surfaceless platform, pixel buffer. Works on a machine with neither X
/// nor a graphics card (Mesa renders in software).
class EglContext {
 public:
  /// Makes it current on the calling thread. Throws std::runtime_error saying which step failed.
  EglContext(int width, int height);
  ~EglContext();
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;

  void makeCurrent();

 private:
  void release() noexcept;
  void* display_ = nullptr;
  void* surface_ = nullptr;
  void* context_ = nullptr;
};

}  // namespace presa::view
