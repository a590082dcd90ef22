// The texts that a definition is made from. Maps a place in them to file, line, column and the
// source line.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/core/diagnostics.h"
#include "base/core/place.h"
#include "language/document/lines.h"

namespace lockstep::host {

// One text. Lines are counted when the first location is asked for.
class Source {
 public:
  // `first` is the place of its first byte. A byte order mark is left out.
  Source(std::string path, std::string text, Place first = {});
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;

  const std::string& path() const { return path_; }
  std::string_view text() const { return text_; }

  Place place_of(std::size_t offset) const {
    return {first_.byte + static_cast<std::uint32_t>(offset)};
  }
  Place next() const { return place_of(text_.size() + 1); }  // for the text after this one

  SourceLocation locate(Place place) const;
  // Inside the quotes of the attribute whose name is at `attribute`, or in the text of an element
  // that is there, at byte `byte` of its value as it was read from the text.
  SourceLocation locate_value(Place attribute, std::size_t byte = 0) const;
  // The line of a place without its line end; of a longer one 200 bytes with the place in them.
  Excerpt excerpt(std::uint32_t line, std::uint32_t column = 1) const;

 private:
  const LineIndex& lines() const;
  SourceLocation at(std::size_t offset) const;

  std::string path_, text_;
  Place first_;
  mutable std::once_flag counted_;  // threads share a text, as those of the language server do
  mutable std::optional<LineIndex> lines_;
};

// All texts, in the order of their places.
class Sources {
 public:
  void add(std::shared_ptr<const Source> source) { all_.push_back(std::move(source)); }
  Place next() const { return all_.empty() ? Place() : all_.back()->next(); }
  std::span<const std::shared_ptr<const Source>> all() const { return all_; }
  const Source& of(Place place) const;

  SourceLocation locate(Place place) const { return of(place).locate(place); }
  SourceLocation locate_value(Place attribute) const {
    return of(attribute).locate_value(attribute);
  }

 private:
  std::vector<std::shared_ptr<const Source>> all_;
};

// "file:line:column", for a hint.
std::string to_text(const SourceLocation& location);

}  // namespace lockstep::host
