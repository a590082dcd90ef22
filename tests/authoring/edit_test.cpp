// Random edits of all trees of this project, with both line ends: each does to the elements what it
// says, keeps the comments, and its inverse brings the same bytes back. LOCKSTEP_EDITS says how
// many.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <functional>

#include "author/edit/edits.h"
#include "authoring/element_model.h"
#include "property/random_source.h"

namespace lockstep::host::test {
namespace {

std::string with_carriage_returns(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '\n' && !result.ends_with('\r')) result += '\r';
    result += c;
  }
  return result;
}

// With both line ends.
std::vector<std::string> both_of(const std::vector<std::string>& texts) {
  std::vector<std::string> both;
  for (const std::string& text : texts) {
    both.push_back(text);
    both.push_back(with_carriage_returns(text));
  }
  return both;
}

// One edit, and the same of the model. It does nothing where the edit is refused.
class RandomEdit {
 public:
  RandomEdit(const Document& document, ElementModel& model, RandomSource& random)
      : document_(document), model_(model), random_(random) {}

  std::string what;
  enum class Comments { Stay, Move, AreFewer } comments = Comments::Stay;

  TextEdit make() {
    if (document_.elements().size() == 1) return {};
    switch (random_.between(0, 6)) {
      case 0:
        return set();
      case 1:
        return rename_attribute();
      case 2:
        return insert();
      case 3:
        return erase();
      case 4:
        return swap();
      case 5:
        return wrap();
      default:
        return unwrap();
    }
  }

 private:
  std::uint32_t any_but_root() {
    return static_cast<std::uint32_t>(
        random_.between(1, static_cast<int>(document_.elements().size()) - 1));
  }

  static std::uint32_t parent_of(std::span<const Element> elements, std::uint32_t element) {
    std::uint32_t parent = element - 1;
    while (elements[parent].end <= element) --parent;
    return parent;
  }

  // Except for the root's, which say in which language a text is.
  std::string any_attribute(std::uint32_t element) {
    const auto attributes = document_.attributes(element);
    if (element == 0 || attributes.empty() || attributes[0].name.empty()) return {};
    const auto name = random_.pick(attributes).name;
    return std::string(name);
  }

  std::string any_value() {
    std::string value;
    static const std::vector<std::string_view> kParts{"a",    "<",   ">",   "&", "\"", "'",
                                                      "\n",   "\r",  "\t",  " ", "é",  "--",
                                                      "&lt;", "{k}", "]]>", "$", "𝄞",  "\\"};
    for (int i = random_.between(0, 6); i > 0; --i) value += random_.pick(kParts);
    return value;
  }

  TextEdit done(Result<TextEdit> edit, const std::function<void()>& change) {
    if (!edit) return {};
    change();
    return std::move(*edit);
  }

  TextEdit set() {
    const auto element = any_but_root();
    std::string name = any_attribute(element);
    if (name.empty() || random_.one_in(3)) name = "added";
    std::string value = any_value();
    const Attribute* old = document_.find_attribute(element, name);
    if (old != nullptr && random_.one_in(2)) {
      value = std::string(old->value.substr(0, old->value.size() / 2)) + value +
              std::string(old->value.substr(old->value.size() / 2));
    }
    what = "set " + name + " to " + value;
    return done(set_attribute(document_, element, name, value), [&] {
      auto& all = part_of(model_, element).attributes;
      const auto it = std::ranges::find(all, name, [](const auto& pair) { return pair.first; });
      if (it == all.end()) {
        all.emplace_back(name, value);
      } else {
        it->second = value;
      }
    });
  }

  TextEdit rename_attribute() {
    const auto element = any_but_root();
    const std::string name = any_attribute(element);
    what = "rename the attribute " + name;
    return done(host::rename_attribute(document_, element, name, "re.named-é"), [&] {
      for (auto& it : part_of(model_, element).attributes)
        if (it.first == name) it.first = "re.named-é";
    });
  }

  // Where an element is among the children of the one around it.
  struct Position {
    ElementModel& parent;
    std::ptrdiff_t index;
  };
  Position position_of(std::uint32_t element) {
    ElementModel& parent = part_of(model_, parent_of(document_.elements(), element));
    return {parent, &part_of(model_, element) - parent.children.data()};
  }

  TextEdit insert() {
    const auto sibling = any_but_root();
    what = "insert";
    return done(insert_behind(document_, sibling, "<New a='1'>\n  <Inner b=\"2\n3\"/>\n</New>"),
                [&] {
                  const Position at = position_of(sibling);
                  at.parent.children.insert(at.parent.children.begin() + at.index + 1,
                                            {"New", {{"a", "1"}}, {{"Inner", {{"b", "2\n3"}}}}});
                });
  }

