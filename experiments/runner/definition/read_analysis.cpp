#include <algorithm>
#include <set>

#include "experiments/runner/definition/read.h"
#include "experiments/runner/definition/read_parts.h"
#include "experiments/runner/definition/row.h"
#include "framework/scene/xml/value_rule.h"

namespace presa::experiment {

const NameList kPlaceNames{"session", "block", "repeat", "trial"};

namespace {

using xml::Element;

enum Code { kNoSuchVariable = 940, kNoNumber = 941, kNamedTwice = 942, kNotGrouping = 943, kNoSuchPart = 944 };

bool isNumber(const std::string& text) {
  double value = 0;
  return xml::readNumber(text, value) == xml::NumberKind::kFinite;
}

/// Reads one element of the analysis and checks its attributes against the variables of a trial.
class Reader {
 public:
  Reader(const Element& element, const Experiment& experiment, const std::vector<Variable>& variables,
         Diagnostics& diagnostics)
      : element_(element), experiment_(experiment), variables_(variables), diagnostics_(diagnostics) {}

  /// A variable with numeric values.
  std::string number(const char* attribute) { return numbers(attribute).empty() ? "" : text(attribute); }
  NameList numbers(const char* attribute) {
    return each(attribute, [&](const Variable& variable) {
      if (variable.kind == Variable::Kind::kColumn && !holdsNumbers(variable.name))
        error(kNoNumber, attribute,
              "column " + quote(variable.name) + " contains words, " + attribute + " needs numbers");
    });
  }
  /// A variable that groups trials.
  std::string group(const char* attribute) { return groups(attribute).empty() ? "" : text(attribute); }
  NameList groups(const char* attribute) {
    return each(attribute, [&](const Variable& variable) {
      if (variable.kind == Variable::Kind::kMeasure || variable.kind == Variable::Kind::kQuality)
        error(kNotGrouping, attribute, quote(variable.name) + " is measured per trial and cannot group trials",
              "group by the column of a factor, or by session, block, repeat or trial");
    });
  }
  NameList strata(const char* attribute) {
    static const NameList allowed{"subject", "session", "block"};
    NameList all = xml::splitWords(text(attribute));
    for (const std::string& name : all) {
      if (std::find(allowed.begin(), allowed.end(), name) == allowed.end())
        error(kNoSuchVariable, attribute, "not a grouping variable: " + quote(name) + didYouMean(name, allowed),
              "subject, session, block");
    }
    return all;
  }
  /// Number, or name of a column; may be empty.
  std::string numberOrColumn(const char* attribute) {
    return text(attribute).empty() || isNumber(text(attribute)) ? text(attribute) : number(attribute);
  }
  /// A device role or a free body, checked through its sample names; unchecked when the scene was not read.
  std::string part(const char* attribute, const std::string& asked, const char* what) {
    const std::string name = text(attribute);
    if (experiment_.samples.size() == 0 || experiment_.samples.find(name + "." + asked)) return name;
    NameList known;
    for (const std::string& sample : experiment_.samples.all()) {
      if (sample.ends_with("." + asked)) known.push_back(sample.substr(0, sample.size() - asked.size() - 1));
    }
    error(kNoSuchPart, attribute,
          std::string("the scene has no ") + what + " " + quote(name) + didYouMean(name, known));
    return name;
  }
  std::string text(const char* attribute) const { return element_.attribute(attribute); }
  std::size_t count(const char* attribute) const { return static_cast<std::size_t>(element_.number(attribute, 0)); }
  bool isTrue(const char* attribute) const { return element_.boolean(attribute, true); }
  std::optional<double> optional(const char* attribute) const {
    if (!element_.hasAttribute(attribute)) return std::nullopt;
    return element_.number(attribute, 0);
  }

 private:
  template <class Check>
  NameList each(const char* attribute, Check check) {
    NameList all;
    if (element_.flawed(attribute)) return all;
    for (const std::string& name : xml::splitWords(text(attribute))) {
      const auto found =
          std::find_if(variables_.begin(), variables_.end(), [&](const Variable& v) { return v.name == name; });
      if (found == variables_.end()) {
        error(kNoSuchVariable, attribute, "unknown variable " + quote(name) + didYouMean(name, names()),
              "columns, measures and quality figures of the experiment");
        continue;
      }
      if (std::find(all.begin(), all.end(), name) != all.end()) {
        error(kNamedTwice, attribute, quote(name) + " is named twice");
        continue;
      }
      check(*found);
      all.push_back(name);
    }
    return all;
  }
  void error(Code code, const char* attribute, const std::string& what, const std::string& help = {}) {
    diagnostics_.error(code, element_.where(attribute), what, help);
  }
  bool holdsNumbers(const std::string& column) const {
    for (const Factor& factor : experiment_.factors) {
      for (std::size_t c = 0; c < factor.columns.size(); ++c) {
        if (factor.columns[c].name != column) continue;
        return std::all_of(factor.levels.begin(), factor.levels.end(),
                           [&](const auto& level) { return c >= level.size() || isNumber(level[c]); });
      }
    }
    return true;
  }
  NameList names() const {
    NameList all;
    for (const Variable& variable : variables_) all.push_back(variable.name);
    return all;
  }

