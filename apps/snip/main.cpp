// The program snip; everything is in command_line.cpp, where tests can reach it.
#include "snip/command_line.hpp"

int main(int argc, char** argv) { return snip::run_command_line(argc, argv); }
