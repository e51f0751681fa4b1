#pragma once
#include <string>
#include <vector>

namespace presa::svg {

/// A table as CSV text, with one heading each column. NaN leaves the cell empty.
class Csv {
 public:
  /// Headings carry their unit: "commanded [N]".
  explicit Csv(const std::vector<std::string>& headings);
  void row(const std::vector<double>& values);
  /// A text in front, such as the name of a curve.
  void row(const std::string& name, const std::vector<double>& values);
  const std::string& text() const noexcept { return text_; }

 private:
  std::string text_;
};

/// A figure with links below it that save it, as a picture and as the numbers that are drawn. They need no script and
/// no request: the files are data: addresses. `css_class` is that of the figure, `more` follows the picture inside it.
std::string withSaveLinks(const std::string& css_class, const std::string& svg_element, const std::string& more,
                          const std::string& title, const Csv& csv);

/// The picture as a file of its own, in the light colours of the page, without CSS variables, which many programs do not
/// know.
std::string standalone(const std::string& svg_element);

}  // namespace presa::svg
