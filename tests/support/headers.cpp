// A unit for the precompiled header of all test programs.
