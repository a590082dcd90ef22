#include "authoring/edit/slot.h"

#include <algorithm>
#include <vector>

#include "core/pre_order.h"

namespace lockstep::host {
namespace {

// The children of an element that begin a line say how the next one is laid out.
class SlotFinder {
 public:
  SlotFinder(const Document& document, ChildSlot slot, const ElementText& parent)
      : document_(document),
        text_(document.source()->text()),
        parent_(parent),
        line_end_(line_end_of(text_)) {
    const auto elements = document.elements();
    for (const std::uint32_t child : children_in(elements, slot.parent)) children_.push_back(child);
    before_ = std::min<std::size_t>(slot.index, children_.size());
  }

  std::optional<ChildSlotText> find() const {
    const auto outer = indentation(text_, parent_.tag.begin);
    const auto inner = indentation_of_children();
    if (parent_.tag.is_empty) return in_empty_tag(outer);
    const bool is_in_line = children_.empty() ? !outer : !inner;
    const auto anchor = find_anchor();
    if (!anchor) return std::nullopt;
    if (is_in_line) return ChildSlotText{*anchor, *anchor, {}, {}, {}};
    const std::string indent =
        inner ? std::string(*inner) : std::string(*outer).append(indentation_unit(document_));
    const std::size_t at = behind_comment(*anchor);
    ChildSlotText found{at, at, line_end_ + indent, {}, indent};
    const bool closes_here = line_end(text_, at) > parent_.close;
    if (children_.empty() && closes_here) found.after = line_end_ + std::string(*outer);
    return found;
  }

 private:
  ChildSlotText in_empty_tag(std::optional<std::string_view> outer) const {
    const auto name =
        text_.substr(parent_.tag.begin + 1, parent_.tag.name_end - parent_.tag.begin - 1);
    const std::string close = std::string("</").append(name).append(">");
    ChildSlotText found{parent_.tag.inside_end, parent_.tag.end, ">", close, {}};
    if (!outer) return found;
    found.indentation = std::string(*outer).append(indentation_unit(document_));
    found.before += line_end_ + found.indentation;
    found.after = line_end_ + std::string(*outer) + close;
    return found;
  }

  std::optional<std::string_view> indentation_of_children() const {
    for (const std::uint32_t child : children_) {
      const auto it = indentation(text_, offset_of(document_, document_.elements()[child].place));
      if (it) return it;
    }
    return std::nullopt;
  }

  // The end of what comes before it.
  std::optional<std::size_t> find_anchor() const {
    if (before_ == 0) return parent_.tag.end;
    const auto sibling = element_text(document_, children_[before_ - 1]);
    return sibling ? std::optional(sibling->end) : std::nullopt;
  }

  // A comment at the end of the line belongs to what is before it.
  std::size_t behind_comment(std::size_t at) const {
    const auto begin = text_.find_first_not_of(" \t", at);
    if (begin == std::string_view::npos || !text_.substr(begin).starts_with("<!--")) return at;
    const auto end = text_.find("-->", begin + 4);
    if (end == std::string_view::npos || !ends_line(text_, end + 3)) return at;
    return line_end(text_, at) < end ? at : end + 3;
  }

  const Document& document_;
  std::string_view text_;
  const ElementText& parent_;
  std::string line_end_;
  std::vector<std::uint32_t> children_;
  std::size_t before_;
};

}  // namespace

std::string indentation_unit(const Document& document) {
  const std::string_view text = document.source()->text();
  const auto elements = document.elements();
  const auto indentation_at = [&](std::uint32_t element) {
    return indentation(text, offset_of(document, elements[element].place));
  };
  for (std::uint32_t parent = 0; parent < elements.size(); ++parent) {
    const auto outer = indentation_at(parent);
    if (!outer || elements[parent].end == parent + 1) continue;
    const auto inner = indentation_at(parent + 1);
    if (inner && inner->size() > outer->size() && inner->starts_with(*outer)) {
      return std::string(inner->substr(outer->size()));
    }
  }
  return "  ";
}

std::optional<ChildSlotText> slot_text(const Document& document, ChildSlot slot) {
  const auto parent = element_text(document, slot.parent);
  if (!parent) return std::nullopt;
  return SlotFinder(document, slot, *parent).find();
}

bool ends_line(std::string_view text, std::size_t at) {
  const auto next = std::min(text.find_first_not_of(" \t\r", at), text.size());
  return next == text.size() || text[next] == '\n';
}

}  // namespace lockstep::host
