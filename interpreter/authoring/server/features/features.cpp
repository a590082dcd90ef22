#include "authoring/server/features/feature.h"

namespace lockstep::host {

std::span<const Feature> features() {
  return {};
}

Json capabilities() {
  Json sync{{"openClose", true}, {"change", 2}, {"save", true}};
  return {{"positionEncoding", "utf-16"}, {"textDocumentSync", std::move(sync)}};
}

}  // namespace lockstep::host
