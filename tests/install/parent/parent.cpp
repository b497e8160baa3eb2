#include "maxwrench/types.h"

int main() { return maxwrench::kInfinity > 0 ? 0 : 1; }
