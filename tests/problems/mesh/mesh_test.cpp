#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>

#include "problems/mesh/find_mesh.h"
#include "problems/mesh/mesh_shape.h"
#include "problems/mesh/read_mesh.h"
#include "tests/support/refusals.h"
#include "tests/support/support.h"

namespace maxwrench {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

class MeshFolder : public testing::Test {
 protected:
  MeshFolder() {
    for (const char* name : {"MAXWRENCH_PACKAGE_PATH", "ROS_PACKAGE_PATH", "AMENT_PREFIX_PATH"}) {
      unsetenv(name);
    }
  }

  fs::path write(const std::string& name, const std::string& text) const {
    const fs::path file = folder_ / name;
    fs::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
    return file;
  }

  const TemporaryFolder temporary_;
  const fs::path folder_ = temporary_.path();
};

// The corners of a tetrahedron, in the formats.
const Points kCorners = {{0, 0, 0}, {0, 0, 3}, {0, 2, 0}, {1, 0, 0}};
constexpr int kFaces[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};

std::string shown_corner(const Vector3d& x) {
  return std::to_string(x.x()) + " " + std::to_string(x.y()) + " " + std::to_string(x.z());
}

std::string text_stl(int faces = 4) {
  std::string text = "solid corner\n";
  for (int i = 0; i < faces; ++i) {
    text += " facet normal 0 0 0\n  outer loop\n";
    for (const int k : kFaces[i]) {
      text += "   vertex " + shown_corner(kCorners[static_cast<std::size_t>(k)]) + "\n";
    }
    text += "  endloop\n endfacet\n";
  }
  return text + "endsolid corner\n";
}

std::string binary_stl(std::uint32_t announced = 4, float first = 0,
                       const std::string& head = "made by hand") {
  std::string text = head;
  text.resize(80, ' ');
  text.append(reinterpret_cast<const char*>(&announced), sizeof(announced));
  for (const auto& face : kFaces) {
    float numbers[12] = {};
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        numbers[3 + 3 * i + j] = static_cast<float>(kCorners[static_cast<std::size_t>(face[i])][j]);
      }
    }
    if (first != 0) numbers[3] = first;
    text.append(reinterpret_cast<const char*>(numbers), sizeof(numbers));
    text.append(2, '\0');
  }
  return text;
}

std::string obj() {
  std::string text = "mtllib none.mtl\no corner\n";
  for (const Vector3d& x : kCorners) text += "v " + shown_corner(x) + "\n";
  for (const auto& face : kFaces) {
    text += "f";
    for (const int k : face) text += " " + std::to_string(k + 1);
    text += "\n";
  }
  return text;
}

std::string ply() {
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
      "property float z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Vector3d& x : kCorners) text += shown_corner(x) + "\n";
  for (const auto& face : kFaces) {
    text += "3";
    for (const int k : face) text += " " + std::to_string(k);
    text += "\n";
  }
  return text;
}

/// A COLLADA file whose scene holds `nodes`.
std::string dae(const std::string& nodes, const std::string& asset = "",
                const std::string& library = "", const std::string& doctype = "") {
  std::string text =
      "<?xml version=\"1.0\"?>\n" + doctype +
      "<COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\">"
      "<asset>" +
      asset +
      "</asset><library_geometries><geometry id=\"g\"><mesh>"
      "<source id=\"p\"><float_array id=\"pa\" count=\"12\">";
  for (const Vector3d& x : kCorners) text += shown_corner(x) + " ";
  text +=
      "</float_array><technique_common><accessor source=\"#pa\" count=\"4\" stride=\"3\">"
      "<param name=\"X\" type=\"float\"/><param name=\"Y\" type=\"float\"/>"
      "<param name=\"Z\" type=\"float\"/></accessor></technique_common></source>"
      "<vertices id=\"v\"><input semantic=\"POSITION\" source=\"#p\"/></vertices>"
      "<triangles count=\"4\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>";
  for (const auto& face : kFaces) {
    for (const int k : face) text += std::to_string(k) + " ";
  }
  return text + "</p></triangles></mesh></geometry></library_geometries>" + library +
         "<library_visual_scenes><visual_scene id=\"s\">" + nodes +
         "</visual_scene></library_visual_scenes>"
         "<scene><instance_visual_scene url=\"#s\"/></scene></COLLADA>";
}

