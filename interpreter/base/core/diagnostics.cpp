#include "base/core/diagnostics.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "base/core/utf8.h"

namespace lockstep::host {
namespace {

// Bytes of a message or a hint. Names in them are brief() already; what a plugin or the system says
// may not be.
constexpr std::size_t kMaxText = 4096;

// A tab in an excerpt stays, so that the caret below can repeat it and align at any tab width.
enum class Tabs : bool { Escaped, Kept };

// Appends the first character of `text` so that a terminal only shows it. Returns its bytes.
std::size_t append_visible(std::string& out, std::string_view text, Tabs tabs) {
  const auto [length, code] = first_character(text);
  const auto character = text.substr(0, std::max<std::size_t>(length, 1));
  const bool plain_tab = tabs == Tabs::Kept && character == "\t";
  if (plain_tab || (length > 0 && !is_obeyed_by_terminals(code))) {
    out += character;
  } else if (length > 1) {
    out += fmt::format("\\u{:04X}", static_cast<unsigned>(code));
  } else {
    out += fmt::format("\\x{:02X}", static_cast<unsigned char>(character[0]));
  }
  return character.size();
}

std::string visible(std::string_view text, Tabs tabs) {
  // Nearly every text: the names of all leaves of a run come here.
  const auto is_plain = [](char character) { return character >= ' ' && character <= '~'; };
  if (std::ranges::all_of(text, is_plain)) return std::string(text);
  std::string out;
  while (!text.empty()) text.remove_prefix(append_visible(out, text, tabs));
  return out;
}

// The text before the caret: a tab for a tab, and blanks for everything else that is shown.
std::string caret_padding(std::string_view before) {
  std::string padding;
  for (std::string shown; !before.empty(); shown.clear()) {
    before.remove_prefix(append_visible(shown, before, Tabs::Kept));
    padding += shown == "\t" ? shown : std::string(columns(shown), ' ');
  }
  return padding;
}

std::string place(const SourceLocation& location) {
  auto text = printable(location.file);
  if (location.line > 0) text += fmt::format(":{}", location.line);
  if (location.line > 0 && location.column > 0) text += fmt::format(":{}", location.column);
  if (!text.empty()) text += ": ";
  return text;
}

struct Paint {
  bool color;
  std::string operator()(std::string_view code, std::string_view text) const {
    return color ? fmt::format("\x1b[{}m{}\x1b[0m", code, text) : std::string(text);
  }
};

std::string_view color_of(Severity severity) {
  constexpr std::string_view kCodes[] = {"1;31", "1;35", "1;36"};
  return kCodes[static_cast<unsigned>(severity)];
}

auto identity(const Diagnostic& d) {
  return std::tie(d.severity, d.location.file, d.location.line, d.location.column, d.message,
                  d.hint, d.excerpt);
}

}  // namespace

void Diagnostics::add(Diagnostic diagnostic) {
  if (is_full(diagnostic.severity)) return count_one(diagnostic.severity);
  for (std::string* text : {&diagnostic.message, &diagnostic.hint}) {
    if (text->size() > kMaxText) *text = std::string(utf8_front(*text, kMaxText)) + "…";
  }
  ++added_[index(diagnostic.severity)];
  all_.push_back(std::move(diagnostic));
}

void Diagnostics::count_one(Severity severity) {
  ++added_[index(severity)];
  ++lost_[index(severity)];
}

void Diagnostics::warning(MessageCode code, SourceLocation location, std::string message,
                          std::string hint) {
  add({Severity::Warning, std::move(location), std::move(message), std::move(hint), {}, code});
}

void Diagnostics::note(MessageCode code, SourceLocation location, std::string message,
                       std::string hint) {
  add({Severity::Note, std::move(location), std::move(message), std::move(hint), {}, code});
}

void Diagnostics::error(MessageCode code, SourceLocation location, std::string message,
                        std::string hint, Excerpt excerpt) {
  add({Severity::Error, std::move(location), std::move(message), std::move(hint),
       std::move(excerpt), code});
}

bool Diagnostics::has_errors() const {
  return added_[index(Severity::Error)] > 0;
}

std::size_t Diagnostics::count(Severity severity) const {
  const auto kept = std::count_if(all_.begin(), all_.end(),
                                  [&](const Diagnostic& d) { return d.severity == severity; });
  return static_cast<std::size_t>(kept) + lost_[index(severity)];
}

void Diagnostics::sort() {
  std::map<std::string, std::size_t> mentioned;
  for (const auto& d : all_) mentioned.try_emplace(d.location.file, mentioned.size());
  const auto key = [&](const Diagnostic& d) {
    return std::tuple(mentioned.at(d.location.file), d.location.line, d.location.column);
  };
  std::stable_sort(all_.begin(), all_.end(),
                   [&](const Diagnostic& a, const Diagnostic& b) { return key(a) < key(b); });

  const auto before = [&](std::size_t a, std::size_t b) {
    return identity(all_[a]) < identity(all_[b]);
  };
  std::set<std::size_t, decltype(before)> seen(before);
  std::vector<Diagnostic> once;
  std::vector<bool> keep(all_.size());
  for (std::size_t i = 0; i < all_.size(); ++i) keep[i] = seen.insert(i).second;
  for (std::size_t i = 0; i < all_.size(); ++i)
    if (keep[i]) once.push_back(std::move(all_[i]));
  all_ = std::move(once);
}

std::string_view to_string(Severity severity) {
  constexpr std::string_view kNames[] = {"error", "warning", "note"};
  return kNames[static_cast<unsigned>(severity)];
}

std::string render(const Diagnostic& diagnostic, bool color) {
  const Paint paint{color};
  const auto& [severity, location, message, hint, excerpt, code] = diagnostic;
  auto text =
      fmt::format("{}{} {}{}\n", paint("1", place(location)),
                  paint(color_of(severity), fmt::format("{}:", to_string(severity))),
                  printable(message), code.empty() ? "" : fmt::format(" [{}]", code.text()));
  if (!excerpt.text.empty()) {
    const std::string_view mark = excerpt.column > 1 ? "..." : "";  // for what comes before it
    text += fmt::format("  {}{}\n", mark, visible(excerpt.text, Tabs::Kept));
    if (location.column >= excerpt.column &&
        location.column - excerpt.column <= excerpt.text.size()) {
      const auto before =
          std::string_view(excerpt.text).substr(0, location.column - excerpt.column);
      text +=
          fmt::format("  {:{}}{}{}\n", "", mark.size(), caret_padding(before), paint("1;32", "^"));
    }
  }
  if (!hint.empty()) text += fmt::format("  {} {}\n", paint("1", "hint:"), printable(hint));
  return text;
}

std::string printable(std::string_view text) {
  return visible(text, Tabs::Escaped);
}

}  // namespace lockstep::host
