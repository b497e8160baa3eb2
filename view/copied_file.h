#pragma once

#include <string_view>

/// Defines `std::string_view maxwrench::function()`, the bytes of a file below view/. The assembler
/// copies it: as an array in C++ it would take a minute to compile. CMake builds the unit again if
/// the file has changed.
#define MAXWRENCH_COPIED_FILE(function, file)                                 \
  asm(".pushsection .rodata\n"                                                \
      ".global maxwrench_" #function ", maxwrench_" #function                 \
      "_end\n"                                                                \
      "maxwrench_" #function                                                  \
      ":\n"                                                                   \
      ".incbin \"" MAXWRENCH_VIEW_FOLDER "/" file                             \
      "\"\n"                                                                  \
      "maxwrench_" #function                                                  \
      "_end:\n"                                                               \
      ".popsection\n");                                                       \
  extern "C" const char maxwrench_##function[], maxwrench_##function##_end[]; \
  std::string_view maxwrench::function() {                                    \
    return {maxwrench_##function, maxwrench_##function##_end};                \
  }
