#include <algorithm>
#include <cctype>
#include <charconv>
#include <utility>

#include "experiments/runner/definition/expression.h"

namespace presa::experiment {
namespace {

struct Syntax {
  std::size_t at;
  std::string message, help;
};
struct Unknown {
  std::string message, help;
};

}  // namespace

/// Recursive-descent parser; one function per level of the grammar.
class ExpressionParser {
 public:
  using Code = Expression::Code;
  ExpressionParser(const std::string& text, const SymbolTable& names, std::vector<Aggregate>* aggregates,
                   const SymbolTable* samples, const std::vector<std::string>* phases)
      : text_(text), names_(&names), aggregates_(aggregates), samples_(samples), phases_(phases) {}

  Expression parse() {
    advance();
    orExpression();
    if (!token_.empty()) throw Syntax{start_, "expected the end or an operator, found " + quote(token_), {}};
    return std::move(out_);
  }

 private:
  // ---- tokens

  static bool isWord(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.'; }

  void advance() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) ++at_;
    start_ = at_;
    if (at_ == text_.size()) {
      token_.clear();
      return;
    }
    const char c = text_[at_];
    if (isWord(c)) {
      while (at_ < text_.size() && (isWord(text_[at_]) || isExponentSign())) ++at_;
    } else {
      ++at_;
      if (std::string_view("<>=!").find(c) != std::string_view::npos && at_ < text_.size() && text_[at_] == '=') ++at_;
    }
    token_ = text_.substr(start_, at_ - start_);
  }

  // the minus sign in 1e-3
  bool isExponentSign() const {
    const char before = text_[at_ - 1];
    return (text_[at_] == '-' || text_[at_] == '+') && (before == 'e' || before == 'E') &&
           std::isdigit(static_cast<unsigned char>(text_[start_])) != 0;
  }

  bool take(const std::string& token) {
    if (token_ != token) return false;
    advance();
    return true;
  }

  void expect(const std::string& token) {
    if (!take(token)) throw Syntax{start_, "expected " + quote(token) + ", found " + found(), {}};
  }

  std::string found() const { return token_.empty() ? "the end" : quote(token_); }

  // ---- code

  void emit(Code code) {
    if (code != Code::kNot && code != Code::kNegate && (code < Code::kAbs || code > Code::kExp)) --depth_;
    out_.program_.push_back({code});
  }
  void push(Expression::Instruction instruction) {
    if (++depth_ > Expression::kMaxDepth) throw Syntax{start_, "the expression is too deep", "split it into several"};
    out_.program_.push_back(instruction);
  }

  // ---- grammar

  struct Nesting {
    explicit Nesting(ExpressionParser& parser) : parser_(parser) {
      if (++parser_.nesting_ > 64) throw Syntax{parser_.start_, "the expression is too deep", "split it into several"};
    }
    ~Nesting() { --parser_.nesting_; }
    ExpressionParser& parser_;
  };

  void orExpression() {
    const Nesting nesting(*this);
    andExpression();
    while (take("or")) andExpression(), emit(Code::kOr);
  }
  void andExpression() {
    notExpression();
    while (take("and")) notExpression(), emit(Code::kAnd);
  }
  void notExpression() {
    const Nesting nesting(*this);
    if (take("not")) return notExpression(), emit(Code::kNot);
    comparison();
  }
  void comparison() {
    static const std::pair<const char*, Code> kOperators[] = {
        {"<", Code::kLess},     {"<=", Code::kLessEqual},    {">", Code::kGreater}, {">=", Code::kGreaterEqual},
        {"==", Code::kEqual},   {"!=", Code::kNotEqual},     {"lt", Code::kLess},   {"le", Code::kLessEqual},
        {"gt", Code::kGreater}, {"ge", Code::kGreaterEqual}, {"eq", Code::kEqual},  {"ne", Code::kNotEqual}};
    sum();
    for (const auto& [token, code] : kOperators) {
      if (take(token)) return sum(), emit(code);
    }
    if (token_ == "=") throw Syntax{start_, "expected a comparison, found '='", "equal is written =="};
  }
  void sum() {
    product();
    for (;;) {
      if (take("+"))
        product(), emit(Code::kAdd);
      else if (take("-"))
        product(), emit(Code::kSubtract);
      else
        return;
    }
  }
  void product() {
    signedTerm();
    for (;;) {
      if (take("*"))
        signedTerm(), emit(Code::kMultiply);
      else if (take("/"))
        signedTerm(), emit(Code::kDivide);
      else
        return;
    }
  }
  void signedTerm() {
    const Nesting nesting(*this);
    if (take("-")) return signedTerm(), emit(Code::kNegate);
    term();
  }
  void term() {
    if (take("(")) return orExpression(), expect(")");
    if (token_.empty() || !isWord(token_[0]))
      throw Syntax{start_, "expected a number, a name, a function or '(', found " + found(), {}};
    if (std::isdigit(static_cast<unsigned char>(token_[0])) != 0 || token_[0] == '.') return number();
    const std::string name = token_;
    const std::size_t start = start_;
    advance();
    if (token_ == "(") return call(name, start);
    const auto slot = names_->find(name);
    if (!slot) throw Unknown{"unknown name " + quote(name) + didYouMean(name, names_->all()), namesHelp()};
    push({Code::kSlot, 0, *slot});
  }
  void number() {
    double value = 0;
    const auto [end, error] = std::from_chars(token_.data(), token_.data() + token_.size(), value);
    if (error != std::errc() || end != token_.data() + token_.size())
      throw Syntax{start_, quote(token_) + " is not a number", {}};
    push({Code::kNumber, value});
    advance();
  }
  void call(const std::string& name, std::size_t start) {
    static const std::pair<const char*, std::pair<Code, int>> kFunctions[] = {
        {"abs", {Code::kAbs, 1}}, {"sqrt", {Code::kSqrt, 1}}, {"ln", {Code::kLn, 1}},      {"exp", {Code::kExp, 1}},
        {"min", {Code::kMin, 2}}, {"max", {Code::kMax, 2}},   {"hypot", {Code::kHypot, 2}}};
    expect("(");
    for (const auto& [function, code] : kFunctions) {
      if (name != function) continue;
      orExpression();
      if (code.second == 2) expect(","), orExpression();
      expect(")");
      return emit(code.first);
    }
    aggregate(name, start);
  }

