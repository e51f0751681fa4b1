#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "experiments/stability/cases.h"
#include "experiments/stability/methods.h"
#include "experiments/stability/pile.h"

namespace presa::stability::card_house {
namespace {

// as in the scene; the lean in degrees
constexpr double kLength = 0.088, kThickness = 0.0003, kLean = 20, kCardFriction = 0.9, kMass = 0.0018;
constexpr double kStands = 30, kFalls = 5;  // [s]

/// Friction at the feet from which on two leaning cards stand. Each card turns about its foot under its weight, held by
/// the horizontal force H at the other end: H L cos a = m g (L/2 sin a - t/2 cos a), and H <= mu m g.
double pairLimit() { return (std::tan(kLean * std::numbers::pi / 180) - kThickness / kLength) / 2; }
/// The same for the lower cards of the house, each of which carries 3/4 of a card more at its upper end.
double houseLimit() { return 2 * pairLimit() * (0.5 + 0.75) / (1 + 0.75); }

/// `friction` at the feet: the geometric mean of cloth and card.
std::vector<std::string> withFriction(double friction) {
  const std::string cloth = number(friction * friction / kCardFriction);
  return {"material/cloth/friction/dynamic=" + cloth, "material/cloth/friction/static=" + cloth};
}
/// Two cards lean on each other; the others lie far away.
std::vector<std::string> onlyOnePair() {
  std::vector<std::string> sets;
  double x = 2;
  for (const std::string card : {"right0", "right1", "roof", "top0", "top1"}) {
    sets.push_back("body/" + card + "/pos=" + number(x++) + " 0 " + number(card == "roof" ? 0.00015 : 0.0315));
    if (card != "roof") sets.push_back("body/" + card + "/euler_deg=90 0 0");
  }
  return sets;
}

std::vector<Finding> build(bool house, double friction, bool stands, const Method& method) {
  std::vector<std::string> sets = withFriction(friction);
  sets.emplace_back("dynamics/sleeping=false");
  if (!house) std::ranges::copy(onlyOnePair(), std::back_inserter(sets));
  Pile cards(specOf("card_house.xml", sets + method, stands ? kStands : kFalls), house ? "top0" : "left0");
  cards.run();
  if (!stands) return {cards.heightLeft("the feet slide below a friction of " + number(pairLimit()))};
  return {cards.displacement(0.1), cards.energy(kMass * 9.81 * kLength / 2, 0.5)};
}

}  // namespace

Case make() {
  Case result;
  result.name = "card_house";
  result.title = "A house of playing cards stands; two cards stand or slide by the friction at their feet";
  result.source =
      "Statics of two leaning plates: the foot needs tan(lean) <= 2 mu + thickness / length; thin plates that meet "
      "in edges are hard for contacts.";
  result.oracle = "At 20 degrees two cards stand from a friction of 0.1803 on and the house from 0.2576 on.";
  result.scene = "card_house.xml";
  const auto add = [&result](bool house, double share, const Method& method) {
    const double friction = share * (house ? houseLimit() : pairLimit());
    const bool stands = share > 1;
    Trial trial;
    trial.parameters = {{"cards", house ? "house of 7" : "2"},
                        {"friction over the limit", number(share)},
                        {"cards then", stands ? "stand" : "slide"}};
    trial.method = method.name;
    if (!method.own()) trial.expected = Verdict::kUnstable;
    trial.run = [=] { return build(house, friction, stands, method); };
    trial.quick = method.own();
    result.trials.push_back(std::move(trial));
  };
  for (const Method& method : {ours(), twentyIterations()}) {
    for (const double share : {1.05, 1.5, 3.0}) add(true, share, method);
    for (const double share : {1.02, 2.0}) add(false, share, method);
  }
  for (const double share : {0.98, 0.5}) add(false, share, ours());
  return result;
}

}  // namespace presa::stability::card_house
