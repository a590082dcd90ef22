#include "author/format/tag_layout.h"

#include <algorithm>
#include <tuple>

#include "author/edit/element_text.h"
#include "base/core/utf8.h"

namespace lockstep::host {
namespace {

std::string_view first_line(std::string_view text) {
  return text.substr(0, text.find('\n'));
}

}  // namespace

void Gaps::set(std::size_t begin, std::size_t end, std::string_view wanted) {
  const std::string_view gap = text_.substr(begin, end - begin);
  if (!line_end_ && gap.find('\n') != std::string_view::npos) line_end_ = line_end_of(gap);
  replace(begin, end, wanted);
}

void Gaps::replace(std::size_t begin, std::size_t end, std::string_view wanted) {
  if (text_.substr(begin, end - begin) != wanted) edit_.replace(begin, end, std::string(wanted));
}

void TagLayout::begin(const XmlToken& open, std::size_t indentation) {
  name_end_ = open.begin + 1 + open.name.size();
  column_ = indentation + 1 + columns(open.name);
  parts_.clear();
}

void TagLayout::add(const XmlToken& attribute) {
  const auto quote = static_cast<std::size_t>(attribute.value.data() - text_.data()) - 1;
  const std::string_view value = text_.substr(quote, attribute.value.size() + 2);
  parts_.push_back({attribute.begin, quote + value.size(), attribute.name, value});
}

std::vector<const TagLayout::Part*> TagLayout::ordered() const {
  std::vector<const Part*> order;
  for (const Part& part : parts_) order.push_back(&part);
  if (!options_.sort_attributes) return order;
  std::ranges::stable_sort(order, {}, [](const Part* part) {
    const std::string_view name = part->name;
    return std::tuple(name != "ID", name != "name", name);
  });
  return order;
}

void TagLayout::end(const XmlToken& end, Gaps& gaps) {
  const std::vector<const Part*> order = ordered();
  const std::size_t first = column_ + 1;
  const std::size_t end_width = end.kind == TokenKind::EmptyTagEnd ? 2 : 1;
  std::size_t column = column_, done = name_end_;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const Part &place = parts_[i], &part = *order[i];
    const std::size_t name = columns(part.name) + 1;
    const bool is_last = i + 1 == parts_.size();
    const std::size_t wanted =
        1 + name + columns(first_line(part.value)) + (is_last ? end_width : 0);
    const bool breaks = i > 0 && column + wanted > options_.width;
    gaps.set(done, place.begin, breaks ? std::string(line_end_) + std::string(first, ' ') : " ");
    const std::string written = std::string(part.name) + '=' + std::string(part.value);
    gaps.replace(place.begin, place.end, written);
    done = place.end;
    if (const auto line = part.value.rfind('\n'); line != std::string_view::npos) {
      column = columns(part.value.substr(line + 1));
    } else {
      column = (breaks ? first - 1 : column) + 1 + name + columns(part.value);
    }
  }
  gaps.set(done, end.begin, {});
}

}  // namespace lockstep::host
