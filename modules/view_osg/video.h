#pragma once
#include <sys/types.h>

#include <cstdint>
#include <osg/Image>
#include <string>

namespace presa::view {

/// A film of a run, written by ffmpeg, whose input is a pipe. 30 pictures for each simulated second, whatever the machine's pace: one that
/// is not there is the one before again. Thread: the view's; waits for ffmpeg.
class Video {
 public:
  static constexpr double kRate = 30;  ///< [Hz]

  /// Throws InputError: E705 there is no ffmpeg.
  explicit Video(const std::string& file);
  ~Video();
  Video(const Video&) = delete;
  Video& operator=(const Video&) = delete;

  /// A picture is wanted at this simulated time [s].
  bool due(double time) const { return trouble_.empty() && wanted(time) > written_; }
  /// The picture at that time, RGB. All pictures are as large as the first.
  void add(const osg::Image& picture, double time);
  /// Ends the film; empty, or why there is none.
  std::string finish();

 private:
  static std::uint64_t wanted(double time) { return static_cast<std::uint64_t>(time * kRate) + 1; }
  void start(int width, int height);
  void write(const osg::Image& picture);

  std::string file_, trouble_;
  pid_t process_ = -1;
  int pipe_ = -1;
  int width_ = 0, height_ = 0;
  std::uint64_t written_ = 0;
};

}  // namespace presa::view
