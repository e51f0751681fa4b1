#include "framework/core/diagnostics/diagnostics.h"

#include <algorithm>
#include <cstdio>
#include <tuple>
#include <utility>

#include "framework/core/diagnostics/printable.h"

namespace presa {
namespace {

constexpr std::size_t kQuotedLength = 60;

bool isContinuationByte(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

std::string positionText(const SourceLocation& where) {
  std::string text = where.file;
  if (where.line > 0) text += ":" + std::to_string(where.line);
  if (where.line > 0 && where.column > 0) text += ":" + std::to_string(where.column);
  return text.empty() ? text : text + ": ";
}

}  // namespace

void Diagnostics::add(Diagnostic diagnostic) {
  const bool is_error = diagnostic.severity == Diagnostic::Severity::kError;
  if (is_error) ++errors_;
  if (all_.size() < kLimit) {
    all_.push_back(std::move(diagnostic));
    return;
  }
  ++dropped_;
  if (!is_error) return;
  // the list is full: an error replaces the last warning
  const auto last_warning = std::find_if(
      all_.rbegin(), all_.rend(), [](const Diagnostic& d) { return d.severity == Diagnostic::Severity::kWarning; });
  if (last_warning != all_.rend()) *last_warning = std::move(diagnostic);
}

std::string Diagnostics::text() const {
  std::vector<const Diagnostic*> sorted;
  for (const Diagnostic& diagnostic : all_) sorted.push_back(&diagnostic);
  std::stable_sort(sorted.begin(), sorted.end(), [](const Diagnostic* a, const Diagnostic* b) {
    return std::tie(a->where.file, a->where.line, a->where.column) <
           std::tie(b->where.file, b->where.line, b->where.column);
  });
  std::string text;
  for (const Diagnostic* diagnostic : sorted) text += format(*diagnostic) + "\n";
  if (dropped_ > 0) text += "... and " + std::to_string(dropped_) + " more\n";
  return text;
}

std::string format(const Diagnostic& diagnostic) {
  const bool is_error = diagnostic.severity == Diagnostic::Severity::kError;
  char code[32];
  std::snprintf(code, sizeof code, is_error ? "error[E%03d]: " : "warning[W%03d]: ", diagnostic.code);
  // messages quote text of files and other processes
  std::string text = printable(positionText(diagnostic.where)) + code + printableLines(diagnostic.message);
  if (!diagnostic.help.empty()) text += "\n  help: " + printableLines(diagnostic.help);
  return text;
}

InputError::InputError(Diagnostics diagnostics)
    : std::runtime_error(diagnostics.text()), diagnostics_(std::move(diagnostics)) {}

std::string quote(const std::string& value) {
  std::string text = "'";
  std::size_t characters = 0;
  for (const char c : value) {
    if (!isContinuationByte(c) && ++characters > kQuotedLength) return text + "...'";
    const auto byte = static_cast<unsigned char>(c);
    text += byte < 0x20 || byte == 0x7F ? '?' : c;
  }
  return text + "'";
}

}  // namespace presa
