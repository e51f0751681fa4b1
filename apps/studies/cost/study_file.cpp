#include <filesystem>

#include "apps/studies/cost/factors.h"
#include "apps/studies/cost/metrics.h"
#include "apps/studies/cost/plan.h"
#include "apps/studies/cost/study_schema.h"
#include "framework/input/folders.h"
#include "framework/input/input.h"
#include "framework/scene/xml/schema.h"
#include "framework/scene/xml/xml.h"

namespace presa::cost {
namespace {

using xml::Element;

constexpr const char* kRoot = "accuracy_cost";

const xml::Schema& schema() {
  static const xml::Schema compiled(schemas::accuracy_cost);
  return compiled;
}

/// Path of the file that an attribute names, relative to the study file; checked for permission to read it.
std::string beside(const Element& root, const std::string& attribute, Diagnostics& diagnostics) {
  const std::filesystem::path folder = std::filesystem::path(root.where().file).parent_path();
  const std::string path = root.attribute(attribute);
  if (path.empty()) return {};
  const std::string file = (folder / path).lexically_normal().string();
  input::checkNamed(root.where(attribute), file, diagnostics);
  return file;
}

std::vector<std::string> setsIn(const Element& parent) {
  std::vector<std::string> sets;
  for (const Element& set : parent.children("set"))
    sets.push_back(set.attribute("path") + "=" + set.attribute("value"));
  return sets;
}

std::vector<std::string> splitAtCommas(const std::string& text) {
  std::vector<std::string> parts{""};
  for (const char c : text) {
    if (c == ',')
      parts.emplace_back();
    else if (c != ' ' || !parts.back().empty())
      parts.back() += c;
  }
  return parts;
}

Factor readFactor(const Element& element, const Scene& scene, const std::string& folder, Diagnostics& diagnostics) {
  const std::string name = element.attribute("name");
  if (element.children("value").empty())
    return makeFactor(name, splitAtCommas(element.attribute("values")), scene, folder, element.where("name"),
                      diagnostics);
  Factor factor{name, {}};
  for (const Element& value : element.children("value"))
    factor.values.push_back({value.attribute("name"), setsIn(value)});
  return factor;
}

std::optional<SentenceRule> readRule(const Element& element) {
  using Kind = SentenceRule::Kind;
  static const std::pair<const char*, Kind> kKinds[] = {
      {"below", Kind::kBelow}, {"cheapest", Kind::kCheapest}, {"halving", Kind::kHalving},  {"compare", Kind::kCompare},
      {"front", Kind::kFront}, {"order", Kind::kOrder},       {"failures", Kind::kFailures}};
  for (const auto& [name, kind] : kKinds) {
    if (element.name() != name) continue;
    return SentenceRule{kind,
                        element.attribute("metric"),
                        element.attribute("knob"),
                        element.attribute("a"),
                        element.attribute("b"),
                        element.number("limit", 0)};
  }
  return std::nullopt;
}

Study::Reference kindOf(const Element& reference) {
  const std::string kind = reference.attribute("kind");
  return kind == "analytic" ? Study::Reference::kAnalytic
         : kind == "none"   ? Study::Reference::kNone
                            : Study::Reference::kRefined;
}

void checkMetric(const Element& element, const std::string& attribute, Diagnostics& diagnostics) {
  const std::string name = element.attribute(attribute);
  if (element.hasAttribute(attribute) && findMetric(name) == nullptr)
    diagnostics.error(804, element.where(attribute),
                      "there is no metric " + quote(name) + didYouMean(name, metricNames()));
}

void checkRule(const Element& element, const std::vector<std::vector<Factor>>& grids, Diagnostics& diagnostics) {
  checkMetric(element, "metric", diagnostics);
  if (!element.hasAttribute("knob")) return;
  const std::string knob = element.attribute("knob");
  std::vector<std::string> names, values;  // a knob may stand in several grids
  for (const std::vector<Factor>& grid : grids) {
    for (const Factor& factor : grid) {
      names.push_back(factor.name);
      if (factor.name != knob) continue;
      for (const FactorValue& value : factor.values) values.push_back(value.name);
    }
  }
  if (values.empty()) {
    diagnostics.error(806, element.where("knob"), "this study has no knob " + quote(knob) + didYouMean(knob, names));
    return;
  }
  for (const char* side : {"a", "b"}) {
    const std::string wanted = element.attribute(side);
    if (element.hasAttribute(side) && std::find(values.begin(), values.end(), wanted) == values.end())
      diagnostics.error(806, element.where(side),
                        "knob " + quote(knob) + " has no value " + quote(wanted) + didYouMean(wanted, values));
  }
}

void readHead(const Element& root, const std::string& file, const Request& request, Study& study,
              Diagnostics& diagnostics) {
  study.file = file;
  study.name = root.attribute("name");
  chooseFolder(request, study);
  study.title = root.attribute("title");
  study.description = root.attribute("description");
  study.inputs.scene = beside(root, "scene", diagnostics);
  study.inputs.rig = request.rig.empty() ? beside(root, "rig", diagnostics) : request.rig;
  study.inputs.sets = setsIn(root);
  study.inputs.sets.insert(study.inputs.sets.end(), request.sets.begin(), request.sets.end());
  study.duration = root.number("duration", 0);
  study.seed = static_cast<std::uint64_t>(root.number("seed", 1));
  study.repeats = static_cast<int>(root.number("repeats", 5));
  study.compared = {root.attribute("compared_from"), root.attribute("compared_to")};
  study.steady = {root.attribute("steady_from"), root.attribute("steady_to")};
}

}  // namespace

bool isStudyFile(const std::string& file) {
  input::Refusal refusal;  // ignored: reading the whole file reports the problem
  const auto in = input::open(file, xml::Document::kMaxBytes, refusal);
  std::string start(4096, '\0');
  start.resize(
      static_cast<std::size_t>(std::max<std::ptrdiff_t>(in ? input::readSome(*in, start.data(), start.size()) : 0, 0)));
  return start.find(std::string("<") + kRoot) != std::string::npos;
}

std::vector<std::vector<Factor>> readStudyFile(const std::string& file, const Request& request, Study& study,
                                               Diagnostics& diagnostics) {
  const auto document = xml::Document::load(file, diagnostics);
  if (!document || !document->validate(schema(), diagnostics)) return {};
  document->writeDefaults(schema());
  const Element root = document->root();
  readHead(root, file, request, study, diagnostics);
  if (diagnostics.hasErrors()) return {};
  for (const Element& reference : root.children("reference")) {
    study.reference_kind = kindOf(reference);
    for (const Element& level : reference.children("level")) study.reference.push_back(setsIn(level));
    if (study.reference_kind == Study::Reference::kRefined && study.reference.size() == 1)
      diagnostics.error(807, reference.where(), "a reference needs at least two levels, found one",
                        "the difference between two levels shows how well the reference is known; without any, the "
                        "rates are raised to 5000 Hz and beyond");
  }
  Diagnostics scene_findings;  // ignored: reported by planStudy()
  const Loaded base = loadWorld(study.inputs, {}, scene_findings);
  std::vector<std::vector<Factor>> grids;
  for (const Element& grid : root.children("grid")) {
    std::vector<Factor>& factors = grids.emplace_back();
    for (const Element& factor : grid.children("knob")) {
      if (base.world) factors.push_back(readFactor(factor, base.world->scene, study.folder, diagnostics));
    }
    std::erase_if(factors, [](const Factor& factor) { return factor.values.empty(); });
  }
  for (const Element& element : root.children()) {
    if (element.name() == "metric") {
      checkMetric(element, "name", diagnostics);
      study.metrics.push_back(element.attribute("name"));
    } else if (const auto rule = readRule(element)) {
      checkRule(element, grids, diagnostics);
      study.sentences.push_back(*rule);
    }
  }
  return grids;
}

}  // namespace presa::cost
