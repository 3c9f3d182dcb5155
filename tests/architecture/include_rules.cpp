#include "architecture/include_rules.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <optional>
#include <set>

namespace plumb::testing {
namespace fs = std::filesystem;
namespace {

// What each module may include besides itself.
const std::map<std::string, std::set<std::string>>& allowed_modules() {
  static const std::map<std::string, std::set<std::string>> kAllowed{
      {"core", {}},
      {"terrain", {"core"}},
      {"image", {"core"}},
      {"raster", {"core", "terrain", "image"}},
      {"reference", {"core", "terrain", "image"}},
      {"report", {"core", "terrain", "image"}},
      {"slicing", {"core", "terrain", "image", "raster"}},
      {"mesh", {"core", "terrain", "image"}},
      {"gpu", {"core", "terrain", "image", "raster", "slicing", "mesh"}},
      {"audit", {"core", "terrain", "image", "raster", "reference", "report", "slicing", "mesh"}},
  };
  return kAllowed;
}

// Folders of src/mesh that several methods share and that are no method.
const std::set<std::string> kSharedByMethods{"dual_contouring", "patch_quadtree"};

// A library of others: how its headers begin, and the modules whose .cpp files may know it.
struct HeavyLibrary {
  const char* name;
  std::vector<std::string> beginnings;
  std::optional<std::set<std::string>> modules;  // nothing: any, but no header
};

const std::vector<HeavyLibrary>& heavy_libraries() {
  static const std::vector<HeavyLibrary> kLibraries{
      {"Embree", {"embree"}, std::set<std::string>{"reference"}},
      {"OpenImageIO", {"OpenImageIO/"}, std::set<std::string>{"image", "terrain"}},
      {"GDAL", {"gdal", "ogr", "cpl_"}, std::set<std::string>{"terrain"}},
      {"the TOML library", {"toml"}, std::nullopt},
      {"the JSON library", {"nlohmann/"}, std::nullopt},
      {"the command-line library", {"CLI/"}, std::nullopt},
  };
  return kLibraries;
}

struct Include {
  int line = 0;
  std::string path;
  bool quoted = false;
};

// The first part of a path, or the second below it.
std::string part(const std::string& path, int which) {
  std::size_t begin = 0;
  for (; which > 0; --which) {
    begin = path.find('/', begin);
    if (begin == std::string::npos) return "";
    ++begin;
  }
  const std::size_t end = path.find('/', begin);
  return end == std::string::npos ? "" : path.substr(begin, end - begin);
}

std::vector<Include> includes_of(const fs::path& file) {
  std::vector<Include> found;
  std::ifstream stream(file);
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    const std::size_t hash = line.find_first_not_of(" \t");
    if (hash == std::string::npos || line[hash] != '#') continue;
    const std::size_t word = line.find_first_not_of(" \t", hash + 1);
    if (word == std::string::npos || line.compare(word, 7, "include") != 0) continue;
    const std::size_t open = line.find_first_of("<\"", word);
    if (open == std::string::npos) continue;
    const std::size_t close = line.find(line[open] == '<' ? '>' : '"', open + 1);
    if (close == std::string::npos) continue;
    found.push_back({number, line.substr(open + 1, close - open - 1), line[open] == '"'});
  }
  return found;
}

// Why a file of src/ may not include another of src/; empty if it may. Paths below src/.
std::string objection(const std::string& file, const std::string& included) {
  const std::string module = part(file, 0), other = part(included, 0);
  if (!allowed_modules().contains(other)) return "";
  if (module != other) {
    return allowed_modules().at(module).contains(other) ? "" : module + " may not know " + other;
  }
  const std::string method = part(file, 1), neighbour = part(included, 1);
  if (module != "mesh" || method == neighbour || neighbour.empty()) return "";
  if (kSharedByMethods.contains(neighbour)) return "";
  return "a method may not know another (" + neighbour + ")";
}

// A header that the module's list names goes out to users; one that it does not stays inside.
bool is_private(const fs::path& root, const fs::path& file, const std::string& module) {
  if (file.extension() == ".cpp") return true;
  if (module.empty()) return false;
  std::ifstream list(root / "src" / module / "CMakeLists.txt");
  const std::string name = fs::relative(file, root / "src" / module).generic_string();
  for (std::string word; list >> word;) {
    if (word == name || word == name + ")") return false;
  }
  return true;
}

std::string heavy_objection(const fs::path& root, const fs::path& file, const std::string& module,
                            const Include& include) {
  for (const HeavyLibrary& library : heavy_libraries()) {
    const bool meant = std::any_of(
        library.beginnings.begin(), library.beginnings.end(), [&](const std::string& beginning) {
          return include.path.compare(0, beginning.size(), beginning) == 0;
        });
    if (!meant || (include.quoted && include.path.find('/') != std::string::npos)) continue;
    if (!module.empty() && library.modules && !library.modules->contains(module))
      return module + " may not know " + library.name;
    if (module.empty() && library.modules) return std::string("only src/ knows ") + library.name;
    if (!is_private(root, file, module))
      return std::string("no installed header shows ") + library.name;
  }
  return "";
}

// Our own headers may begin like a library's ("gdal_reader.h"): what exists below src/ or beside
// the file is ours.
bool is_ours(const fs::path& root, const fs::path& file, const Include& include) {
  return include.quoted &&
         (fs::exists(root / "src" / include.path) || fs::exists(file.parent_path() / include.path));
}

void check_file(const fs::path& root, const fs::path& file, std::vector<std::string>& broken) {
  const std::string below_root = fs::relative(file, root).generic_string();
  const bool in_src = part(below_root, 0) == "src";
  const std::string below_src = in_src ? below_root.substr(4) : "";
  const std::string module = in_src ? part(below_src, 0) : "";
  if (in_src && !allowed_modules().contains(module)) {
    broken.push_back(below_root + ":1: no wall knows this folder");
    return;
  }
  for (const Include& include : includes_of(file)) {
    std::string why;
    const bool to_tools = include.path.compare(0, 6, "tools/") == 0 ||
                          include.path.compare(0, 6, "tests/") == 0 ||
                          include.path.find("../") != std::string::npos;
    if (in_src)
      why = to_tools ? "src/ knows nothing outside it" : objection(below_src, include.path);
    if (why.empty() && part(below_root, 1) == "compare" &&
        include.path.compare(0, 6, "plumb/") == 0)
      why = "compare may not know the command";
    if (why.empty() && !is_ours(root, file, include))
      why = heavy_objection(root, file, module, include);
    if (!why.empty()) {
      broken.push_back(below_root + ":" + std::to_string(include.line) + ": includes " +
                       include.path + ": " + why);
    }
  }
}

}  // namespace

std::vector<std::string> broken_walls(const fs::path& root) {
  std::vector<std::string> broken;
  for (const char* folder : {"src", "tools", "examples"}) {
    if (!fs::exists(root / folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      const std::string extension = entry.path().extension().string();
      if (entry.is_regular_file() && (extension == ".h" || extension == ".cpp"))
        check_file(root, entry.path(), broken);
    }
  }
  std::sort(broken.begin(), broken.end());
  return broken;
}

}  // namespace plumb::testing
