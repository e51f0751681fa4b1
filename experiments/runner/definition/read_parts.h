#pragma once
#include "experiments/runner/definition/definition.h"
#include "experiments/runner/definition/sample_names.h"
#include "framework/scene/xml/schema.h"
#include "framework/scene/xml/xml.h"

/// The steps of reading an experiment, in their order; each adds its findings and goes on with what is left.
namespace presa::experiment {

void readFactors(const xml::Element& root, Experiment& experiment, Diagnostics& diagnostics);
void readVaried(const xml::Element& root, Experiment& experiment, Diagnostics& diagnostics);
/// The method with its stimulus and task; who answers in simulation asks for measures and comes after them.
void readProcedure(const xml::Element& root, Experiment& experiment, Diagnostics& diagnostics);
void readObserver(const xml::Element& root, Experiment& experiment, Diagnostics& diagnostics);
void readQualityNames(Experiment& experiment);
void readDesign(const xml::Element& root, Experiment& experiment, Diagnostics& diagnostics);
void readPhases(const xml::Element& root, Experiment& experiment, Diagnostics& diagnostics);
void readTexts(const xml::Element& root, Experiment& experiment, Diagnostics& diagnostics);
void readWatch(const xml::Element& root, Experiment& experiment, Diagnostics& diagnostics);
/// What happens when a phase begins, over the names that its guards see; E916 when nothing in the scene can change.
void readEvent(const xml::Element& element, const Names& seen, const Experiment& experiment, Phase& phase,
               Diagnostics& diagnostics);
/// Become measures, before all others.
void readReactions(const xml::Element& root, Experiment& experiment, Diagnostics& diagnostics);
/// Measures and rules of exclusion.
void readMeasures(const xml::Element& root, Experiment& experiment, Diagnostics& diagnostics);
/// After everything that gives a trial its numbers.
void readAnalysis(const xml::Element& root, Experiment& experiment, Diagnostics& diagnostics);

const xml::Schema& experimentSchema();

/// The attribute `name` of a column becomes a name of a trial; E903 when it is one already.
void claimName(const xml::Element& element, Experiment& experiment, Diagnostics& diagnostics);

}  // namespace presa::experiment
