#include "cli/figures.h"
namespace maxwrench { std::string figure(const Problem&, const std::vector<Panel>&) { return ""; } }
