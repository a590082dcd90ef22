#include "cli/command.h"

int main(int argc, char** argv) {
  return lockstep::run_program(argc, argv);
}
