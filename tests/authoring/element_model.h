// The elements of a document as a tree that is easy to change: what a change of the text is to do,
// said without bytes.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "language/document/document.h"

namespace lockstep::host::test {

struct ElementModel {
  std::string tag;
  std::vector<std::pair<std::string, std::string>> attributes = {};
  std::vector<ElementModel> children = {};

  friend bool operator==(const ElementModel&, const ElementModel&) = default;
};

// Without the texts of elements.
ElementModel model_of(const Document& document, std::uint32_t element = 0);
// The part of `model` for the element with this number in pre-order.
ElementModel& part_of(ElementModel& model, std::uint32_t element);

// Null if the text cannot be read. Errors that leave it readable are ignored.
std::unique_ptr<Document> parsed(std::string text);
bool has_errors(const std::string& text);
// The files below trees/ and tests/trees/ that can be read.
std::vector<std::string> texts_of_trees();

// All comments of a text, without their blanks.
std::vector<std::string> comments_in(std::string_view text);

}  // namespace lockstep::host::test
