#include "cli/command.h"
#include "core/descriptors.h"

int main(int argc, char** argv) {
  lockstep::hold_standard_descriptors();
  return lockstep::run_program(argc, argv);
}
