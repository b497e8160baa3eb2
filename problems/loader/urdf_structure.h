#pragma once

#include <filesystem>
#include <string>

class TiXmlElement;

namespace maxwrench {

// What urdfdom would pass over in silence or fall over: it takes the first of two elements where
// one belongs, drops shapes that it does not know and all but the last parent of a link, and calls
// itself for every link of a chain.

/// Refuses XML whose elements are nested so deep that its parser would overrun the stack.
void require_shallow(const std::filesystem::path& file, const std::string& text);

/// Refuses links and joints without a name of their own, elements that are missing or given twice,
/// collision shapes other than boxes, cylinders and spheres, and what is not one tree of at most
/// 1000 links.
void check_structure(const std::filesystem::path& file, const TiXmlElement& robot);

}  // namespace maxwrench
