#include "leaves/leaf_script.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/core/value.h"
#include "base/core/wording.h"

namespace lockstep::host {
namespace {

constexpr std::pair<Status, char> kLetters[] = {
    {Status::Running, 'R'}, {Status::Success, 'S'}, {Status::Failure, 'F'}, {Status::Skipped, 'K'}};
constexpr char kFault = 'X', kHeld = '~';

// In a value, what separates words and parts is written as %20.
std::string coded(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const bool is_plain =
        c > ' ' && c != '%' && c != '[' && c != ']' && c != '|' && c != '=' && c != '\x7f';
    if (is_plain) {
      out += c;
    } else {
      out += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
  }
  return out;
}

std::optional<std::string> decoded(std::string_view text) {
  std::string out;
  const auto digit = [](char c) {
    return c >= '0' && c <= '9' ? c - '0' : c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
  };
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      out += text[i];
      continue;
    }
    if (i + 2 >= text.size()) return std::nullopt;
    const int high = digit(text[i + 1]), low = digit(text[i + 2]);
    if (high < 0 || low < 0) return std::nullopt;
    out += static_cast<char>(high * 16 + low);
    i += 2;
  }
  return out;
}

// "[a=1|b=2]".
bool take_written(std::string_view text, LeafWord& word) {
  if (text.empty()) return true;
  if (text.front() != '[' || text.back() != ']') return false;
  text = text.substr(1, text.size() - 2);
  while (true) {
    const std::string_view part = text.substr(0, text.find('|'));
    const auto sign = part.find('=');
    if (sign == std::string_view::npos) return false;
    const auto port = decoded(part.substr(0, sign)), value = decoded(part.substr(sign + 1));
    if (!port || !value) return false;
    word.written.emplace_back(*port, *value);
    if (part.size() == text.size()) return true;
    text.remove_prefix(part.size() + 1);
  }
}

constexpr std::pair<AfterCut, std::string_view> kAfterCuts[] = {{AfterCut::Continues, kContinues},
                                                                {AfterCut::Failure, "failure"},
                                                                {AfterCut::Success, "success"}};

// "3", or "3 continue M/arm" for a leaf that does something else than to begin again.
std::optional<Problem> read_cut(std::string_view text, std::vector<ScriptCut>& cuts) {
  const auto blank = std::min(text.find(' '), text.size());
  const auto tick = parse_int(text.substr(0, blank));
  const std::uint64_t last = cuts.empty() ? 0 : cuts.back().tick;
  if (!tick || *tick <= 0 || static_cast<std::uint64_t>(*tick) < last) {
    return Problem{"'@cut' is the number of a tick, from 1 on, and not before the one above it"};
  }
  const auto at = static_cast<std::uint64_t>(*tick);
  if (at > last) cuts.push_back({.tick = at});
  if (blank == text.size()) return std::nullopt;
  text.remove_prefix(blank + 1);
  const std::string_view word = text.substr(0, text.find(' '));
  const auto* const does =
      std::ranges::find(kAfterCuts, word, &std::pair<AfterCut, std::string_view>::second);
  if (does == std::end(kAfterCuts) || word.size() == text.size()) {
    return Problem{"behind the tick of '@cut' comes continue, failure or success, and a path"};
  }
  cuts.back().leaves[std::string(text.substr(word.size() + 1))] = does->first;
  return std::nullopt;
}

std::string text_of_cut(const ScriptCut& cut) {
  std::string text = fmt::format("@cut {}\n", cut.tick);
  for (const auto& [path, does] : cut.leaves) {
    const auto* const row =
        std::ranges::find(kAfterCuts, does, &std::pair<AfterCut, std::string_view>::first);
    if (row != std::end(kAfterCuts))
      text += fmt::format("@cut {} {} {}\n", cut.tick, row->second, path);
  }
  return text;
}

// "@rate 10".
std::optional<Problem> read_setting(std::string_view line, LeafScripts& scripts) {
  const auto blank = line.find(' ');
  const std::string_view name = line.substr(0, blank);
  const std::string_view value = blank == std::string_view::npos ? "" : line.substr(blank + 1);
  if (name == "@rate") {
    scripts.rate = parse_double(value);
    if (scripts.rate && *scripts.rate >= 0.001 && *scripts.rate <= 100000) return std::nullopt;
    return Problem{"'@rate' is a number from 0.001 to 100000"};
  }
  if (name == "@ticks") {
    const auto ticks = parse_int(value);
    if (ticks && *ticks > 0) scripts.ticks = static_cast<std::uint64_t>(*ticks);
    return scripts.ticks ? std::nullopt : std::optional(Problem{"'@ticks' is a whole number"});
  }
  if (name == "@cut") return read_cut(value, scripts.cuts);
  return Problem{fmt::format("unknown setting '{}'", brief(name)),
                 "there are @rate, @ticks and @cut"};
}

