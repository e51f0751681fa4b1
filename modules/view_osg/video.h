#pragma once
#include <sys/types.h>

#include <cstdint>
#include <osg/Image>
#include <string>

namespace presa::view {

/// A video of a run, encoded by ffmpeg through a pipe, whole up to its last frame however the program ends. So many
/// frames per simulated second at any speed of the machine; a missing frame repeats the previous one.
/// Thread: the view's; waits for ffmpeg.
class Video {
 public:
  /// `rate`: frames per simulated second. Throws InputError: E705 there is no ffmpeg.
  Video(const std::string& file, double rate);
  ~Video();
  Video(const Video&) = delete;
  Video& operator=(const Video&) = delete;

  /// Whether a frame is due at this simulated time [s].
  bool due(double time) const { return trouble_.empty() && wanted(time) > written_; }
  /// Adds the frame of that time, RGB. All frames have the size of the first.
  void add(const osg::Image& picture, double time);
  /// Ends the video; returns "" or the reason for a failure.
  std::string finish();

 private:
  std::uint64_t wanted(double time) const { return static_cast<std::uint64_t>(time * rate_) + 1; }
  void start(int width, int height);
  void write(const osg::Image& picture);

  std::string file_, trouble_;
  double rate_;
  pid_t process_ = -1;
  int pipe_ = -1;
  int width_ = 0, height_ = 0;
  std::uint64_t written_ = 0;
};

}  // namespace presa::view
