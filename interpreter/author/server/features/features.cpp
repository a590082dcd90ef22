#include "author/server/features/actions.h"
#include "author/server/features/completion.h"
#include "author/server/features/feature.h"
#include "author/server/features/formatting.h"
#include "author/server/features/hover.h"
#include "author/server/features/lens.h"
#include "author/server/features/navigation.h"
#include "author/server/features/rename.h"
#include "author/server/features/script_tokens.h"
#include "author/server/features/structure.h"

namespace lockstep::host {

std::span<const Feature> features() {
  static constexpr Feature kFeatures[] = {
      {"textDocument/completion", completion},
      {"textDocument/hover", hover},
      {"textDocument/definition", definition},
      {"textDocument/references", references},
      {"textDocument/documentHighlight", highlights},
      {"textDocument/documentSymbol", document_symbols},
      {"textDocument/foldingRange", folding_ranges},
      {"textDocument/formatting", formatting},
      {"textDocument/prepareRename", prepare_rename},
      {"textDocument/rename", rename, false, true},
      {"textDocument/codeAction", code_actions, false},
      {"textDocument/codeLens", code_lenses},
      {"textDocument/inlayHint", inlay_hints},
      {"textDocument/semanticTokens/full", script_tokens},
  };
  return kFeatures;
}

Json capabilities() {
  Json sync{{"openClose", true}, {"change", 2}, {"save", true}};
  std::vector<Json> signs, kinds;
  for (const char* sign : {"<", "/", " ", "\"", "'", "{", "$"}) signs.emplace_back(sign);
  for (const char* kind : {"quickfix", "refactor.extract", "refactor.inline", "refactor.rewrite"})
    kinds.emplace_back(kind);
  Json tokens{{"legend", script_token_legend()}, {"full", true}};
  return {{"positionEncoding", "utf-16"},
          {"textDocumentSync", std::move(sync)},
          {"completionProvider", Json{{"triggerCharacters", Json::array(std::move(signs))}}},
          {"hoverProvider", true},
          {"definitionProvider", true},
          {"referencesProvider", true},
          {"documentHighlightProvider", true},
          {"documentSymbolProvider", true},
          {"foldingRangeProvider", true},
          {"documentFormattingProvider", true},
          {"renameProvider", Json{{"prepareProvider", true}}},
          {"codeActionProvider", Json{{"codeActionKinds", Json::array(std::move(kinds))}}},
          {"codeLensProvider", Json{{"resolveProvider", false}}},
          {"inlayHintProvider", true},
          {"semanticTokensProvider", std::move(tokens)}};
}

}  // namespace lockstep::host
