#pragma once
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace presa {

/// Where a value came from. line and column count from 1; 0: unknown.
struct SourceLocation {
  std::string file;  ///< path as the user gave it, or "--set" / "command line"
  int line = 0;      ///< from 1; 0: unknown
  int column = 0;    ///< from 1, in characters; 0: unknown
};

/// One finding about user input. Printed as
///   file:line:col: error[E203]: what is wrong, what was found, what is allowed   (warning[W203] for a warning)
///     help: what to do
struct Diagnostic {
  /// A warning leaves the input usable; an error makes the load fail.
  enum class Severity { kWarning, kError };
  Severity severity = Severity::kError;  ///< printed as "error[E…]" or "warning[W…]"
  /// E1xx reading, well-formedness and schema, E2xx scene, E3xx mesh, E4xx rig and devices, E5xx graph, E6xx recording,
  /// E7xx view, E8xx studies of cost, E9xx experiments.
  int code = 0;
  std::string message;   ///< what is wrong, what was found, what is allowed; no full stop
  std::string help;      ///< may be empty
  SourceLocation where;  ///< an empty file: not known
};

/// Collects every finding of one load, so that a user sees all of them at once. Keeps the first 50 (errors before
/// warnings) and says how many more there were.
class Diagnostics {
 public:
  /// 203: E203.
  void error(int code, const SourceLocation& where, std::string message, std::string help = {}) {
    add({Diagnostic::Severity::kError, code, std::move(message), std::move(help), where});
  }
  /// 203: W203.
  void warning(int code, const SourceLocation& where, std::string message, std::string help = {}) {
    add({Diagnostic::Severity::kWarning, code, std::move(message), std::move(help), where});
  }

  bool hasErrors() const noexcept { return errors_ > 0; }               ///< an error was reported, kept or dropped
  std::size_t errorCount() const noexcept { return errors_; }           ///< errors reported, the dropped ones included
  const std::vector<Diagnostic>& all() const noexcept { return all_; }  ///< kept findings in the order of reports
  std::string text() const;  ///< sorted by file, line, column; one after another in the format of Diagnostic

  static constexpr std::size_t kLimit = 50;  ///< findings kept

 private:
  void add(Diagnostic diagnostic);
  std::vector<Diagnostic> all_;
  std::size_t errors_ = 0;
  std::size_t dropped_ = 0;
};

/// One finding in the format of Diagnostic, safe for a terminal, without a final newline.
std::string format(const Diagnostic& diagnostic);

/// Thrown by code that cannot go on; carries every finding. what() is diagnostics().text().
class InputError : public std::runtime_error {
 public:
  explicit InputError(Diagnostics diagnostics);                             ///< what() is their text()
  const Diagnostics& diagnostics() const noexcept { return diagnostics_; }  ///< every finding of the load

 private:
  Diagnostics diagnostics_;
};

/// 'value' for use in a message: at most 60 characters, control characters shown as '?'.
std::string quote(const std::string& value);
/// The candidate nearest to `word` by edit distance (optimal string alignment, ignoring case), or "" when none is
/// close: one typing error is allowed in up to five letters, two in six, one more for every three further letters.
std::string nearestName(const std::string& word, const std::vector<std::string>& candidates);
/// " (did you mean 'x'?)" or "".
std::string didYouMean(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace presa
