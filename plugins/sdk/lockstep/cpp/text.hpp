// The compiler's checks of names and default values, so that a mistake in a descriptor is a compile
// error with a telling name. Included by cpp/port.hpp and cpp/plugin.hpp.
#pragma once

#include <cstdlib>
#include <string_view>

namespace lockstep {
inline namespace sdk1 {
namespace detail {

// Descriptors are constants, and a constant may not call these: the compiler shows the name.
[[noreturn]] inline void error_name_must_be_letters_digits_and_underscores() {
  std::abort();
}
[[noreturn]] inline void error_id_must_be_letters_digits_underscores_and_dashes() {
  std::abort();
}
[[noreturn]] inline void error_plugin_name_must_be_letters_digits_underscores_and_dashes() {
  std::abort();
}
[[noreturn]] inline void error_port_name_is_reserved_by_the_tree_language() {
  std::abort();
}
[[noreturn]] inline void error_two_ports_have_the_same_name() {
  std::abort();
}
[[noreturn]] inline void error_an_output_has_no_default() {
  std::abort();
}
[[noreturn]] inline void error_default_is_not_a_value_of_the_port_type() {
  std::abort();
}
[[noreturn]] inline void error_default_of_any_type_is_an_entry() {
  std::abort();
}
[[noreturn]] inline void error_choices_are_different_words_separated_by_semicolons() {
  std::abort();
}
[[noreturn]] inline void error_only_a_string_has_choices() {
  std::abort();
}
[[noreturn]] inline void error_only_numbers_have_limits() {
  std::abort();
}
[[noreturn]] inline void error_limits_are_a_least_and_a_greatest_number() {
  std::abort();
}
[[noreturn]] inline void error_default_is_not_one_of_the_choices() {
  std::abort();
}
[[noreturn]] inline void error_default_is_outside_the_limits() {
  std::abort();
}
[[noreturn]] inline void error_two_leaves_have_the_same_id() {
  std::abort();
}
[[noreturn]] inline void error_a_class_that_describes_elements_is_one_leaf() {
  std::abort();
}
[[noreturn]] inline void error_a_plugin_has_at_most_one_run_context_init_and_deinit() {
  std::abort();
}

constexpr bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
constexpr bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

// A letter, then letters, digits, '_'.
constexpr bool is_name(std::string_view text) {
  if (text.empty() || !is_letter(text[0])) return false;
  for (const char c : text) {
    if (!is_letter(c) && !is_digit(c) && c != '_') return false;
  }
  return true;
}

// A letter, then letters, digits, '_' and '-'; also letters in UTF-8, which the host checks.
constexpr bool is_id(std::string_view text) {
  for (const char c : text) {
    const bool is_beyond_ascii = static_cast<unsigned char>(c) >= 0x80;
    if (!is_letter(c) && !is_digit(c) && c != '_' && c != '-' && !is_beyond_ascii) return false;
  }
  return !text.empty() && !is_digit(text[0]) && text[0] != '_' && text[0] != '-';
}

// Letters, digits, '_', '-': also the name of the file, without ".so".
constexpr bool is_plugin_name(std::string_view text) {
  for (const char c : text) {
    if (!is_letter(c) && !is_digit(c) && c != '_' && c != '-') return false;
  }
  return !text.empty();
}

// "{key}", an entry of the tree; "{=}" is the one of the port's name.
constexpr bool is_entry(std::string_view text) {
  return text.size() > 2 && text.front() == '{' && text.back() == '}';
}

constexpr std::string_view trim(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n";
  const auto first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

// Removes the digits at the front; how many there were.
constexpr std::size_t skip_digits(std::string_view& text) {
  std::size_t count = 0;
  for (; !text.empty() && is_digit(text[0]); ++count) text.remove_prefix(1);
  return count;
}

constexpr void skip_sign(std::string_view& text) {
  if (!text.empty() && (text[0] == '+' || text[0] == '-')) text.remove_prefix(1);
}

constexpr bool is_int(std::string_view text) {
  text = trim(text);
  skip_sign(text);
  return skip_digits(text) > 0 && text.empty();
}

constexpr bool is_double(std::string_view text) {
  text = trim(text);
  skip_sign(text);
  std::size_t digits = skip_digits(text);
  if (!text.empty() && text[0] == '.') {
    text.remove_prefix(1);
    digits += skip_digits(text);
  }
  if (digits == 0) return false;
  if (text.empty()) return true;
  if (text[0] != 'e' && text[0] != 'E') return false;
  text.remove_prefix(1);
  skip_sign(text);
  return skip_digits(text) > 0 && text.empty();
}

// False only if the number is not within [min, max]; with an exponent it is not looked at.
constexpr bool may_be_within(std::string_view text, double min, double max) {
  double number = 0, divisor = 1;
  bool is_negative = false, has_point = false;
  for (const char c : trim(text)) {
    if (c == 'e' || c == 'E') return true;
    if (c == '-') is_negative = true;
    if (c == '.') has_point = true;
    if (!is_digit(c)) continue;
    number = 10 * number + (c - '0');
    if (has_point) divisor *= 10;
  }
  number = (is_negative ? -number : number) / divisor;
  return number >= min && number <= max;
}

// The place of `word` in "soft;firm"; the number of words if it is not among them.
constexpr std::size_t index_of(std::string_view word, std::string_view words) {
  for (std::size_t index = 0;; ++index) {
    const auto end = words.find(';');
    if (words.substr(0, end) == word) return index;
    if (end == std::string_view::npos) return index + 1;
    words.remove_prefix(end + 1);
  }
}

// The word at this place; empty if there are not so many.
constexpr std::string_view word_at(std::size_t index, std::string_view words) {
  for (; index > 0; --index) {
    const auto end = words.find(';');
    if (end == std::string_view::npos) return {};
    words.remove_prefix(end + 1);
  }
  return words.substr(0, words.find(';'));
}

constexpr std::size_t count_words(std::string_view words) {
  std::size_t count = 1;
  for (const char c : words) count += c == ';' ? 1 : 0;
  return count;
}

// Different words, separated by ';' only.
constexpr bool are_choices(std::string_view words) {
  for (std::size_t i = 0; i < count_words(words); ++i) {
    const std::string_view word = word_at(i, words);
    if (word.empty() || trim(word).size() != word.size() || index_of(word, words) != i)
      return false;
  }
  return true;
}

constexpr bool is_bool(std::string_view text) {
  text = trim(text);
  return text == "true" || text == "True" || text == "TRUE" || text == "1" || text == "false" ||
         text == "False" || text == "FALSE" || text == "0";
}

// Items of which `is_item` is true, separated by ; or , or whitespace.
constexpr bool is_list(std::string_view text, bool (*is_item)(std::string_view)) {
  constexpr std::string_view kSeparators = ";, \t\r\n";
  while (true) {
    const auto first = text.find_first_not_of(kSeparators);
    if (first == std::string_view::npos) return true;
    text.remove_prefix(first);
    const auto found = text.find_first_of(kSeparators);
    const auto length = found == std::string_view::npos ? text.size() : found;
    if (!is_item(text.substr(0, length))) return false;
    text.remove_prefix(length);
  }
}

}  // namespace detail
}  // namespace sdk1
}  // namespace lockstep
