#include "problems/mesh/mesh_text.h"

#include <fmt/format.h>
#include <tinyxml2.h>

#include <cstdint>
#include <cstring>
#include <map>
#include <sstream>
#include <string_view>
#include <vector>

#include "problems/loader/bad_input.h"

namespace maxwrench {
namespace {

using tinyxml2::XMLElement;

constexpr std::size_t kStlHeader = 84, kStlTriangle = 50;  ///< [bytes]
constexpr int kDeepestJson = 64;                           ///< glTF needs about ten
constexpr double kMostNodes = 1e5;                         ///< of a COLLADA scene
constexpr const char* kStl = "the triangles of an STL file";

[[noreturn]] void throw_bad_count(const std::filesystem::path& file, const std::string& what,
                                  std::size_t count, std::size_t bytes) {
  throw_bad_mesh(file, fmt::format("{} {} announced in {} bytes", count, what, bytes),
                 "as many as the file holds");
}

/// A binary STL has a header, a count n and n triangles. A text STL begins with `solid`; so do some
/// binary ones, where the count fits the length.
void check_stl(const std::filesystem::path& file, std::string& text) {
  const std::size_t start = text.find_first_not_of(" \t\r\n");
  const bool solid = start != std::string::npos && text.compare(start, 5, "solid") == 0;
  std::uint32_t count = 0;
  std::size_t length = 0;
  if (text.size() >= kStlHeader) {
    std::memcpy(&count, text.data() + kStlHeader - sizeof(count), sizeof(count));
    length = kStlHeader + kStlTriangle * count;
    if (length == text.size()) return;
  }
  if (solid && text.find("facet") != std::string::npos) {
    text.erase(0, start);  // Assimp wants `solid` at the very beginning
    return;
  }
  if (text.size() < kStlHeader) {
    throw_bad_mesh(file, fmt::format("{} bytes", text.size()), kStl);
  }
  if (length > text.size()) {
    throw_bad_count(file, "triangles", count, text.size());
  }
  text.resize(length);  // some programs append a comment
}

/// The header of a PLY file: lines `element NAME COUNT`.
void check_ply(const std::filesystem::path& file, const std::string& text) {
  std::istringstream header(text.substr(0, text.find("end_header")));
  for (std::string word, name; header >> word;) {
    std::size_t count = 0;
    if (word != "element" || !(header >> name)) continue;
    if (!(header >> count) || count > text.size()) throw_bad_count(file, name, count, text.size());
  }
}

/// The nodes of a COLLADA file by their ids, and how many each of them becomes.
class ColladaNodes {
 public:
  ColladaNodes(const std::filesystem::path& file, const XMLElement& root, std::size_t bytes)
      : file_(file), bytes_(bytes) {
    collect(root);
  }

  /// How many nodes this element and all that it contains or instantiates become.
  double count(const XMLElement& element) {
    const auto [entry, added] = counts_.emplace(&element, -1);
    if (!added) {
      if (entry->second < 0) {
        throw_bad_mesh(file_, "a node that contains itself", "a tree of nodes");
      }
      return entry->second;
    }
    double sum = 1;
    for (const XMLElement* child = element.FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement()) {
      sum +=
          std::strcmp(child->Name(), "instance_node") == 0 ? count_instance(*child) : count(*child);
    }
    if (sum > kMostNodes) {
      throw_bad_mesh(file_, "nodes that repeat each other without bound",
                     fmt::format("at most {} nodes", kMostNodes));
    }
    return counts_[&element] = sum;
  }

 private:
  void collect(const XMLElement& element) {
    const char* id = element.Attribute("id");
    if (id != nullptr) by_id_.emplace(id, &element);
    const std::uint64_t announced = element.Unsigned64Attribute("count");
    if (announced > bytes_) throw_bad_count(file_, element.Name(), announced, bytes_);
    for (const XMLElement* child = element.FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement()) {
      collect(*child);
    }
  }

