#include "language/document/language_of.h"

#include <algorithm>
#include <span>
#include <vector>

#include "language/document/scanner.h"

namespace lockstep::host {

namespace {

// By the attributes of the root. Of two languages the later one in the list, so not our own.
const LanguageRules& chosen(std::span<const std::string_view> attributes) {
  const auto all = languages();
  for (auto it = all.rbegin(); it != all.rend(); ++it) {
    if (std::ranges::find(attributes, (*it)->root_attribute) != attributes.end()) return **it;
  }
  for (const LanguageRules* it : languages()) {
    if (it->root_may_lack_it) return *it;
  }
  return kLockstepRules;
}

}  // namespace

const LanguageRules& language_of(std::string_view text) {
  Scanner scanner(text, Grammar::Lenient);
  std::vector<std::string_view> attributes;
  while (true) {
    const XmlToken token = scanner.next();
    switch (token.kind) {
      case TokenKind::OpenTag:
        if (token.name != "root") return kLockstepRules;
        break;
      case TokenKind::Attribute:
        attributes.push_back(token.name);
        break;
      case TokenKind::TagEnd:
      case TokenKind::EmptyTagEnd:
        return chosen(attributes);
      case TokenKind::Text:
      case TokenKind::Comment:
      case TokenKind::Instruction:
      case TokenKind::Doctype:
        break;
      case TokenKind::CloseTag:
      case TokenKind::End:
      case TokenKind::Fault:
        return kLockstepRules;
    }
  }
}

}  // namespace lockstep::host
