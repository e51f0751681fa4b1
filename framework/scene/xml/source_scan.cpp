#include "framework/scene/xml/source_scan.h"

namespace presa::xml {
namespace {

bool isSpace(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) {}

  SourceScan run() {
    if (startsWith("\xEF\xBB\xBF")) index_ += 3;  // a byte order mark has no column
    while (!atEnd() && step()) {
    }
    return std::move(scan_);
  }

 private:
  bool atEnd() const { return index_ >= text_.size(); }
  char current() const { return text_[index_]; }
  bool startsWith(std::string_view word) const { return text_.substr(index_, word.size()) == word; }

  void advance() {
    const auto byte = static_cast<unsigned char>(text_[index_++]);
    if (byte == '\n') {
      ++at_.line;
      at_.column = 1;
    } else if (index_ >= text_.size() || (static_cast<unsigned char>(text_[index_]) & 0xC0U) != 0x80U) {
      ++at_.column;  // counted once, at the last byte of a character
    }
  }
  void skipSpace() {
    while (!atEnd() && isSpace(current())) advance();
  }
  bool skipPast(std::string_view end) {
    while (!atEnd() && !startsWith(end)) advance();
    if (atEnd()) return false;
    for (std::size_t i = 0; i < end.size(); ++i) advance();
    return true;
  }
  std::string word(std::string_view stops) {
    const std::size_t first = index_;
    while (!atEnd() && !isSpace(current()) && stops.find(current()) == std::string_view::npos) advance();
    return std::string(text_.substr(first, index_ - first));
  }

  /// Scans one piece of markup or one character of text. False: stop.
  bool step() {
    if (current() != '<') {
      if (!isSpace(current())) noteText();
      advance();
      return true;
    }
    if (startsWith("<!--")) return skipPast("-->");
    if (startsWith("<?")) return skipPast("?>");
    if (startsWith("<![CDATA[")) {
      noteText();
      return skipPast("]]>");
    }
    if (startsWith("<!DOCTYPE")) {
      scan_.doctype = at_;
      return false;
    }
    if (startsWith("</")) return endTag();
    return startTag();
  }

  void noteText() {
    if (scan_.open.empty()) return;
    Position& text = scan_.tags[scan_.open.back()].text;
    if (text.line == 0) text = at_;
  }

  bool endTag() {
    const Position at = at_;
    advance();
    advance();
    const std::string name = word(">");
    if (scan_.open.empty()) return false;
    if (scan_.tags[scan_.open.back()].name != name) {
      scan_.mismatch = MismatchedEnd{name, at, scan_.open.back()};
      return false;
    }
    scan_.open.pop_back();
    return skipPast(">");
  }

  bool startTag() {
    ScannedTag tag;
    tag.at = at_;
    advance();
    tag.name = word("/><");
    if (tag.name.empty()) return false;
    while (true) {
      skipSpace();
      if (atEnd()) return false;
      if (current() == '>' || current() == '/') break;
      if (!attribute(tag)) return false;
    }
    if (scan_.tags.size() == kMaxElements) {
      scan_.crowded = ScannedAttribute{{}, tag.at};
      return false;
    }
    const bool is_empty = current() == '/';
    if (!is_empty) scan_.open.push_back(scan_.tags.size());
    scan_.tags.push_back(std::move(tag));
    return skipPast(">");
  }

  bool attribute(ScannedTag& tag) {
    ScannedAttribute attribute;
    attribute.at = at_;
    attribute.name = word("=/><\"'");
    skipSpace();
    if (attribute.name.empty()) return false;
    if (!value()) {
      scan_.broken_attribute = std::move(attribute);
      return false;
    }
    if (tag.attributes.size() == kMaxAttributes) {
      scan_.crowded = std::move(attribute);
      return false;
    }
    tag.attributes.push_back(std::move(attribute));
    return true;
  }

  bool value() {
    if (atEnd() || current() != '=') return false;
    advance();
    skipSpace();
    if (atEnd() || (current() != '"' && current() != '\'')) return false;
    const char quote = current();
    advance();
    while (!atEnd() && current() != quote && current() != '<') advance();
    if (atEnd() || current() == '<') return false;
    advance();
    return true;
  }

  std::string_view text_;
  std::size_t index_ = 0;
  Position at_{1, 1};
  SourceScan scan_;
};

}  // namespace

SourceScan scanSource(std::string_view text) { return Scanner(text).run(); }

}  // namespace presa::xml
