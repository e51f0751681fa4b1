#pragma once
#include <string>

#include "devices/percro_arm/characterisation/characterisation.h"

namespace presa::device {

struct CharacteriseOptions {
  std::string driver;           ///< folder under devices/
  std::string out;              ///< folder for report.html and characteristics.json; empty: none
  std::string format = "text";  ///< format of the output: text or json
};

/// `presa device characterise`: exit status 0 when every figure that is printed agrees, 1 when one does not. Throws
/// InputError: E470 no such driver, E471 it has no figures, E472 nothing can be written there.
int characterise(const CharacteriseOptions& options);

/// "54.3", "70 to 80", ">= 1".
std::string numberText(double value);
std::string printedText(const Characteristic& figure);
/// "agrees, fitted", "differs", "follows" …
std::string verdictText(const Characteristic& figure);

std::string table(const Characterisation& characterisation, bool color);
std::string json(const Characterisation& characterisation);
/// One self-contained page.
std::string page(const Characterisation& characterisation);

}  // namespace presa::device
