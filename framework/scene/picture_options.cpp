#include "framework/scene/picture_options.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <vector>

#include "framework/core/diagnostics/printable.h"

namespace presa {
namespace {

const std::string kCameraAllowed =
    "EYE:TARGET in metres, such as 0.5,-0.8,0.4:0,0,0.1, or one of front, back, left, right, top, iso";

std::vector<std::string> split(const std::string& text, char delimiter) {
  std::vector<std::string> parts{""};
  for (const char c : text) c == delimiter ? parts.emplace_back() : parts.back() += c, void();
  return parts;
}

/// The whole of `text` as a number; none if it is anything else.
template <class Number>
std::optional<Number> numberOf(const std::string& text) {
  Number value{};
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && stop == end ? std::optional(value) : std::nullopt;
}

/// Three coordinates; otherwise `trouble` says why not.
Vec3 pointOf(const std::string& text, const char* which, std::string& trouble) {
  const std::string found = ", found '" + printable(text) + "'";
  const std::vector<std::string> parts = split(text, ',');
  Vec3 point = Vec3::Zero();
  if (parts.size() != 3) {
    trouble = std::string(which) + " needs three numbers x,y,z" + found;
    return point;
  }
  for (std::size_t i = 0; i < 3 && trouble.empty(); ++i) {
    const std::optional<double> value = numberOf<double>(parts[i]);
    if (!value || !std::isfinite(*value))
      trouble = std::string(which) + " has '" + printable(parts[i]) + "', which is not a finite number" + found;
    else if (!(std::abs(*value) <= kCameraReach))
      trouble = std::string(which) + " lies beyond 10 km from the origin" + found;
    else
      point[static_cast<Eigen::Index>(i)] = *value;
  }
  return point;
}

CameraPlace placeOf(const std::string& text, std::string& trouble) {
  const std::vector<std::string> ends = split(text, ':');
  if (ends.size() != 2) {
    trouble = "it is neither a name nor an eye and a target, found '" + printable(text) + "'" +
              didYouMean(text, {kViewSideNames.begin(), kViewSideNames.end()});
    return {};
  }
  CameraPlace place;
  place.eye = pointOf(ends[0], "the eye", trouble);
  if (trouble.empty()) place.target = pointOf(ends[1], "the target", trouble);
  if (!trouble.empty()) return {};
  const double distance = (place.target - place.eye).norm();
  std::array<char, 96> words{};
  if (distance == 0)
    trouble = "eye and target are the same point, found '" + printable(text) + "'";
  else if (distance < kCameraNearest || distance > kCameraFarthest) {
    std::snprintf(words.data(), words.size(), "eye and target have to be %g to %g m apart, found %g m", kCameraNearest,
                  kCameraFarthest, distance);
    trouble = words.data();
  }
  return place;
}

std::string coordinate(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.5f", value);
  std::string shortest = text.data();
  shortest.erase(shortest.find_last_not_of('0') + 1);
  if (shortest.back() == '.') shortest.pop_back();
  return shortest == "-0" ? "0" : shortest;
}

std::string pointText(const Vec3& point) {
  return coordinate(point.x()) + ',' + coordinate(point.y()) + ',' + coordinate(point.z());
}

}  // namespace

std::optional<std::variant<ViewSide, CameraPlace>> parseCamera(const std::string& text, Diagnostics& diagnostics) {
  const auto* const side = std::ranges::find(kViewSideNames, text);
  if (side != kViewSideNames.end()) return static_cast<ViewSide>(side - kViewSideNames.begin());
  std::string trouble;
  const CameraPlace place = placeOf(text, trouble);
  if (trouble.empty()) return place;
  diagnostics.error(706, {"--camera", 0, 0}, trouble, kCameraAllowed);
  return std::nullopt;
}

std::string cameraText(const CameraPlace& place) { return pointText(place.eye) + ':' + pointText(place.target); }

void parsePictureSize(const std::string& text, PictureOptions& options, Diagnostics& diagnostics) {
  const std::vector<std::string> sides = split(text, 'x');
  const auto side = [&](std::size_t i) { return i < sides.size() ? numberOf<int>(sides[i]) : std::nullopt; };
  const std::optional<int> width = side(0), height = side(1);
  const auto fits = [](int length) { return length >= kPictureSmallest && length <= kPictureLargest; };
  std::string trouble;
  if (sides.size() != 2 || !width || !height)
    trouble = "a size is a width and a height in whole pixels, found '" + printable(text) + "'";
  else if (!fits(*width) || !fits(*height))
    trouble = "a picture cannot have this size, found " + printable(text);
  else
    options.width = *width, options.height = *height;
  if (!trouble.empty())
    diagnostics.error(707, {"--picture-size", 0, 0}, trouble, "WxH such as 1920x1080, each from 64 to 8192");
}

}  // namespace presa