  TextEdit erase() {
    const auto element = any_but_root();
    what = "delete";
    comments = Comments::AreFewer;
    return done(delete_element(document_, element), [&] {
      const Position at = position_of(element);
      at.parent.children.erase(at.parent.children.begin() + at.index);
    });
  }

  TextEdit swap() {
    const auto first = any_but_root();
    what = "swap";
    comments = Comments::Move;
    const auto elements = document_.elements();
    const auto second = elements[first].end;
    const bool has_sibling =
        second < elements.size() && parent_of(elements, first) == parent_of(elements, second);
    if (!has_sibling) return {};
    return done(swap_elements(document_, first, second), [&] {
      const Position at = position_of(first);
      std::iter_swap(at.parent.children.begin() + at.index,
                     at.parent.children.begin() + at.index + 1);
    });
  }

  TextEdit wrap() {
    const auto first = any_but_root();
    const auto elements = document_.elements();
    const auto parent = parent_of(elements, first);
    std::uint32_t last = first, count = 1;
    while (elements[last].end < elements[parent].end && random_.one_in(2)) {
      last = elements[last].end;
      ++count;
    }
    what = "wrap";
    return done(wrap_elements(document_, first, last, "Around c=\"d\""), [&] {
      const Position at = position_of(first);
      const auto begin = at.parent.children.begin() + at.index;
      std::vector<ElementModel> inside(begin, begin + count);
      at.parent.children.erase(begin + 1, begin + count);
      at.parent.children[static_cast<std::size_t>(at.index)] = {"Around", {{"c", "d"}}, inside};
    });
  }

  TextEdit unwrap() {
    const auto element = any_but_root();
    what = "unwrap";
    return done(unwrap_element(document_, element), [&] {
      const Position at = position_of(element);
      auto& siblings = at.parent.children;
      auto inside = std::move(siblings[static_cast<std::size_t>(at.index)].children);
      const auto gap = siblings.erase(siblings.begin() + at.index);
      siblings.insert(gap, inside.begin(), inside.end());
    });
  }

  const Document& document_;
  ElementModel& model_;
  RandomSource& random_;
};

void check_edit(const std::string& text, RandomSource& random) {
  const auto document = parsed(text);
  ElementModel model = model_of(*document);
  RandomEdit edits(*document, model, random);
  const TextEdit edit = edits.make();
  const std::string_view before = document->source()->text();
  const std::string after = edit.apply(before);
  INFO(edits.what << "\n--- before\n" << before << "\n--- after\n" << after);
  const auto changed = parsed(after);
  REQUIRE(changed != nullptr);
  REQUIRE(model_of(*changed) == model);
  REQUIRE(edit.inverse(before).apply(after) == before);
  auto comments = comments_in(after), expected = comments_in(before);
  if (edits.comments == RandomEdit::Comments::Move) {
    std::ranges::sort(comments);
    std::ranges::sort(expected);
  }
  if (edits.comments != RandomEdit::Comments::AreFewer) REQUIRE(comments == expected);
  const bool has_carriage_returns = with_carriage_returns(before) == before;
  if (has_carriage_returns)
    REQUIRE(std::ranges::count(after, '\n') <= std::ranges::count(after, '\r') + 1);
}

}  // namespace

TEST_CASE("edit: a random edit does what it says and nothing else") {
  const auto texts = both_of(texts_of_trees());
  REQUIRE(texts.size() > 200);
  const char* const given = std::getenv("LOCKSTEP_EDITS");
  const int count = given != nullptr ? std::atoi(given) : 2'000;
  RandomSource random(34);
  for (int i = 0; i < count; ++i) {
    INFO("edit " << i);
    check_edit(random.pick(texts), random);
  }
}

TEST_CASE("edit: what is written about an element changes its place with it") {
  const auto swapped = [](const std::string& a, const std::string& between, const std::string& b) {
    const std::string begin = "<r>\n  ", end = "\n</r>\n";
    const auto document = parsed(begin + a + between + b + end);
    const auto edit = swap_elements(*document, 1, document->elements()[1].end);
    REQUIRE(edit.has_value());
    CHECK(edit->apply(document->source()->text()) == begin + b + between + a + end);
  };
  swapped("<A/>", "\n  ", "<B>\n    <C/>\n  </B>");
  swapped("<A/>", "", "<B/>");
  swapped("<!-- a -->\n  <!-- and\n  a -->\n  <A/> <!-- a -->", "\n\n  ", "<!-- b -->\n  <B/>");
  swapped("<A/>", "\n  <!-- neither's -->\n\n  ", "<B/>");
}

}  // namespace lockstep::host::test
