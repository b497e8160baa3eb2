#include "problems/mesh/find_mesh.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <system_error>

#include "problems/loader/bad_input.h"

namespace maxwrench {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostTried = 6;      ///< paths that a message names
constexpr int kMostFolders = 1000;         ///< of a folder that are looked into for a package
constexpr std::size_t kLongestUri = 4096;  ///< no path of a file is longer

/// The text with each %XY replaced by the character of this hexadecimal number.
std::string unescaped(const std::string& text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto hex = [&](std::size_t k) {
      return k < text.size() && std::isxdigit(static_cast<unsigned char>(text[k])) != 0;
    };
    if (text[i] == '%' && hex(i + 1) && hex(i + 2)) {
      result += static_cast<char>(std::stoi(text.substr(i + 1, 2), nullptr, 16));
      i += 2;
    } else {
      result += text[i];
    }
  }
  return result;
}

bool is_there(const fs::path& path) {
  std::error_code none;  // also of a link to itself
  return fs::exists(path, none);
}

/// The search for one mesh.
class Lookup {
 public:
  /// Takes the path, or the same with the extension in other case. Returns whether it is there.
  bool take(const fs::path& path) {
    std::string extension = path.extension().string();
    for (const auto turn : {+[](int c) { return c; }, +[](int c) { return std::tolower(c); },
                            +[](int c) { return std::toupper(c); }}) {
      std::transform(extension.begin(), extension.end(), extension.begin(), [&](char c) {
        return static_cast<char>(turn(static_cast<unsigned char>(c)));
      });
      fs::path candidate = path;
      candidate.replace_extension(extension);
      if (!is_there(candidate)) continue;
      found_.file = candidate.lexically_normal();
      return true;
    }
    const std::string tried = path.lexically_normal().string();
    if (found_.tried.size() < kMostTried &&
        std::find(found_.tried.begin(), found_.tried.end(), tried) == found_.tried.end()) {
      found_.tried.push_back(tried);
    }
    return false;
  }

  /// Looks into a folder that is the package or contains it.
  bool take_from(const fs::path& folder, const std::string& package, const fs::path& rest) {
    if (folder.filename() == package && take(folder / rest)) return true;
    if (take(folder / package / rest)) return true;
    if (is_folder(folder / "src" / package) && take(folder / "src" / package / rest)) return true;
    std::error_code failed;
    int looked = 0;
    for (fs::directory_iterator i(folder, failed), end; !failed && i != end; i.increment(failed)) {
      if (++looked > kMostFolders) break;
      if (is_folder(i->path() / package) && take(i->path() / package / rest)) return true;
    }
    return false;
  }

  FoundMesh result() { return std::move(found_); }

 private:
  FoundMesh found_;
};

std::vector<fs::path> folders_of(const char* variable) {
  std::vector<fs::path> folders;
  const char* value = std::getenv(variable);
  std::string rest = value == nullptr ? "" : value;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(':'), rest.size());
    if (end > 0) {
      const fs::path folder = rest.substr(0, end);
      folders.push_back(folder.has_filename() ? folder : folder.parent_path());
    }
    rest.erase(0, end + 1);
  }
  return folders;
}

void find_in_package(const std::string& name, const fs::path& urdf,
                     const std::vector<fs::path>& packages, Lookup& search) {
  const std::size_t slash = name.find('/');
  if (slash == std::string::npos || slash == 0) return void(search.take(urdf.parent_path() / name));
  const std::string package = name.substr(0, slash);
  const fs::path rest = fs::path(name.substr(slash + 1)).relative_path();
  std::vector<fs::path> folders = packages;
  for (const char* variable : {"MAXWRENCH_PACKAGE_PATH", "ROS_PACKAGE_PATH"}) {
    for (const fs::path& folder : folders_of(variable)) folders.push_back(folder);
  }
  for (const fs::path& folder : folders) {
    const fs::path tidy = folder.has_filename() ? folder : folder.parent_path();
    if (search.take_from(tidy, package, rest)) return;
  }
  for (const fs::path& folder : folders_of("AMENT_PREFIX_PATH")) {
    if (search.take(folder / "share" / package / rest)) return;
  }
  std::error_code none;
  fs::path above = fs::absolute(urdf, none).lexically_normal().parent_path();
  while (true) {
    if (above.filename() == package && search.take(above / rest)) return;
    if (search.take(above / package / rest) || search.take(above / rest)) return;
    if (above == above.parent_path()) return;
    above = above.parent_path();
  }
}

}  // namespace

FoundMesh find_mesh(const std::string& uri, const std::filesystem::path& urdf,
                    const std::vector<std::filesystem::path>& packages) {
  Lookup search;
  if (uri.empty() || uri.size() > kLongestUri) return {};
  const std::size_t colon = uri.find("://");
  const std::string scheme = colon == std::string::npos ? "" : uri.substr(0, colon);
  std::string rest = unescaped(scheme.empty() ? uri : uri.substr(colon + 3));
  if (rest.find('\0') != std::string::npos) return {};
  if (scheme == "package" || scheme == "model") {
    rest.erase(0, rest.find_first_not_of('/'));  // package:///PKG is written, too
    find_in_package(rest, urdf, packages, search);
  } else if (scheme.empty() || scheme == "file") {
    // file:/// is absolute; people also write file:// before a path relative to the URDF.
    search.take(urdf.parent_path() / rest);
  }
  return search.result();
}

}  // namespace maxwrench
