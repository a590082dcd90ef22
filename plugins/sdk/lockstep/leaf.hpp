// lockstep/leaf.hpp: leaves in C++17, over the C contract of lockstep/leaf.h. Header only, nothing
// but the standard library. This is the one header that a plugin includes; docs/plugins.md is its
// manual. In a few lines:
//
//   struct AdvancePorts : lockstep::Ports {
//     Input<double> step{this, "step", "0.01", "progress per tick"};
//   };
//   class Advance : public lockstep::Action<AdvancePorts> {
//     public: Status tick() override; double progress() const override; …
//   };
//   LOCKSTEP_PLUGIN("motion", "1.0", "Actions that make progress",
//                   lockstep::leaf<Advance>("Advance", "Moves on by a step each tick"));
#pragma once

#include "cpp/action.hpp"           // IWYU pragma: export
#include "cpp/any_port.hpp"         // IWYU pragma: export
#include "cpp/control.hpp"          // IWYU pragma: export
#include "cpp/element.hpp"          // IWYU pragma: export
#include "cpp/plugin.hpp"           // IWYU pragma: export
#include "cpp/port.hpp"             // IWYU pragma: export
#include "cpp/threaded_action.hpp"  // IWYU pragma: export
