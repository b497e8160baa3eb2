#include "view/engine/module.h"

#include "view/copied_file.h"

MAXWRENCH_COPIED_FILE(engine_module, "engine/engine.wasm.gz")
MAXWRENCH_COPIED_FILE(engine_loader, "engine/engine.js")