  double count_instance(const XMLElement& instance) {
    const char* url = instance.Attribute("url");
    const auto found = by_id_.find(url == nullptr || *url != '#' ? "" : url + 1);
    return found == by_id_.end() ? 1 : count(*found->second);
  }

  const std::filesystem::path& file_;
  std::size_t bytes_;
  std::map<std::string, const XMLElement*> by_id_;
  std::map<const XMLElement*, double> counts_;
};

/// tinyxml2 rejects elements that are nested too deeply.
void check_collada(const std::filesystem::path& file, const std::string& text) {
  if (text.find("<!ENTITY") != std::string::npos) {
    throw_bad_mesh(file, "entities that it defines itself", "a COLLADA file without them");
  }
  tinyxml2::XMLDocument document;
  if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
    const bool deep = document.ErrorID() == tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED;
    throw_bad_mesh(file,
                   deep ? "elements that are nested too deeply"
                        : fmt::format("damaged XML in line {}", document.ErrorLineNum()),
                   "a COLLADA file");
  }
  const XMLElement* root = document.RootElement();
  if (root == nullptr || std::strcmp(root->Name(), "COLLADA") != 0) {
    throw_bad_mesh(file, root == nullptr ? "nothing" : fmt::format("<{}>", root->Name()),
                   "<COLLADA>");
  }
  ColladaNodes nodes(file, *root, text.size());
  for (const char* scenes : {"library_visual_scenes", "library_nodes"}) {
    for (const XMLElement* library = root->FirstChildElement(scenes); library != nullptr;
         library = library->NextSiblingElement(scenes)) {
      nodes.count(*library);
    }
  }
}

/// The text of a glTF file, which is a part of a binary one: brackets outside strings.
void check_json(const std::filesystem::path& file, const std::string& text, bool binary) {
  std::size_t begin = 0, end = text.size();
  if (binary) {
    constexpr std::size_t kJsonBegins = 20;
    std::uint32_t length = 0;
    if (text.size() < kJsonBegins || text.compare(0, 4, "glTF") != 0) {
      throw_bad_mesh(file, "no header", "a binary glTF file");
    }
    std::memcpy(&length, text.data() + 12, sizeof(length));
    begin = kJsonBegins;
    end = std::min(end, begin + length);
  }
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = begin; i < end; ++i) {
    const char c = text[i];
    if (quoted && c == '\\') ++i;
    if (c == '"') quoted = !quoted;
    if (quoted) continue;
    if (c == '[' || c == '{') ++depth;
    if (c == ']' || c == '}') --depth;
    if (depth <= kDeepestJson) continue;
    throw_bad_mesh(file, "brackets that are nested too deeply", "a glTF file");
  }
}

}  // namespace

void throw_bad_mesh(const std::filesystem::path& file, const std::string& got,
                    const std::string& expected) {
  throw_bad_input(file, "mesh", got, expected);
}

std::string read_mesh_file(const std::filesystem::path& file) {
  std::error_code none;
  if (!is_file(file)) {
    const auto type = std::filesystem::status(file, none).type();
    const bool missing = type == std::filesystem::file_type::not_found;
    const bool folder = type == std::filesystem::file_type::directory;
    throw_bad_mesh(file, missing ? "nothing" : folder ? "a folder" : "no regular file", "a file");
  }
  const std::uintmax_t length = std::filesystem::file_size(file, none);
  if (none || length > kLongestMesh) {
    throw_bad_mesh(file, fmt::format("{} MB", length / 1'000'000),
                   fmt::format("at most {} MB", kLongestMesh / 1'000'000));
  }
  std::ifstream stream = open_file(file, "a mesh");
  std::string text(length, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(length));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (text.empty()) throw_bad_mesh(file, "an empty file", "a mesh");
  return text;
}

void check_mesh_text(const std::filesystem::path& file, const std::string& extension,
                     std::string& text) {
  if (extension == ".stl") check_stl(file, text);
  if (extension == ".ply") check_ply(file, text);
  if (extension == ".dae") check_collada(file, text);
  if (extension == ".glb" || extension == ".gltf") check_json(file, text, extension == ".glb");
}

}  // namespace maxwrench