const char* const kPlainNode = "<node id=\"n\"><instance_geometry url=\"#g\"/></node>";

void expect_same_points(const Points& found, const Points& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (const Vector3d& x : expected) {
    EXPECT_TRUE(std::any_of(found.begin(), found.end(), [&](const Vector3d& y) {
      return (x - y).norm() < 1e-6;
    })) << x.transpose();
  }
}

using ReadMesh = MeshFolder;

TEST_F(ReadMesh, ReadsTheVerticesOfAllFormats) {
  expect_same_points(read_mesh(write("text.stl", text_stl())), kCorners);
  expect_same_points(read_mesh(write("late.stl", "\n " + text_stl())), kCorners);
  expect_same_points(read_mesh(write("binary.STL", binary_stl())), kCorners);
  expect_same_points(read_mesh(write("solid.stl", binary_stl(4, 0, "solid by name"))), kCorners);
  expect_same_points(read_mesh(write("tail.stl", binary_stl() + "a comment")), kCorners);
  expect_same_points(read_mesh(write("mesh.obj", obj())), kCorners);
  expect_same_points(read_mesh(write("mesh.ply", ply())), kCorners);
  expect_same_points(read_mesh(write("mesh.dae", dae(kPlainNode))), kCorners);
  expect_same_points(read_mesh(write("open.stl", text_stl(2))), kCorners);  // no closed surface
}

/// Nodes move, units count, and the up axis does not.
TEST_F(ReadMesh, PlacesTheNodesOfCollada) {
  const std::string nodes =
      "<node><translate>10 0 0</translate><node><scale>1 1 2</scale>"
      "<instance_geometry url=\"#g\"/></node></node>";
  Points expected;
  for (const Vector3d& x : kCorners) {
    expected.push_back(0.001 * (x.cwiseProduct(Vector3d(1, 1, 2)) + Vector3d(10, 0, 0)));
  }
  for (const char* up : {"X_UP", "Y_UP", "Z_UP"}) {
    const std::string asset = std::string("<unit meter=\"0.001\"/><up_axis>") + up + "</up_axis>";
    expect_same_points(read_mesh(write("mesh.dae", dae(nodes, asset))), expected);
  }
}

/// A binary glTF file of one triangle: three positions of three floats.
TEST_F(ReadMesh, ReadsGltf) {
  const float positions[9] = {0, 0, 0, 1, 0, 0, 0, 2, 0};
  std::string json =
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
      R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"buffers":[{"byteLength":36)"
      R"(}],"bufferViews":[{"buffer":0,"byteLength":36}],"accessors":[{"bufferView":0,)"
      R"("componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,2,0]}]})";
  const std::string bytes(reinterpret_cast<const char*>(positions), sizeof(positions));
  std::string with_uri = json;
  with_uri.replace(with_uri.find("\"byteLength\":36}],\"bufferViews"), 0, R"("uri":"mesh.bin",)");
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const auto word = [](std::size_t n) {
    const auto value = static_cast<std::uint32_t>(n);
    return std::string(reinterpret_cast<const char*>(&value), sizeof(value));
  };
  const std::string body =
      word(json.size()) + "JSON" + json + word(bytes.size()) + std::string("BIN\0", 4) + bytes;
  const Points expected = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}};
  expect_same_points(read_mesh(write("mesh.glb", "glTF" + word(2) + word(12 + body.size()) + body)),
                     expected);
  write("mesh.bin", bytes);
  expect_same_points(read_mesh(write("mesh.gltf", with_uri)), expected);
  expect_rejected((folder_ / "deep.gltf").string().append(": mesh").c_str(), [&] {
    read_mesh(write("deep.gltf", R"({"asset":)" + std::string(1'000'000, '[')));
  });
}

