#include "apps/presa/explain/callgrind_file.h"

#include <sstream>
#include <stdexcept>

namespace presa {
namespace {

/// Names come as "(7) name" the first time and "(7)" from then on.
class Names {
 public:
  std::string resolve(const std::string& text) {
    const std::size_t close = text.find(')');
    if (text.empty() || text[0] != '(' || close == std::string::npos) return text;
    std::string& name = names_[text.substr(0, close + 1)];
    if (close + 2 < text.size()) name = text.substr(close + 2);
    return name;
  }

 private:
  std::map<std::string, std::string> names_;
};

/// Second field of "position cost": position may be a number, "+3", "-2" or "*".
std::uint64_t costOf(const std::string& line) {
  std::istringstream fields(line);
  std::string position;
  std::uint64_t cost = 0;
  fields >> position >> cost;
  return cost;
}

bool startsCost(char c) { return (c >= '0' && c <= '9') || c == '+' || c == '-' || c == '*'; }

}  // namespace

std::map<std::string, FunctionCost> readCallgrind(std::istream& in) {
  std::map<std::string, FunctionCost> costs;
  Names names;
  FunctionCost* current = nullptr;
  std::string called;
  std::uint64_t calls = 0;
  bool known = false;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("events: Ir")) {
      known = true;
    } else if (line.starts_with("fn=")) {
      current = &costs[names.resolve(line.substr(3))];
    } else if (line.starts_with("cfn=")) {
      called = names.resolve(line.substr(4));
    } else if (line.starts_with("calls=")) {
      calls = std::stoull(line.substr(6));
    } else if (current != nullptr && !line.empty() && startsCost(line[0])) {
      current->instructions += costOf(line);
      if (calls > 0) costs[called].calls += calls;
      calls = 0;
    }
  }
  if (!known) throw std::runtime_error("not a callgrind file that counts instructions");
  return costs;
}

}  // namespace presa
