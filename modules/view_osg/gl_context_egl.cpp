#include "modules/view_osg/gl_context_egl.h"

#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <array>
#include <cstdio>
#include <stdexcept>
#include <string>

namespace presa::view {
namespace {

[[noreturn]] void fail(const std::string& step) {
  std::array<char, 16> code;
  std::snprintf(code.data(), code.size(), "0x%04x", static_cast<unsigned>(eglGetError()));
  throw std::runtime_error(step + " failed (EGL error " + code.data() + ")");
}

EGLDisplay openDisplay() {
  const auto get_display =
      reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
  if (!get_display) fail("finding eglGetPlatformDisplayEXT");
  const EGLDisplay display = get_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  if (display == EGL_NO_DISPLAY) fail("eglGetPlatformDisplayEXT for the surfaceless platform");
  return display;
}

EGLConfig chooseConfig(EGLDisplay display) {
  constexpr std::array<EGLint, 15> kWanted{EGL_SURFACE_TYPE,
                                           EGL_PBUFFER_BIT,
                                           EGL_RENDERABLE_TYPE,
                                           EGL_OPENGL_BIT,
                                           EGL_RED_SIZE,
                                           8,
                                           EGL_GREEN_SIZE,
                                           8,
                                           EGL_BLUE_SIZE,
                                           8,
                                           EGL_DEPTH_SIZE,
                                           24,
                                           EGL_ALPHA_SIZE,
                                           0,
                                           EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (!eglChooseConfig(display, kWanted.data(), &config, 1, &count) || count == 0)
    fail("eglChooseConfig for an 8-8-8/24 pixel buffer");
  return config;
}

}  // namespace

EglContext::EglContext(int width, int height) {
  display_ = openDisplay();
  if (!eglInitialize(display_, nullptr, nullptr)) fail("eglInitialize");
  try {
    if (!eglBindAPI(EGL_OPENGL_API)) fail("eglBindAPI for OpenGL");
    const EGLConfig config = chooseConfig(display_);
    const std::array<EGLint, 5> size{EGL_WIDTH, width, EGL_HEIGHT, height, EGL_NONE};
    surface_ = eglCreatePbufferSurface(display_, config, size.data());
    if (surface_ == EGL_NO_SURFACE) fail("eglCreatePbufferSurface");
    context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, nullptr);
    if (context_ == EGL_NO_CONTEXT) fail("eglCreateContext");
    makeCurrent();
  } catch (...) {
    release();
    throw;
  }
}

EglContext::~EglContext() { release(); }

void EglContext::makeCurrent() {
  if (!eglMakeCurrent(display_, surface_, surface_, context_)) fail("eglMakeCurrent");
}

void EglContext::release() noexcept {
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  if (context_) eglDestroyContext(display_, context_);
  if (surface_) eglDestroySurface(display_, surface_);
  // not eglTerminate: there is one display per process, which another view may use
  eglReleaseThread();
}

}  // namespace presa::view
