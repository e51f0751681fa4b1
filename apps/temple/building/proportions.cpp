#include "apps/temple/building/proportions.h"

#include <cmath>
#include <cstdio>

#include "apps/temple/building/building_schemas.h"
#include "apps/temple/building/shipped.h"
#include "framework/scene/xml/schema.h"
#include "framework/scene/xml/xml.h"

namespace presa::temple {
namespace {

using xml::Element;

constexpr int kFormatMajor = 1;

const xml::Schema& schema() {
  static const xml::Schema compiled(schemas::temple);
  return compiled;
}

std::string numberText(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

/// Values of the children of one part of the file, and their positions in it.
class Part {
 public:
  explicit Part(const Element& element) : element_(element) {}
  double number(const char* name, double otherwise = 0) const {
    return element_.children(name).empty() ? otherwise : measure(name).number("value", otherwise);
  }
  int count(const char* name) const { return static_cast<int>(number(name)); }
  std::vector<double> numbers(const char* name) const { return measure(name).numbers("value"); }
  SourceLocation where(const char* name) const { return measure(name).where("value"); }

 private:
  Element measure(const char* name) const {
    const std::vector<Element> found = element_.children(name);
    return found.empty() ? element_ : found.front();
  }
  Element element_;
};

void checkVersion(const Element& root, Diagnostics& diagnostics) {
  const std::string version = root.attribute("version");
  if (root.flawed("version") || version.empty() || std::stoi(version) == kFormatMajor) return;
  diagnostics.error(970, root.where("version"),
                    "this building is written in format " + quote(version) + "; this release of Presa reads 1.0",
                    "write version=\"1.0\"");
}

Proportions::Stone readStone(const Part& part, Diagnostics& diagnostics) {
  const Proportions::Stone stone{part.number("density"), part.number("lightest"), part.number("heaviest"),
                                 part.number("joint"),   part.count("chips"),     part.number("chip_depth")};
  if (stone.lightest > stone.heaviest)
    diagnostics.error(975, part.where("lightest"),
                      "the lightest block weighs " + numberText(stone.lightest) + " kg, more than the heaviest with " +
                          numberText(stone.heaviest) + " kg",
                      "lightest <= heaviest; masses between them follow from density and volume");
  return stone;
}

Proportions::Column readColumn(const Part& part, Diagnostics& diagnostics) {
  const Proportions::Column column{
      part.number("height"),       part.number("upper_diameter"), part.number("entasis"),
      part.count("drums"),         part.count("flutes"),          part.number("capital_height"),
      part.number("abacus_width"), part.number("dowel_width"),    part.number("dowel_depth"),
      part.number("tenon_height"), part.number("tenon_play"),     part.number("tenon_chamfer")};
  const auto refuse = [&](const char* name, const std::string& message, const std::string& help) {
    diagnostics.error(971, part.where(name), message, help);
  };
  if (column.upper_diameter > 2)
    refuse("upper_diameter", "the column is " + numberText(column.upper_diameter) + " modules thick at its top",
           "at most 2, the lower diameter");
  if (column.abacus_width < column.upper_diameter)
    refuse("abacus_width", "an abacus of " + numberText(column.abacus_width) + " modules is narrower than the shaft",
           "at least the upper diameter, " + numberText(column.upper_diameter));
  const double shaft = column.height - column.capital_height;
  if (shaft < 0.5 * column.drums)
    refuse("drums", std::to_string(column.drums) + " drums share a shaft of " + numberText(shaft) + " modules",
           "a drum is at least half a module high");
  // the square hole's diagonal must leave a rim to stand on
  if (std::sqrt(2.0) * column.dowel_width > 0.75 * column.upper_diameter)
    refuse("dowel_width", "a dowel hole of " + numberText(column.dowel_width) + " modules leaves no rim to stand on",
           "at most 0.53 of the upper diameter");
  if (column.dowel_depth > 0.4 * std::min(column.capital_height, shaft / std::max(1, column.drums)))
    refuse("dowel_depth", "dowel holes of " + numberText(column.dowel_depth) + " modules meet inside a piece",
           "at most 0.4 of the lowest piece's height");
  if (column.tenon_height > column.dowel_depth)
    refuse("tenon_height", "a tenon of " + numberText(column.tenon_height) + " modules stands on the floor of its hole",
           "at most the hole's depth, " + numberText(column.dowel_depth));
  if (column.tenon_height > 0 && !(column.tenon_play > 0 && column.tenon_chamfer > 0 &&
                                   column.tenon_play + 2 * column.tenon_chamfer < column.dowel_width &&
                                   1.5 * column.tenon_chamfer < column.tenon_height))
    refuse("tenon_height", "a tenon needs play in its hole and a chamfer that leaves some of it",
           "tenon_play, and tenon_chamfer below two thirds of tenon_height");
  if (column.entasis > 0.2)
    refuse("entasis", "an entasis of " + numberText(column.entasis) + " modules is no swelling but a barrel",
           "at most 0.2");
  return column;
}

Proportions::Entablature readEntablature(const Part& part, Diagnostics& diagnostics) {
  const Proportions::Entablature e{part.numbers("intervals"),
                                   part.number("depth"),
                                   part.number("architrave_height"),
                                   part.number("taenia_height"),
                                   part.number("triglyph_width"),
                                   part.number("frieze_height"),
                                   part.number("band_height"),
                                   part.number("cornice_height"),
                                   part.number("cornice_projection"),
                                   part.count("cornice_blocks"),
                                   part.number("metope_width", part.number("frieze_height"))};
  for (const double interval : e.intervals) {
    const double triglyphs = interval / e.triglyphSpacing();
    if (triglyphs < 0.5 || std::abs(triglyphs - std::round(triglyphs)) > 1e-3)
      diagnostics.error(972, part.where("intervals"),
                        "an interval of " + numberText(interval) + " modules leaves no triglyph over every column",
                        "a multiple of triglyph and metope together, " + numberText(e.triglyphSpacing()) + " modules");
  }
  if (e.taenia_height > 0.5 * e.architrave_height)
    diagnostics.error(972, part.where("taenia_height"), "the taenia is higher than half of the architrave",
                      "at most " + numberText(0.5 * e.architrave_height));
  if (e.intervals.size() > 5)
    diagnostics.error(972, part.where("intervals"),
                      std::to_string(e.intervals.size() + 1) + " columns are more than a scene holds as blocks",
                      "at most 6 columns");
  return e;
}

Proportions::Pediment readPediment(const Part& part, const SourceLocation& where, bool has_cornice,
                                   Diagnostics& diagnostics) {
  const Proportions::Pediment pediment{part.number("height"), part.number("raking_height"), part.count("tiles"),
                                       part.number("tile_height")};
  if (!has_cornice)
    diagnostics.error(973, where, "a pediment needs a cornice to stand on, and there is no <entablature>",
                      "add an <entablature>, or take the <pediment> out");
  if (pediment.height < 0.06 || pediment.height > 0.2)
    diagnostics.error(973, part.where("height"),
                      "a pediment of " + numberText(pediment.height) + " of the cornice's length",
                      "from 0.06 to 0.2: flatter it has no stones, steeper its cornice slides off");
  return pediment;
}

Proportions read(xml::Document& document, Diagnostics& diagnostics) {
  Proportions p;
  const bool valid = document.validate(schema(), diagnostics);
  const Element root = document.root();
  const auto only = [&](const char* name) -> std::optional<Element> {
    const std::vector<Element> found = root.children(name);
    return found.empty() ? std::nullopt : std::optional(found.front());
  };
  // schema errors are reported already; the checks below need every value
  if (!valid) return p;
  checkVersion(root, diagnostics);
  p.name = root.attribute("name");
  p.upright = root.attribute("lie") == "upright";
  p.module = only("module")->number("value", 0);
  if (const auto full_size = only("full_size")) p.full_size = full_size->number("value", 0);
  p.stone = readStone(Part(*only("stone")), diagnostics);
  const Part steps(*only("steps"));
  p.steps = {steps.count("count"), steps.number("height"), steps.number("tread"),
             steps.number("beyond", Proportions::Steps::kBeforeAxis)};
  p.column = readColumn(Part(*only("column")), diagnostics);
  if (const auto entablature = only("entablature")) p.entablature = readEntablature(Part(*entablature), diagnostics);
  if (const auto pediment = only("pediment"))
    p.pediment = readPediment(Part(*pediment), pediment->where(), p.entablature.has_value(), diagnostics);
  return p;
}

}  // namespace

std::vector<std::string> shippedNames() { return {"first", "column", "facade"}; }
std::vector<std::string> shippedPlans() { return {"vitruvius", "parthenon"}; }

void addTenons(Proportions& proportions, const std::string& name, Diagnostics& diagnostics) {
  proportions.column.tenon = proportions.column.tenon_height > 0;
  if (!proportions.column.tenon)
    diagnostics.error(188, {name, 0, 0}, "the columns of this building have no measures of a tenon",
                      "give its <column> tenon_height, tenon_play and tenon_chamfer, or leave out --tenon");
}

std::string buildingName(const std::string& size, const std::string& plan) {
  return plan == "vitruvius" || size == "first" ? size : plan + "_" + size;
}

std::pair<std::string, std::string> sizeAndPlan(const std::string& building) {
  for (const std::string& plan : shippedPlans())
    if (building.starts_with(plan + "_")) return {building.substr(plan.size() + 1), plan};
  return {building, "vitruvius"};
}

Proportions readProportions(const std::string& file, Diagnostics& diagnostics) {
  const auto document = xml::Document::load(file, diagnostics);
  return document ? read(*document, diagnostics) : Proportions{};
}

Proportions shippedProportions(const std::string& name, Diagnostics& diagnostics) {
  const char* text = name == "first"              ? shipped::first
                     : name == "column"           ? shipped::column
                     : name == "facade"           ? shipped::facade
                     : name == "parthenon_column" ? shipped::parthenon_column
                     : name == "parthenon_facade" ? shipped::parthenon_facade
                                                  : nullptr;
  if (text == nullptr) {
    diagnostics.error(976, {name, 0, 0},
                      "there is no building of size " + quote(name) + didYouMean(name, shippedNames()),
                      "first, column or facade; --parameters FILE takes any other");
    return {};
  }
  const auto document = xml::Document::parse(text, "config/temple/" + name + ".xml", diagnostics);
  return document ? read(*document, diagnostics) : Proportions{};
}

}  // namespace presa::temple
