#pragma once
#include <optional>
#include <string>
#include <vector>

#include "framework/core/diagnostics/diagnostics.h"

/// A Doric building in blocks that hands can hold, from proportions that name their sources.
namespace presa::temple {

/// What a file under config/temple says. Lengths are in modules (half of a column's lower diameter) where no unit stands.
struct Proportions {
  std::string name;
  double module = 0;  ///< [m]
  struct Stone {
    double density = 0, lightest = 0,
           heaviest = 0;    ///< [kg/m^3], [kg], [kg]: mass = density * volume, kept between both
    double joint = 0;       ///< between blocks side by side [m]
    int chips = 0;          ///< of every block
    double chip_depth = 0;  ///< [m]
  } stone;
  struct Steps {
    int count = 0;
    double height = 0, tread = 0;
  } steps;
  struct Column {
    double height = 0;  ///< with the capital
    double upper_diameter = 0, entasis = 0;
    int drums = 0, flutes = 0;
    double capital_height = 0, abacus_width = 0;
    double dowel_width = 0, dowel_depth = 0;
  } column;
  struct Entablature {
    std::vector<double> intervals;  ///< between the columns' axes
    double depth = 0;
    double architrave_height = 0, taenia_height = 0;
    double triglyph_width = 0, frieze_height = 0, band_height = 0;
    double cornice_height = 0, cornice_projection = 0;
    int cornice_blocks = 0;
    /// Centre to centre of triglyphs: metopes are as wide as high.
    double triglyphSpacing() const { return triglyph_width + frieze_height; }
  };
  std::optional<Entablature> entablature;
  struct Pediment {
    double height = 0;  ///< part of the cornice's length
    double raking_height = 0;
    int tiles = 0;  ///< of each slope
    double tile_height = 0;
  };
  std::optional<Pediment> pediment;
};

/// Reads and checks a file, or the shipped building of that name ("column", "facade"). All findings go to `diagnostics`; the result is
/// meaningful only when that has no errors. Never throws for bad input.
///   E970 format version  E971 drums, capital and dowels that do not fit each other  E972 triglyphs that do not fit the columns
///   E973 pediment without cornice, too steep or too flat  E975 masses  E976 no shipped building of that name
Proportions readProportions(const std::string& file, Diagnostics& diagnostics);
Proportions shippedProportions(const std::string& name, Diagnostics& diagnostics);
std::vector<std::string> shippedNames();

}  // namespace presa::temple