  const Element& element_;
  const Experiment& experiment_;
  const std::vector<Variable>& variables_;
  Diagnostics& diagnostics_;
};

statistics::PsychometricModel modelOf(Reader& in) {
  using Shape = statistics::PsychometricShape;
  statistics::PsychometricModel model;
  const std::string shape = in.text("shape");
  model.shape = shape == "logistic" ? Shape::kLogistic : shape == "weibull" ? Shape::kWeibull : Shape::kNormal;
  if (in.text("guess") == "lapse")
    model.guess.reset();
  else
    model.guess = in.optional("guess");
  model.lapse = in.optional("lapse");
  model.lapse_max = in.optional("lapse_max").value_or(0.06);
  return model;
}

wanted::Any read(const std::string& kind, Reader& in) {
  if (kind == "spearman")
    return wanted::Spearman{in.number("y"), in.numbers("x"), in.strata("within"), in.count("permutations")};
  if (kind == "cell_means") return wanted::CellMeans{in.number("y"), in.groups("by")};
  if (kind == "margin") return wanted::Margin{in.number("grip"), in.number("slip"), in.groups("by")};
  if (kind == "log_linear") return wanted::LogLinear{in.number("y"), in.numbers("x")};
  if (kind == "depth_control") return wanted::DepthControl{in.number("force"), in.number("stiffness"), in.numbers("x")};
  if (kind == "psychometric") {
    wanted::Psychometric what{
        in.number("x"), in.number("y"),       in.groups("by"), modelOf(in), in.numberOrColumn("standard"),
        0.75,           in.count("bootstrap")};
    const double middle = what.model.guess ? 0.5 * (1 + *what.model.guess) : 0.5;
    what.threshold = in.optional("threshold").value_or(middle);
    return what;
  }
  if (kind == "bars") return wanted::Bars{in.number("y"), in.group("rows"), in.group("columns"), in.group("color")};
  if (kind == "means")
    return wanted::MeansPlot{in.number("y"),      in.number("x"),    in.group("rows"),
                             in.group("columns"), in.number("line"), in.text("interval") == "within_subject"};
  if (kind == "margins")
    return wanted::MarginPlot{in.number("grip"), in.number("slip"), in.number("x"),
                              in.group("color"), in.group("shape"), in.text("log") == "x"};
  if (kind == "scatter")
    return wanted::Scatter{in.number("x"), in.number("y"), in.group("color"), in.isTrue("diagonal")};
  return wanted::TimeCourse{in.part("finger", "fn", "device"), in.part("body", "lift", "free body"), in.text("subject"),
                            static_cast<int>(in.count("trial"))};
}

Variable::Kind kindOf(const Experiment& experiment, const std::string& name) {
  using Kind = Variable::Kind;
  for (const Factor& factor : experiment.factors) {
    for (const Column& column : factor.columns) {
      if (column.name == name) return Kind::kColumn;
    }
  }
  for (const Measure& measure : experiment.measures) {
    if (name == measure.name || name == measure.name + "_1" || name == measure.name + "_2") return Kind::kMeasure;
  }
  const bool quality = std::find(kQualityNames.begin(), kQualityNames.end(), name) != kQualityNames.end();
  return quality ? Kind::kQuality : Kind::kOther;
}

}  // namespace

std::vector<Variable> variablesOf(const Experiment& experiment) {
  std::vector<Variable> all;
  for (const RowColumn& column : rowColumns(experiment))
    all.push_back({column.name, column.unit, column.description, kindOf(experiment, column.name)});
  for (const std::string& name : kPlaceNames) {
    const auto is_it = [&](const Variable& variable) { return variable.name == name; };
    if (std::none_of(all.begin(), all.end(), is_it)) all.push_back({name, "", "", Variable::Kind::kPlace});
  }
  return all;
}

void readAnalysis(const Element& root, Experiment& experiment, Diagnostics& diagnostics) {
  const std::vector<Variable> variables = variablesOf(experiment);
  for (const Element& analysis : root.children("analysis")) {
    experiment.analysis.confidence = analysis.number("confidence", 0.95);
    experiment.analysis.seed = static_cast<std::uint64_t>(analysis.number("seed", 1));
    for (const Element& element : analysis.children()) {
      Reader reader(element, experiment, variables, diagnostics);
      experiment.analysis.items.push_back({element.name(), element.attribute("title"),
                                           element.boolean("headline", true), read(element.name(), reader)});
    }
  }
}

std::optional<Experiment> readRecorded(const std::string& file, Diagnostics& diagnostics) {
  const auto document = xml::Document::load(file, diagnostics);
  if (!document || !document->validate(experimentSchema(), diagnostics)) return std::nullopt;
  document->writeDefaults(experimentSchema());
  const Element root = document->root();
  Experiment experiment;
  experiment.file = file;
  experiment.name = root.attribute("name");
  experiment.title = root.attribute("title");
  experiment.description = root.attribute("description");
  experiment.seed = static_cast<std::uint64_t>(root.number("seed", 1));
  readFactors(root, experiment, diagnostics);
  readVaried(root, experiment, diagnostics);
  readProcedure(root, experiment, diagnostics);
  readDesign(root, experiment, diagnostics);
  for (const Element& measure : root.children("measure"))
    experiment.measures.push_back(
        {measure.attribute("name"), measure.attribute("unit"), measure.attribute("description"), {}, {}, 0});
  readAnalysis(root, experiment, diagnostics);
  if (diagnostics.hasErrors()) return std::nullopt;
  return experiment;
}

}  // namespace presa::experiment
