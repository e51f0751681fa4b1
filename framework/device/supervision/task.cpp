#include "framework/device/supervision/task.h"

#include <charconv>

namespace presa {
namespace {

/// Writes fields one after another, each ended by a zero byte; a field is cut at its first zero byte.
class Writer {
 public:
  Writer& operator<<(const std::string& field) {
    text_ += field.substr(0, field.find('\0'));
    text_ += '\0';
    return *this;
  }
  Writer& operator<<(int number) { return *this << std::to_string(number); }
  Writer& operator<<(const SourceLocation& where) { return *this << where.file << where.line << where.column; }
  std::string text_;
};

class Reader {
 public:
  explicit Reader(std::string_view text) : rest_(text) {}
  bool atEnd() const { return rest_.empty(); }
  std::string text() {
    const std::size_t end = rest_.find('\0');
    std::string field(rest_.substr(0, end));
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    return field;
  }
  int number() {
    const std::string field = text();
    int value = 0;
    std::from_chars(field.data(), field.data() + field.size(), value);
    return value;
  }
  SourceLocation where() {
    SourceLocation location;
    location.file = text();
    location.line = number();
    location.column = number();
    return location;
  }

 private:
  std::string_view rest_;
};

}  // namespace

std::string packed(const SupervisorTask& task) {
  Writer writer;
  writer << task.rig_file << task.binding.role << task.binding.driver << task.binding.where;
  for (const auto& [key, setting] : task.binding.settings) writer << key << setting.value << setting.where;
  return writer.text_;
}

SupervisorTask unpackedTask(std::string_view text) {
  Reader reader(text);
  SupervisorTask task;
  task.rig_file = reader.text();
  task.binding.role = reader.text();
  task.binding.driver = reader.text();
  task.binding.where = reader.where();
  while (!reader.atEnd()) {
    DeviceBinding::Setting& setting = task.binding.settings[reader.text()];
    setting.value = reader.text();
    setting.where = reader.where();
  }
  return task;
}

std::string packed(const Diagnostics& findings) {
  Writer writer;
  for (const Diagnostic& finding : findings.all()) {
    writer << static_cast<int>(finding.severity) << finding.code << finding.where << finding.message << finding.help;
  }
  return writer.text_;
}

Diagnostics unpackedFindings(std::string_view text) {
  Reader reader(text);
  Diagnostics findings;
  while (!reader.atEnd()) {
    const bool warning = static_cast<Diagnostic::Severity>(reader.number()) == Diagnostic::Severity::kWarning;
    const int code = reader.number();
    const SourceLocation where = reader.where();
    std::string message = reader.text(), help = reader.text();
    if (warning)
      findings.warning(code, where, std::move(message), std::move(help));
    else
      findings.error(code, where, std::move(message), std::move(help));
  }
  return findings;
}

std::string packed(const std::vector<std::string>& lines) {
  Writer writer;
  for (const std::string& line : lines) writer << line;
  return writer.text_;
}

std::vector<std::string> unpackedLines(std::string_view text) {
  Reader reader(text);
  std::vector<std::string> lines;
  while (!reader.atEnd()) lines.push_back(reader.text());
  return lines;
}

}  // namespace presa
