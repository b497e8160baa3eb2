#include "cli/cli.h"

int main(int argc, char** argv) { return maxwrench::run_command(argc, argv); }
