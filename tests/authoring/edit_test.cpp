// Random edits of all trees of this project, with both line ends: each does to the elements what it
// says, keeps the comments, and its inverse brings the same bytes back. LOCKSTEP_EDITS says how
// many.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <functional>

#include "authoring/edit/edits.h"
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
  bool keeps_comments = true;

  TextEdit make() {
    switch (random_.between(0, 8)) {
      case 0:
        return set();
      case 1:
        return remove();
      case 2:
        return rename_attribute();
      case 3:
        return rename();
      case 4:
        return insert();
      case 5:
        return erase();
      case 6:
        return move();
      case 7:
        return wrap();
      default:
        return unwrap();
    }
  }

 private:
  std::uint32_t any_element() {
    return static_cast<std::uint32_t>(
        random_.between(0, static_cast<int>(document_.elements().size()) - 1));
  }
  std::uint32_t any_but_root() {
    const auto element = any_element();
    return element == 0 && document_.elements().size() > 1 ? 1 : element;
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

  TextEdit remove() {
    const auto element = any_but_root();
    const std::string name = any_attribute(element);
    what = "remove " + name;
    return done(remove_attribute(document_, element, name), [&] {
      std::erase_if(part_of(model_, element).attributes,
                    [&](const auto& it) { return it.first == name; });
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

  TextEdit rename() {
    const auto element = any_but_root();  // by whose name the language is known
    what = "rename the element";
    return done(rename_element(document_, element, "Renamed"),
                [&] { part_of(model_, element).tag = "Renamed"; });
  }

  ChildSlot any_slot() {
    return {any_element(), static_cast<std::uint32_t>(random_.between(0, 6))};
  }

  static void put(ElementModel& parent, std::uint32_t index, ElementModel child) {
    const auto at = std::min<std::size_t>(index, parent.children.size());
    parent.children.insert(parent.children.begin() + static_cast<std::ptrdiff_t>(at),
                           std::move(child));
  }

  TextEdit insert() {
    const ChildSlot slot = any_slot();
    what = "insert";
    return done(insert_element(document_, slot, "<New a='1'>\n  <Inner b=\"2\n3\"/>\n</New>"), [&] {
      put(part_of(model_, slot.parent), slot.index,
          {"New", {{"a", "1"}}, {{"Inner", {{"b", "2\n3"}}}}});
    });
  }

  TextEdit erase() {
    const auto element = any_but_root();
    what = "delete";
    keeps_comments = false;
    return done(delete_element(document_, element), [&] { take(element); });
  }

  ElementModel take(std::uint32_t element) {
    const auto parent = parent_of(document_.elements(), element);
    ElementModel& around = part_of(model_, parent);
    const ElementModel* const part = &part_of(model_, element);
    const auto at = part - around.children.data();
    ElementModel taken = *part;
    around.children.erase(around.children.begin() + at);
    return taken;
  }

  TextEdit move() {
    const auto element = any_but_root();
    const ChildSlot slot = any_slot();
    what = "move";
    keeps_comments = false;  // their order
    return done(move_element(document_, element, slot), [&] {
      // A mark in the place of the element keeps the numbers of the others.
      ElementModel moved = std::exchange(part_of(model_, element), {});
      ElementModel& mark = part_of(model_, element);
      mark.children.resize(moved.children.size());
      for (std::size_t i = 0; i < moved.children.size(); ++i) mark.children[i] = moved.children[i];
      mark.tag = "mark";
      put(part_of(model_, slot.parent), slot.index, std::move(moved));
      erase_mark(model_);
    });
  }

  static bool erase_mark(ElementModel& model) {
    const auto mark = std::ranges::find(model.children, "mark", &ElementModel::tag);
    if (mark != model.children.end()) {
      model.children.erase(mark);
      return true;
    }
    return std::ranges::any_of(model.children, erase_mark);
  }

  TextEdit wrap() {
    const auto element = any_but_root();
    what = "wrap";
    return done(wrap_element(document_, element, "Around c=\"d\""), [&] {
      ElementModel& part = part_of(model_, element);
      ElementModel inside = std::exchange(part, {"Around", {{"c", "d"}}});
      part.children.push_back(std::move(inside));
    });
  }

  TextEdit unwrap() {
    const auto element = any_but_root();
    what = "unwrap";
    return done(unwrap_element(document_, element), [&] {
      ElementModel& around = part_of(model_, parent_of(document_.elements(), element));
      const auto at = &part_of(model_, element) - around.children.data();
      auto inside = std::move(around.children[static_cast<std::size_t>(at)].children);
      const auto gap = around.children.erase(around.children.begin() + at);
      around.children.insert(gap, inside.begin(), inside.end());
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
  if (edits.keeps_comments) REQUIRE(comments_in(after) == comments_in(before));
  const bool has_carriage_returns = with_carriage_returns(before) == before;
  if (has_carriage_returns)
    REQUIRE(std::ranges::count(after, '\n') <= std::ranges::count(after, '\r') + 1);
}

}  // namespace

TEST_CASE("edit: a random edit does what it says and nothing else, and can be undone") {
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

}  // namespace lockstep::host::test
