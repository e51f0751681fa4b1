#pragma once
#include "experiments/runner/definition/definition.h"
#include "experiments/runner/definition/sample_names.h"
#include "framework/scene/xml/schema.h"
#include "framework/scene/xml/xml.h"

/// The steps of reading an experiment, in calling order. Each reports its findings and continues with the valid parts.
namespace presa::experiment {

void readFactors(const xml::Element& root, Experiment& experiment, Diagnostics& diagnostics);
void readVaried(const xml::Element& root, Experiment& experiment, Diagnostics& diagnostics);
/// Reads method, stimulus and task. readObserver() follows after the measures, which a simulated observer refers to.
void readProcedure(const xml::Element& root, Experiment& experiment, Diagnostics& diagnostics);
void readObserver(const xml::Element& root, Experiment& experiment, Diagnostics& diagnostics);
void readQualityNames(Experiment& experiment);
void readDesign(const xml::Element& root, Experiment& experiment, Diagnostics& diagnostics);
/// Call it before readPhases.
void readParticipant(const xml::Element& root, Experiment& experiment);
void readPhases(const xml::Element& root, Experiment& experiment, Diagnostics& diagnostics);
void readTexts(const xml::Element& root, Experiment& experiment, Diagnostics& diagnostics);
void readWatch(const xml::Element& root, Experiment& experiment, Diagnostics& diagnostics);
/// Reads the event at the start of a phase, over the names its guards may use; E916 when no material can change
/// friction.
void readEvent(const xml::Element& element, const SymbolTable& seen, const Experiment& experiment, Phase& phase,
               Diagnostics& diagnostics);
/// Reads reactions as measures, before all others.
void readReactions(const xml::Element& root, Experiment& experiment, Diagnostics& diagnostics);
/// Reads measures and exclusion rules.
void readMeasures(const xml::Element& root, Experiment& experiment, Diagnostics& diagnostics);
/// Call after every step that defines a variable of a trial.
void readAnalysis(const xml::Element& root, Experiment& experiment, Diagnostics& diagnostics);

const xml::Schema& experimentSchema();

/// Registers the attribute `name` of a column as a variable of a trial; E903 when the name is taken.
void claimName(const xml::Element& element, Experiment& experiment, Diagnostics& diagnostics);

}  // namespace presa::experiment
