#include "web/page.h"

#include "web/gzip.h"
#include "web/page_text.h"

namespace lockstep::host {
namespace {

constexpr std::string_view kSourceBegin = R"(<script type="application/json" id="source">)";

// Nothing in it ends the element in which it stands.
std::string without_tags(std::string_view json) {
  std::string text;
  text.reserve(json.size());
  for (const char letter : json) {
    if (letter == '<') {
      text += "\\u003c";
    } else {
      text += letter;
    }
  }
  return text;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view kLetters =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned group = 0;
    for (std::size_t byte = i; byte < i + 3; ++byte) {
      group = group << 8u | (byte < bytes.size() ? static_cast<unsigned char>(bytes[byte]) : 0u);
    }
    for (unsigned letter = 0; letter < 4; ++letter) {
      const bool pads = i + letter > bytes.size();
      text += pads ? '=' : kLetters[group >> (18 - 6 * letter) & 63u];
    }
  }
  return text;
}

}  // namespace

std::string page_with_source(std::string_view source) {
  const std::size_t begin = kPage.find(kSourceBegin) + kSourceBegin.size();
  const std::size_t end = kPage.find('<', begin);
  std::string page(kPage.substr(0, begin));
  page += without_tags(source);
  return page += kPage.substr(end);
}

std::string page_with_recording(std::string_view recording) {
  return page_with_source("{\"recording\":\"" + base64(gzip(recording)) + "\"}");
}

std::string_view page_policy() {
  constexpr std::string_view kBegin = R"("Content-Security-Policy" content=")";
  const std::size_t begin = kPage.find(kBegin) + kBegin.size();
  return kPage.substr(begin, kPage.find('"', begin) - begin);
}

}  // namespace lockstep::host
