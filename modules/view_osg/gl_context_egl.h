#pragma once

namespace presa::view {

/// An OpenGL context without a display: EGL, surfaceless platform, pixel buffer. Works without X and without a graphics
/// card (Mesa's software renderer).
class EglContext {
 public:
  /// Makes the context current on the calling thread. Throws std::runtime_error naming the failed step.
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
