#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "framework/core/diagnostics/diagnostics.h"

/// A Doric building of blocks that a hand can hold, generated from sourced proportions.
namespace presa::temple {

/// Contents of a file of config/temple. Lengths without a unit are in modules (half a column's lower diameter).
struct Proportions {
  std::string name;
  bool upright = false;  ///< in the ruins the blocks stand apart from each other instead of lying as they fell
  double module = 0;     ///< of the model [m]
  double full_size = 0;  ///< module of the building itself [m]; 0: not known
  struct Stone {
    double density = 0, lightest = 0,
           heaviest = 0;    ///< [kg/m^3], [kg], [kg]: mass = density * volume, clamped to lightest..heaviest
    double joint = 0;       ///< gap between blocks side by side [m]
    int chips = 0;          ///< number per block
    double chip_depth = 0;  ///< [m]
  } stone;
  struct Steps {
    int count = 0;
    double height = 0, tread = 0;
    /// How far the top step goes on beside and behind the outermost columns' axes; the front edge is at kBeforeAxis. A
    /// lone column has steps at the front only: they are a piece of its building's.
    double beyond = kBeforeAxis;
    static constexpr double kBeforeAxis = 1.15;
  } steps;
  struct Column {
    double height = 0;  ///< including the capital
    double upper_diameter = 0, entasis = 0;
    int drums = 0, flutes = 0;
    double capital_height = 0, abacus_width = 0;
    double dowel_width = 0, dowel_depth = 0;
    double tenon_height = 0, tenon_play = 0, tenon_chamfer = 0;  ///< 0: the file gives none
    bool tenon = false;  ///< the capital has one, and the drum below it a mortise
  } column;
  struct Entablature {
    std::vector<double> intervals;  ///< distances between the columns' axes
    double depth = 0;
    double architrave_height = 0, taenia_height = 0;
    double triglyph_width = 0, frieze_height = 0, band_height = 0;
    double cornice_height = 0, cornice_projection = 0;
    int cornice_blocks = 0;
    double metope_width = 0;  ///< as wide as it is high, unless the file says otherwise
    /// Distance between triglyph axes.
    double triglyphSpacing() const { return triglyph_width + metope_width; }
  };
  std::optional<Entablature> entablature;
  struct Pediment {
    double height = 0;  ///< fraction of the cornice's length
    double raking_height = 0;
    int tiles = 0;  ///< per slope
    double tile_height = 0;
  };
  std::optional<Pediment> pediment;
};

/// Reads and checks a file, or the shipped building of that name ("first", "column", "facade"; with the measures of the
/// Parthenon "parthenon_column", "parthenon_facade"). Errors go to
/// `diagnostics`; the result is valid only if there are none. Never throws for bad input.
///   E970 format version  E971 drums, capital and dowels that do not fit each other
///   E972 triglyphs that do not fit the columns  E973 pediment without cornice, too steep or too flat
///   E975 masses  E976 no shipped building of that name
Proportions readProportions(const std::string& file, Diagnostics& diagnostics);
Proportions shippedProportions(const std::string& name, Diagnostics& diagnostics);
std::vector<std::string> shippedNames();
/// Plans whose measures a size can have: "vitruvius", "parthenon". The first task has its own for either.
std::vector<std::string> shippedPlans();
/// Gives the capitals their tenons. E188: the file, `name`, has no measures of them.
void addTenons(Proportions& proportions, const std::string& name, Diagnostics& diagnostics);
/// Name of the shipped building of this size after this plan, and back.
std::string buildingName(const std::string& size, const std::string& plan);
std::pair<std::string, std::string> sizeAndPlan(const std::string& building);

}  // namespace presa::temple
