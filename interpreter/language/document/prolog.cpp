#include "language/document/prolog.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/core/wording.h"

namespace lockstep::host {
namespace {

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

// Compares ASCII letters. `lower` has no others.
bool is_same_word(std::string_view text, std::string_view lower) {
  return std::equal(text.begin(), text.end(), lower.begin(), lower.end(), [](char a, char b) {
    return a == b || (is_letter(b) && a == static_cast<char>(b - 'a' + 'A'));
  });
}

bool is_version(std::string_view text) {
  return text.size() > 2 && text.starts_with("1.") &&
         std::all_of(text.begin() + 2, text.end(), is_digit);
}

// In a text of ASCII only, these say the same as UTF-8.
bool has_ascii(std::string_view encoding) {
  constexpr std::string_view kNames[] = {"us-ascii", "ascii", "iso-8859-1", "iso-8859-15",
                                         "windows-1252"};
  return std::any_of(std::begin(kNames), std::end(kNames),
                     [&](std::string_view name) { return is_same_word(encoding, name); });
}

bool is_true_of(std::string_view encoding, std::string_view text) {
  if (is_same_word(encoding, "utf-8") || is_same_word(encoding, "utf8")) return true;
  return has_ascii(encoding) && std::all_of(text.begin(), text.end(), [](char c) {
           return static_cast<unsigned char>(c) < 0x80;
         });
}

// <?xml version="1.0" encoding="UTF-8" standalone="yes"?>, of which only the version must be there.
class Declaration {
 public:
  // `at` is behind "<?xml".
  explicit Declaration(Cursor& at) : at_(at) {}

  std::optional<XmlFault> skip() {
    if (!take("version") || !is_version(value_)) return malformed();
    if (take("encoding") && !is_true_of(value_, at_.text())) {
      return XmlFault{begin_, fmt::format("the file is UTF-8, but declares '{}'", brief(value_)),
                      "write encoding=\"UTF-8\""};
    }
    if (take("standalone") && value_ != "yes" && value_ != "no") return malformed();
    begin_ = at_.position();
    at_.skip_blanks();
    if (!is_sound_ || !at_.skip("?>")) return malformed();
    return std::nullopt;
  }

 private:
  // Whether ` name = "value"` stands here. Moves behind it.
  bool take(std::string_view name) {
    if (!is_sound_) return false;
    const auto before = at_.position();
    if (!at_.skip_blanks() || !at_.skip(name)) {
      at_.go_to(before);
      return false;
    }
    at_.skip_blanks();
    is_sound_ = at_.skip('=');
    at_.skip_blanks();
    begin_ = at_.position() + 1;
    const auto value = at_.take_quoted();
    is_sound_ &= value.has_value();
    value_ = value.value_or("");
    return is_sound_;
  }

  XmlFault malformed() const {
    return {std::min(begin_, at_.text().size()), "the XML declaration is malformed",
            "write <?xml version=\"1.0\" encoding=\"UTF-8\"?>"};
  }

  Cursor& at_;
  std::size_t begin_ = at_.position();  // of the value that was taken last
  std::string_view value_;
  bool is_sound_ = true;
};

bool is_public_identifier(std::string_view text) {
  constexpr std::string_view kOthers = " \r\n-'()+,./:=?;!*#@$_%";
  return std::all_of(text.begin(), text.end(), [&](char c) {
    return is_letter(c) || is_digit(c) || kOthers.find(c) != std::string_view::npos;
  });
}

// Nothing, or ` SYSTEM "…"`, or ` PUBLIC "…" "…"`. False where it is malformed.
bool skip_external_identifier(Cursor& at) {
  if (!at.skip_blanks()) return true;
  const bool is_public = at.skip("PUBLIC");
  if (!is_public && !at.skip("SYSTEM")) return true;
  if (!at.skip_blanks()) return false;
  const auto first = at.take_quoted();
  if (!first || !is_public) return first.has_value();
  return is_public_identifier(*first) && at.skip_blanks() && at.take_quoted().has_value();
}

}  // namespace

std::optional<XmlFault> skip_instruction(Cursor& at) {
  const auto begin = at.position();
  const auto end = at.text().find("?>", begin + 2);
  if (end == std::string_view::npos)
    return XmlFault{begin, "the processing instruction is not closed", "'?>' ends it"};
  at.skip("<?");
  const auto target = at.take_name();
  if (target.empty()) return XmlFault{begin, "'<?' needs the name of the processing instruction"};
  if (target == "xml" && begin == 0) return Declaration(at).skip();
  if (target == "xml")
    return XmlFault{begin, "the XML declaration must be at the very beginning of the file",
                    "move it there, or delete it"};
  if (is_same_word(target, "xml"))
    return XmlFault{begin, fmt::format("a processing instruction cannot be named '{}'", target)};
  if (at.position() != end && !at.skip_blanks())
    return XmlFault{at.position(), fmt::format("expected whitespace after '<?{}'", brief(target))};
  at.go_to(end + 2);
  return std::nullopt;
}

std::optional<XmlFault> skip_doctype(Cursor& at) {
  const auto begin = at.position();
  if (at.rest().find('>') == std::string_view::npos)
    return XmlFault{begin, "the DOCTYPE is not closed"};
  at.skip("<!DOCTYPE");
  const bool is_sound = at.skip_blanks() && !at.take_name().empty() && skip_external_identifier(at);
  at.skip_blanks();
  if (is_sound && at.rest().starts_with('['))
    return XmlFault{at.position(), "definitions in a DOCTYPE are not supported"};
  if (is_sound && at.skip('>')) return std::nullopt;
  return XmlFault{at.position(), "the DOCTYPE is malformed",
                  "write <!DOCTYPE root>, or leave it out"};
}

}  // namespace lockstep::host
