#include "base/system/processors.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>

namespace lockstep::host {
namespace {

// Takes the number that the text begins with.
std::optional<int> take_number(std::string_view& text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || number < 0 || number >= CPU_SETSIZE) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return number;
}

bool take(std::string_view& text, char sign) {
  if (!text.starts_with(sign)) return false;
  text.remove_prefix(1);
  return true;
}

}  // namespace

std::optional<Processors> Processors::parse(std::string_view text) {
  Processors found;
  do {
    const auto first = take_number(text);
    const auto last = first && take(text, '-') ? take_number(text) : first;
    if (!first || !last || *last < *first) return std::nullopt;
    for (int it = *first; it <= *last; ++it) CPU_SET(it, &found.set_);
  } while (take(text, ','));
  return text.empty() ? std::optional(found) : std::nullopt;
}

Processors Processors::allowed() {
  Processors found;
  sched_getaffinity(0, sizeof found.set_, &found.set_);
  return found;
}

std::string Processors::text() const {
  std::string list;
  for (int first = 0; first < CPU_SETSIZE; ++first) {
    if (!has(first)) continue;
    int last = first;
    while (last + 1 < CPU_SETSIZE && has(last + 1)) ++last;
    if (!list.empty()) list += ',';
    list += first == last ? std::to_string(first) : fmt::format("{}-{}", first, last);
    first = last;
  }
  return list;
}

std::optional<Problem> Processors::refusal() const {
  const Processors may = allowed();
  for (int it = 0; it < CPU_SETSIZE; ++it) {
    if (!has(it) || may.has(it)) continue;
    const bool exists = it < sysconf(_SC_NPROCESSORS_CONF);
    return Problem{
        fmt::format("cpu {} {}", it, exists ? "is not allowed for this process" : "does not exist"),
        "allowed is " + may.text()};
  }
  return std::nullopt;
}

std::optional<Problem> Processors::bind_this_thread() const {
  if (auto problem = refusal()) return problem;
  if (sched_setaffinity(0, sizeof set_, &set_) == 0) return std::nullopt;
  return Problem{fmt::format("cannot bind a thread to cpu {}: {}", text(), std::strerror(errno)),
                 "allowed is " + allowed().text()};
}

}  // namespace lockstep::host