/// Each of these is one line, within seconds.
TEST_F(ReadMesh, RejectsHostileFiles) {
  std::string deep, wide;
  for (int i = 0; i < 100'000; ++i) deep += "<node>";
  for (int i = 0; i < 40; ++i) {
    const std::string next = "<instance_node url=\"#n" + std::to_string(i + 1) + "\"/>";
    wide += "<node id=\"n" + std::to_string(i) + "\">" + next + next + "</node>";
  }
  std::string laughs = "<!DOCTYPE COLLADA [<!ENTITY a0 \"ha\">";
  for (int i = 1; i < 30; ++i) {
    const std::string last = "&a" + std::to_string(i - 1) + ";";
    laughs += "<!ENTITY a" + std::to_string(i) + " \"" + last + last + last + "\">";
  }
  laughs += "]>";
  const std::string nan = "nan", no_faces = "v 0 0 0\nv 1 0 0\n";
  fs::create_directories(folder_ / "folder.stl");
  fs::create_symlink(folder_ / "loop.stl", folder_ / "loop.stl");
  ASSERT_EQ(mkfifo((folder_ / "pipe.stl").c_str(), 0600), 0);
  std::ofstream(folder_ / "long.stl").seekp(300'000'000).put(' ');
  write("empty.stl", "");
  write("short.stl", "short");
  write("words.stl", std::string(500, 'w'));
  write("solid.stl", "solid nothing\nendsolid\n");
  write("count.stl", binary_stl(40'000'000));
  write("wraps.stl", binary_stl(85'899'346 + 4));  // 50 n is 200 modulo 2^32, or nearly
  write("nan.stl", binary_stl(4, std::numeric_limits<float>::quiet_NaN()));
  write("infinite.stl", binary_stl(4, std::numeric_limits<float>::infinity()));
  write("words.obj", "these are no vertices\n");
  write("points.obj", no_faces);
  write("words.dae", "no XML");
  write("other.dae", "<robot/>");
  write("empty.dae", dae(""));
  std::string counts = dae(kPlainNode);
  write("count.dae", counts.replace(counts.find("count=\"12\""), 10, "count=\"2000000000\""));
  write("deep.dae", dae(deep));
  write("self.dae", dae("<node id=\"n\"><instance_node url=\"#n\"/></node>"));
  write("wide.dae", dae("<node><instance_node url=\"#n0\"/></node>", "",
                        "<library_nodes>" + wide + "<node id=\"n40\">" +
                            "<instance_geometry url=\"#g\"/></node></library_nodes>"));
  write("laughs.dae", dae("<node name=\"&a29;\"/>", "", "", laughs));
  write("words.ply", "ply\nnothing\n");
  write("count.ply",
        "ply\nformat binary_little_endian 1.0\nelement vertex 2000000000\n"
        "property float x\nproperty float y\nproperty float z\nend_header\n");
  write("words.glb", std::string(100, 'w'));
  write("mesh.txt", "text");
  for (const char* name :
       {"missing.stl",  "folder.stl", "loop.stl",  "pipe.stl",   "long.stl",  "empty.stl",
        "short.stl",    "words.stl",  "solid.stl", "count.stl",  "wraps.stl", "nan.stl",
        "infinite.stl", "words.obj",  "words.dae", "other.dae",  "empty.dae", "count.dae",
        "deep.dae",     "self.dae",   "wide.dae",  "laughs.dae", "words.ply", "count.ply",
        "words.glb",    "mesh.txt"}) {
    const std::string key = (folder_ / name).string() + ": mesh";
    expect_rejected(key.c_str(), [&] { read_mesh(folder_ / name); });
  }
}

using FindMesh = MeshFolder;

TEST_F(FindMesh, FollowsTheOrder) {
  const fs::path urdf = write("ws/arm/urdf/arm.urdf", "");
  const auto found = [&](const std::string& uri, const std::vector<fs::path>& packages = {}) {
    return find_mesh(uri, urdf, packages).file;
  };
  const fs::path beside = write("ws/arm/urdf/a b.stl", "x");
  EXPECT_EQ(found("a b.stl"), beside);
  EXPECT_EQ(found("a%20b.STL"), beside);  // the extension in other case
  EXPECT_EQ(found("../urdf/a%20b.stl"), beside);
  EXPECT_EQ(found(beside.string()), beside);
  EXPECT_EQ(found("file://" + beside.string()), beside);
  EXPECT_EQ(found("http://somewhere/x.stl"), "");

  // Above the URDF: as a collection without the package's name, then a folder in a folder, then the
  // package's own folder, which is nearest.
  const std::string uri = "package://arm/meshes/x.stl";
  EXPECT_EQ(found(uri), "");
  for (const char* name : {"ws/meshes/x.stl", "ws/arm/meshes/x.stl"}) {
    const fs::path file = write(name, "x");
    EXPECT_EQ(found(uri), file);
    EXPECT_EQ(found("model://arm/meshes/x.stl"), file);
  }
  const fs::path ament = write("opt/share/arm/meshes/x.stl", "x");
  setenv("AMENT_PREFIX_PATH", (folder_ / "opt").c_str(), 1);
  EXPECT_EQ(found(uri), ament);
  const fs::path ros = write("ros/stack/arm/meshes/x.stl", "x");
  setenv("ROS_PACKAGE_PATH", ("/nowhere:" + (folder_ / "ros").string()).c_str(), 1);
  EXPECT_EQ(found(uri), ros);
  const fs::path own = write("own/arm/meshes/x.stl", "x");
  setenv("MAXWRENCH_PACKAGE_PATH", ((folder_ / "own/arm").string() + "/").c_str(), 1);
  EXPECT_EQ(found(uri), own);
  const fs::path given = write("given/src/arm/meshes/x.stl", "x");
  EXPECT_EQ(found(uri, {folder_ / "given"}), given);
}

TEST_F(FindMesh, NamesAFewOfThePathsItTried) {
  fs::create_directory_symlink(folder_, folder_ / "loop");
  const FoundMesh found =
      find_mesh("package://arm/x.stl", folder_ / "loop/loop/loop/arm.urdf", {folder_ / "loop"});
  EXPECT_TRUE(found.file.empty());
  EXPECT_GE(found.tried.size(), 3U);
  EXPECT_LE(found.tried.size(), 10U);
  EXPECT_EQ(found.tried[0], (folder_ / "loop/arm/x.stl").string());
}

using MeshShapesOf = MeshFolder;

TEST_F(MeshShapesOf, ScalesAndReports) {
  write("corner.stl", binary_stl());
  write("damaged.stl", "short");
  MeshShapes shapes(folder_ / "arm.urdf", {});
  const MeshShape hull = shapes.shape("corner.stl", {0.1, -0.1, 0.1}, MeshUse::kHull);
  ASSERT_TRUE(hull.shape);
  EXPECT_EQ(hull.shape->kind, Shape::Kind::kHull);
  EXPECT_EQ(hull.note, "hull of 4 vertices");
  EXPECT_EQ(hull.file, folder_ / "corner.stl");
  Points expected;
  for (const Vector3d& x : kCorners) expected.push_back(x.cwiseProduct(Vector3d(0.1, -0.1, 0.1)));
  expect_same_points(hull.shape->points, expected);
  EXPECT_TRUE(shapes.shape("corner.stl", {1, 1, 1}, MeshUse::kCapsules).shape);

  const MeshShape missing = shapes.shape("gone.stl", {1, 1, 1}, MeshUse::kHull);
  EXPECT_FALSE(missing.shape);
  EXPECT_EQ(missing.note, "gone.stl: not found; tried " + (folder_ / "gone.stl").string());
  const MeshShape damaged = shapes.shape("damaged.stl", {1, 1, 1}, MeshUse::kHull);
  EXPECT_FALSE(damaged.shape);
  EXPECT_EQ(damaged.note.find((folder_ / "damaged.stl").string() + ": mesh: got 5 bytes"), 0U)
      << damaged.note;
  for (const double bad : {0.0, std::nan(""), kInfinity}) {
    expect_rejected("scale", [&] { shapes.shape("corner.stl", {1, bad, 1}, MeshUse::kHull); });
  }
  // A file is read once: its loss is not noticed.
  fs::remove(folder_ / "corner.stl");
  EXPECT_TRUE(shapes.shape("corner.stl", {0.1, -0.1, 0.1}, MeshUse::kHull).shape);
  EXPECT_FALSE(shapes.shape("corner.stl", {0.2, 0.1, 0.1}, MeshUse::kHull).shape);
}

}  // namespace
}  // namespace maxwrench