// `at`: where in the line a problem is.
std::optional<Problem> read_line(std::string_view line, LeafScripts& scripts, std::size_t& at) {
  if (line.front() == '@') return read_setting(line, scripts);
  const auto sign = line.find(" = ");
  if (sign == std::string_view::npos) {
    return Problem{"expected the path of a leaf, ' = ' and its words",
                   "write Main/arm = R0 R0.5 S"};
  }
  std::vector<LeafWord> words;
  for (std::size_t end = sign + 3; end < line.size();) {
    const std::size_t begin = line.find_first_not_of(" \t", end);
    if (begin == std::string_view::npos) break;
    end = std::min(line.find_first_of(" \t", begin), line.size());
    const std::string_view it = line.substr(begin, end - begin);
    auto word = parse_leaf_word(it);
    if (!word) {
      at = begin;
      return Problem{fmt::format("'{}' is not a word of a leaf", brief(it)),
                     "there are R0.5 (running, with its progress), S, F, K (skipped), X (a fault), "
                     "~0.5 (held), each with what it writes: S[port=value]"};
    }
    words.push_back(std::move(*word));
  }
  if (words.empty()) return Problem{"a leaf without words"};
  const std::string path(line.substr(0, sign));
  if (scripts.leaves.emplace(path, std::move(words)).second) return std::nullopt;
  return Problem{fmt::format("'{}' is there twice", brief(path))};
}

}  // namespace

std::optional<LeafWord> parse_leaf_word(std::string_view text) {
  if (text.empty()) return std::nullopt;
  LeafWord word;
  const char first = text.front();
  text.remove_prefix(1);
  const auto end = text.find('[');
  const std::string_view number = text.substr(0, end);
  if (!number.empty()) {
    const auto progress = parse_double(number);
    if (!progress || *progress < 0 || *progress > 1) return std::nullopt;
    word.progress = *progress;
  }
  if (first == kHeld || first == kFault) {
    word.kind = first == kHeld ? LeafWord::Kind::Held : LeafWord::Kind::Fault;
  } else {
    const auto* const letter = std::ranges::find(kLetters, first, &std::pair<Status, char>::second);
    if (letter == std::end(kLetters)) return std::nullopt;
    word.status = letter->first;
  }
  const bool fits = take_written(end == std::string_view::npos ? "" : text.substr(end), word);
  return fits ? std::optional(word) : std::nullopt;
}

std::string to_text(const LeafWord& word) {
  std::string text;
  if (word.kind == LeafWord::Kind::Fault) {
    text = kFault;
  } else if (word.kind == LeafWord::Kind::Held) {
    text = fmt::format("{}{}", kHeld, word.progress);
  } else {
    text = std::ranges::find(kLetters, word.status, &std::pair<Status, char>::first)->second;
    if (word.status == Status::Running) text += fmt::format("{}", word.progress);
  }
  std::string_view before = "[";
  for (const auto& [port, value] : word.written) {
    text += fmt::format("{}{}={}", before, coded(port), coded(value));
    before = "|";
  }
  return word.written.empty() ? text : text + ']';
}

bool is_leaf_file(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\n\xef\xbb\xbf");
  return first != std::string_view::npos && text[first] == '<';
}

tl::expected<LeafScripts, LeafScriptError> parse_leaf_scripts(std::string_view text) {
  LeafScripts scripts;
  for (std::uint32_t number = 1; !text.empty(); ++number) {
    std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.remove_suffix(1);
    if (line.empty() || line.front() == '#') continue;
    std::size_t at = 0;
    if (auto wrong = read_line(line, scripts, at)) {
      return tl::unexpected(LeafScriptError{std::move(wrong->message), std::move(wrong->hint),
                                            number, static_cast<std::uint32_t>(at + 1)});
    }
  }
  return scripts;
}

std::uint32_t line_of_leaf(std::string_view text, std::string_view path) {
  const std::string at_cut = fmt::format(" {}", path);
  std::uint32_t cut = 0;  // a line that says what it does after a cut
  for (std::uint32_t number = 1; !text.empty(); ++number) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    if (line.starts_with(path) && line.substr(path.size()).starts_with(" = ")) return number;
    if (cut == 0 && line.starts_with("@cut ") && line.ends_with(at_cut)) cut = number;
  }
  return cut;
}

std::string to_text(const LeafScripts& scripts) {
  std::string text;
  if (scripts.rate) text += fmt::format("@rate {}\n", *scripts.rate);
  if (scripts.ticks) text += fmt::format("@ticks {}\n", *scripts.ticks);
  for (const ScriptCut& it : scripts.cuts) text += text_of_cut(it);
  for (const auto& [path, words] : scripts.leaves) {
    text += path + " =";
    for (const LeafWord& word : words) text += ' ' + to_text(word);
    text += '\n';
  }
  return text;
}

}  // namespace lockstep::host
