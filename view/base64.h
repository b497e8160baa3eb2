#pragma once

#include <string>
#include <string_view>

namespace maxwrench {

/// Bytes as text, RFC 4648.
std::string base64(std::string_view bytes);

/// The bytes of such a text.
std::string from_base64(std::string_view text);

}  // namespace maxwrench
