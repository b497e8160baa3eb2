#pragma once

#include <string_view>

namespace maxwrench {

/// The WebAssembly module that evaluates a task in a page: the bytes of
/// view/engine/engine.wasm.gz.
std::string_view engine_module();

/// The script that defines `createEngine`: the text of view/engine/engine.js.
std::string_view engine_loader();

}  // namespace maxwrench
