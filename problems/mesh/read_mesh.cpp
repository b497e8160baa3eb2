#include "problems/mesh/read_mesh.h"

#include <assimp/MemoryIOWrapper.h>
#include <assimp/config.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <assimp/DefaultLogger.hpp>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <cctype>
#include <exception>
#include <memory>

#include "problems/make/bad_value.h"
#include "problems/mesh/mesh_text.h"

namespace maxwrench {
namespace {

constexpr std::array kFormats = {".stl", ".dae", ".obj", ".ply", ".glb", ".gltf"};
constexpr std::size_t kMostVertices = 50'000'000;  ///< of a scene, with those that nodes repeat

/// What Assimp sees of the file system: the mesh itself, and beside a glTF file its buffers. Files
/// of materials and images are not opened.
class MeshFiles : public Assimp::IOSystem {
 public:
  MeshFiles(const std::filesystem::path& file, const std::string& text, bool with_buffers)
      : file_(file), text_(text), with_buffers_(with_buffers) {}

  bool Exists(const char* name) const override { return name == file_.string() || buffer(name); }
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* name, const char* /*mode*/) override {
    if (name == file_.string()) return stream_of(text_);
    if (!buffer(name)) return nullptr;
    buffers_.push_back(std::make_unique<std::string>(read_mesh_file(name)));
    return stream_of(*buffers_.back());
  }
  void Close(Assimp::IOStream* stream) override { delete stream; }

 private:
  /// Whether the name is that of a buffer in the folder of the mesh or below it.
  bool buffer(const std::filesystem::path& name) const {
    if (!with_buffers_ || name.extension() != ".bin") return false;
    const std::string path = name.lexically_normal().string();
    const std::filesystem::path folder = file_.lexically_normal().parent_path();
    std::error_code none;
    return (folder.empty() || path.starts_with(folder.string() + "/")) &&
           std::filesystem::is_regular_file(name, none);
  }

  static Assimp::IOStream* stream_of(const std::string& text) {
    return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(text.data()),
                                      text.size());
  }

  const std::filesystem::path& file_;
  const std::string& text_;
  bool with_buffers_;
  std::vector<std::unique_ptr<std::string>> buffers_;
};

/// Collects the parts of a scene in its own axes.
class Collector {
 public:
  Collector(const std::filesystem::path& file, const aiScene& scene, bool coloured)
      : file_(file), scene_(scene), coloured_(coloured) {}

  void visit(const aiNode& node, const aiMatrix4x4t<double>& parent) {
    const aiMatrix4x4t<double> pose = parent * aiMatrix4x4t<double>(node.mTransformation);
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      const aiMesh& mesh = *scene_.mMeshes[node.mMeshes[i]];
      if (mesh.mVertices != nullptr) add(pose, mesh);
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) visit(*node.mChildren[i], pose);
  }

  std::vector<Triangles> parts;

 private:
  void add(const aiMatrix4x4t<double>& pose, const aiMesh& mesh) {
    vertices_ += mesh.mNumVertices;
    if (vertices_ > kMostVertices) {
      throw_bad_mesh(file_, fmt::format("more than {} vertices", kMostVertices), "fewer vertices");
    }
    Triangles& part = part_of(mesh);
    const auto first = static_cast<int>(part.points.size());
    for (unsigned k = 0; k < mesh.mNumVertices; ++k) add(pose, mesh.mVertices[k], part);
    for (unsigned k = 0; k < mesh.mNumFaces; ++k) add(first, mesh.mFaces[k], part);
  }

  void add(const aiMatrix4x4t<double>& pose, const aiVector3D& at, Triangles& part) {
    const aiVector3t<double> moved = pose * aiVector3t<double>(at.x, at.y, at.z);
    const Eigen::Vector3d x(moved.x, moved.y, moved.z);
    if (!x.allFinite()) {
      throw_bad_mesh(file_, fmt::format("vertex {}", shown(x)), "finite numbers");
    }
    part.points.push_back(x);
  }

  static void add(int first, const aiFace& face, Triangles& part) {
    const auto corner = [&](unsigned i) { return first + static_cast<int>(face.mIndices[i]); };
    for (unsigned i = 2; i < face.mNumIndices; ++i) {
      part.triangles.emplace_back(corner(0), corner(i - 1), corner(i));
    }
  }

  /// The part with the colour of the mesh, which is added if it is new.
  Triangles& part_of(const aiMesh& mesh) {
    std::optional<std::array<double, 3>> colour;
    aiColor4D given;
    if (coloured_ && mesh.mMaterialIndex < scene_.mNumMaterials &&
        aiGetMaterialColor(scene_.mMaterials[mesh.mMaterialIndex], AI_MATKEY_COLOR_DIFFUSE,
                           &given) == AI_SUCCESS) {
      const Eigen::Array3d rgb = Eigen::Array3d(given.r, given.g, given.b).max(0).min(1);
      if (rgb.allFinite()) colour = {rgb[0], rgb[1], rgb[2]};
    }
    const auto same = std::find_if(parts.begin(), parts.end(),
                                   [&](const Triangles& part) { return part.colour == colour; });
    return same != parts.end() ? *same : parts.emplace_back(Triangles{{}, {}, colour});
  }

  const std::filesystem::path& file_;
  const aiScene& scene_;
  bool coloured_;
  std::size_t vertices_ = 0;
};

void make_unique(std::vector<Eigen::Vector3d>& points) {
  const auto less = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
  };
  std::sort(points.begin(), points.end(), less);
  points.erase(std::unique(points.begin(), points.end()), points.end());
}

std::vector<Triangles> import_parts(const std::filesystem::path& file,
                                    const std::string& extension) {
  std::string text = read_mesh_file(file);
  check_mesh_text(file, extension, text);
  Assimp::Importer importer;
  importer.SetIOHandler(new MeshFiles(file, text, extension == ".gltf"));
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);  // no points for nodes
  const aiScene* scene = importer.ReadFile(file.string(), 0);
  if (scene == nullptr || scene->mRootNode == nullptr) {
    std::string why = importer.GetErrorString();
    throw_bad_mesh(file, fmt::format("what Assimp cannot read ({})", why.substr(0, 120)), "a mesh");
  }
  const bool coloured = extension == ".dae" || extension == ".glb" || extension == ".gltf";
  Collector collector(file, *scene, coloured);
  collector.visit(*scene->mRootNode, aiMatrix4x4t<double>());
  if (collector.parts.empty()) throw_bad_mesh(file, "no vertices", "a mesh");
  return std::move(collector.parts);
}

}  // namespace

std::vector<Triangles> read_parts(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (std::find(kFormats.begin(), kFormats.end(), extension) == kFormats.end()) {
    throw_bad_mesh(file, fmt::format("'{}'", extension),
                   fmt::format("a mesh: {}", fmt::join(kFormats, ", ")));
  }
  try {
    return import_parts(file, extension);
  } catch (const std::invalid_argument&) {
    throw;
  } catch (const std::exception& error) {  // of Assimp, such as too little memory
    throw_bad_mesh(file, fmt::format("what Assimp cannot read ({})", error.what()), "a mesh");
  }
}

std::vector<Eigen::Vector3d> read_mesh(const std::filesystem::path& file) {
  std::vector<Eigen::Vector3d> points;
  for (const Triangles& part : read_parts(file)) {
    points.insert(points.end(), part.points.begin(), part.points.end());
  }
  make_unique(points);
  return points;
}

}  // namespace maxwrench
