// An action that moves a part of a scene: halted or paused, the part stands still.
#pragma once

#include <lockstep/leaf.hpp>

namespace r1sim {

template <class Ports>
class PartAction : public lockstep::Action<Ports> {
 public:
  void halt() override { moves() = false; }
  void pause() override { moves() = false; }
  void resume() override { moves() = true; }

 private:
  // Whether the part moves, in a scene that is as of now.
  virtual bool& moves() const = 0;
};

}  // namespace r1sim
