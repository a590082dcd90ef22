#include "document/language_of.h"

#include "document/scanner.h"

namespace lockstep {

Language language_of(std::string_view text) {
  Scanner scanner(text, Grammar::Lenient);
  bool is_ours = false, is_theirs = false;
  while (true) {
    const XmlToken token = scanner.next();
    switch (token.kind) {
      case TokenKind::OpenTag:
        if (token.name != "root") return Language::Lockstep;
        break;
      case TokenKind::Attribute:
        is_ours |= token.name == "lockstep";
        is_theirs |= token.name == "BTCPP_format";
        break;
      case TokenKind::TagEnd:
      case TokenKind::EmptyTagEnd:
        return is_theirs || !is_ours ? Language::BehaviorTreeCpp : Language::Lockstep;
      case TokenKind::Text:
      case TokenKind::Comment:
      case TokenKind::Instruction:
      case TokenKind::Doctype:
        break;
      case TokenKind::CloseTag:
      case TokenKind::End:
      case TokenKind::Fault:
        return Language::Lockstep;
    }
  }
}

}  // namespace lockstep
