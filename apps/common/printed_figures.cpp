#include "apps/common/printed_figures.h"

#include <filesystem>

#include "apps/common/number_text.h"
#include "apps/common/printed_schema.h"
#include "framework/scene/xml/schema.h"
#include "framework/scene/xml/xml.h"

namespace presa {
namespace {

using xml::Element;

std::vector<std::string> printedSets(const Element& parent) {
  std::vector<std::string> sets;
  for (const Element& set : parent.children("set"))
    sets.push_back(set.attribute("path") + "=" + set.attribute("value"));
  return sets;
}

PrintedValues readValues(const Element& element) {
  return {element.attribute("name"), element.attribute("unit"), element.attribute("path"), element.numbers("values")};
}

Printed readPrinted(const std::string& file, const Element& root) {
  Printed printed;
  printed.file = file;
  printed.source = root.attribute("source");
  for (const Element& today : root.children("today")) printed.today = printedSets(today);
  for (const Element& vary : root.children("vary")) printed.vary.push_back(readValues(vary));
  for (const Element& lost : root.children("until_lost")) {
    printed.until_lost.emplace();
    static_cast<PrintedValues&>(*printed.until_lost) = readValues(lost);
    printed.until_lost->sets = printedSets(lost);
  }
  for (const Element& figure : root.children("figure"))
    printed.figures.push_back({figure.attribute("what"), figure.attribute("where"), figure.attribute("printed"),
                               figure.attribute("unit"), figure.attribute("measure"), figure.number("factor", 1),
                               figure.attribute("note"), figure.attribute("wrong")});
  return printed;
}

}  // namespace

std::optional<Printed> printedOf(const std::string& scene_file, Diagnostics& diagnostics) {
  static const xml::Schema schema(schemas::printed);
  const std::filesystem::path scene(scene_file);
  const std::filesystem::path file = scene.parent_path() / "printed" / scene.filename();
  std::error_code none;
  if (!scene.has_filename() || !std::filesystem::exists(file, none)) return std::nullopt;
  const auto document = xml::Document::load(file.string(), diagnostics);
  if (!document || !document->validate(schema, diagnostics)) return std::nullopt;
  return readPrinted(file.string(), document->root());
}

std::string measuredText(const PrintedFigure& figure, const nlohmann::json& summary) {
  if (figure.measure.empty()) return "–";
  const nlohmann::json::json_pointer at(figure.measure);
  if (!summary.contains(at)) return "–";
  const nlohmann::json& value = summary.at(at);
  if (value.is_string()) return value.get<std::string>();
  return value.is_number() ? significant(value.get<double>() * figure.factor, 4) : "–";
}

}  // namespace presa
