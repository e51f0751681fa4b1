#include "experiments/runner/definition/expression.h"

#include <algorithm>
#include <cmath>

namespace presa::experiment {
namespace {

bool truth(double x) noexcept { return x == x && x != 0; }

}  // namespace

SymbolTable::SymbolTable(std::vector<std::string> names) : names_(std::move(names)) {
  for (std::size_t slot = 0; slot < names_.size(); ++slot) slots_.try_emplace(names_[slot], slot);
}

std::size_t SymbolTable::add(const std::string& name) {
  const auto [known, is_new] = slots_.try_emplace(name, names_.size());
  if (is_new) names_.push_back(name);
  return known->second;
}

std::optional<std::size_t> SymbolTable::find(const std::string& name) const {
  const auto found = slots_.find(name);
  if (found == slots_.end()) return std::nullopt;
  return found->second;
}

void Expression::markSlots(std::vector<bool>& slots) const {
  for (const Instruction& now : program_) {
    if (now.code == Code::kSlot && now.slot < slots.size()) slots[now.slot] = true;
  }
}

double Expression::evaluate(std::span<const double> values) const noexcept {
  std::array<double, kMaxDepth> stack;
  std::size_t top = 0;
  for (const Instruction& now : program_) {
    if (now.code == Code::kNumber) {
      stack[top++] = now.number;
      continue;
    }
    if (now.code == Code::kSlot) {
      stack[top++] = values[now.slot];
      continue;
    }
    double& b = stack[top - 1];
    switch (now.code) {
      case Code::kNot:
        b = truth(b) ? 0 : 1;
        continue;
      case Code::kNegate:
        b = -b;
        continue;
      case Code::kAbs:
        b = std::abs(b);
        continue;
      case Code::kSqrt:
        b = std::sqrt(b);
        continue;
      case Code::kLn:
        b = std::log(b);
        continue;
      case Code::kExp:
        b = std::exp(b);
        continue;
      default:
        break;
    }
    double& a = stack[top - 2];
    switch (now.code) {
      case Code::kOr:
        a = truth(a) || truth(b);
        break;
      case Code::kAnd:
        a = truth(a) && truth(b);
        break;
      case Code::kLess:
        a = a < b;
        break;
      case Code::kLessEqual:
        a = a <= b;
        break;
      case Code::kGreater:
        a = a > b;
        break;
      case Code::kGreaterEqual:
        a = a >= b;
        break;
      case Code::kEqual:
        a = a == b;
        break;
      case Code::kNotEqual:
        a = a != b;
        break;
      case Code::kAdd:
        a += b;
        break;
      case Code::kSubtract:
        a -= b;
        break;
      case Code::kMultiply:
        a *= b;
        break;
      case Code::kDivide:
        a /= b;
        break;
      case Code::kMin:
        a = std::fmin(a, b);
        break;
      case Code::kMax:
        a = std::fmax(a, b);
        break;
      default:
        a = std::hypot(a, b);
        break;
    }
    --top;
  }
  return top == 0 ? 0 : stack[0];
}

}  // namespace presa::experiment