  // ---- over the samples of a phase

  void aggregate(const std::string& name, std::size_t start) {
    using Kind = Aggregate::Kind;
    static const std::pair<const char*, Kind> kKinds[] = {
        {"mean", Kind::kMean},   {"sd", Kind::kSd},     {"least", Kind::kMin},       {"most", Kind::kMax},
        {"first", Kind::kFirst}, {"last", Kind::kLast}, {"seconds", Kind::kSeconds}, {"start", Kind::kStart}};
    const auto* kind =
        std::find_if(std::begin(kKinds), std::end(kKinds), [&](const auto& k) { return name == k.first; });
    std::vector<std::string> names{"abs", "sqrt", "ln", "exp", "min", "max", "hypot"};
    if (aggregates_ != nullptr) {
      for (const auto& k : kKinds) names.emplace_back(k.first);
    }
    if (kind == std::end(kKinds) || aggregates_ == nullptr)
      throw Syntax{start, "there is no function " + quote(name) + didYouMean(name, names), {}};
    Aggregate result{kind->second, phase(), {}, {}};
    if (result.kind == Kind::kFirst || result.kind == Kind::kLast) {
      expect(",");
      result.condition = inner();
    } else if (result.kind == Kind::kSeconds && take(",")) {
      result.condition = inner();
    }
    if (result.kind != Kind::kSeconds && result.kind != Kind::kStart) {
      expect(",");
      result.value = inner();
    }
    expect(")");
    aggregates_->push_back(std::move(result));
    push({Code::kSlot, 0, names_->size() + aggregates_->size() - 1});
  }

  std::size_t phase() {
    const auto found = std::find(phases_->begin(), phases_->end(), token_);
    if (found == phases_->end())
      throw Unknown{"there is no phase " + quote(token_) + didYouMean(token_, *phases_), listed("phases: ", *phases_)};
    advance();
    return static_cast<std::size_t>(found - phases_->begin());
  }

  static std::string listed(std::string what, const std::vector<std::string>& names) {
    constexpr std::size_t kMost = 40;
    for (std::size_t i = 0; i < std::min(names.size(), kMost); ++i) what += (i == 0 ? "" : ", ") + names[i];
    return names.size() > kMost ? what + ", …" : what;
  }

  /// What the reader may write in the place of an unknown name.
  std::string namesHelp() const {
    const std::string minus = token_ == "-" ? "a name with '-' cannot stand in an expression: '-' subtracts; " : "";
    return minus +
           listed(samples_ != nullptr && names_ == samples_ ? "inside of an aggregate only samples count: " : "names: ",
                  names_->all());
  }

  // compiles an expression over samples inside an expression over measures
  Expression inner() {
    Expression outer = std::exchange(out_, {});
    const std::size_t depth = std::exchange(depth_, 0);
    const SymbolTable* names = std::exchange(names_, samples_);
    std::vector<Aggregate>* aggregates = std::exchange(aggregates_, nullptr);
    orExpression();
    names_ = names, aggregates_ = aggregates, depth_ = depth;
    return std::exchange(out_, std::move(outer));
  }

  const std::string& text_;
  const SymbolTable* names_;
  std::vector<Aggregate>* aggregates_;
  const SymbolTable* samples_;
  const std::vector<std::string>* phases_;
  std::size_t at_ = 0, start_ = 0, depth_ = 0;
  int nesting_ = 0;
  std::string token_;
  Expression out_;
};

std::optional<Expression> Expression::compile(const std::string& text, const SymbolTable& names,
                                              const SourceLocation& where, Diagnostics& diagnostics,
                                              std::vector<Aggregate>* aggregates, const SymbolTable* samples,
                                              const std::vector<std::string>* phases) {
  try {
    return ExpressionParser(text, names, aggregates, samples, phases).parse();
  } catch (const Syntax& error) {
    diagnostics.error(901, where,
                      "at character " + std::to_string(error.at + 1) + " of " + quote(text) + ": " + error.message,
                      error.help);
  } catch (const Unknown& error) {
    diagnostics.error(902, where, error.message, error.help);
  }
  return std::nullopt;
}

}  // namespace presa::experiment
