#pragma once

#include <string_view>

namespace maxwrench {

/// The page without a scene: the text of view/page/page.html.
std::string_view page_file();

}  // namespace maxwrench
