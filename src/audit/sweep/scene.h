// What a sweep runs, written down: terrains, methods, tolerances, cameras.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "audit/camera_file.h"
#include "audit/method.h"
#include "core/claim.h"
#include "terrain/read_options.h"

namespace plumb::audit::sweep {

struct SweepTerrain {
  std::string name;           // unique
  std::string kind;           // for charts: "smooth", "alpine", "urban", "caves", or a word of the
                              // scene's own
  std::string source;         // as the scene writes it
  std::string path;           // where it is looked for
  terrain::ReadOptions read;  // how it is read
  std::string diagonal;       // of the truth; empty: the one that the method has
  std::string where;          // "sweep.toml, line 3: terrains"
};

struct SweepCamera {
  std::string name;                       // unique
  std::string argument;                   // what --camera takes for it
  std::vector<CameraDescription> frames;  // one, or those of a path
  bool is_path = false;                   // frames belong together in time
  std::string where;
};

/// What a method runs in place of the scene's lists; an empty list is the scene's.
struct Only {
  std::vector<std::string> terrains;  // names
  std::vector<std::string> variants;
  std::vector<Tolerance> tolerances;
};

struct SweepMethod {
  std::string name;
  std::vector<std::string> variants;
  std::vector<Tolerance> tolerances;
  std::vector<std::string> terrains;                           // names
  std::vector<std::map<std::string, std::string>> parameters;  // one set or more
};

struct SweepScene {
  std::vector<SweepTerrain> terrains;
  std::vector<SweepMethod> methods;
  std::vector<Tolerance> sizes;  // of variants whose tolerance is a size; empty: their tolerances
  std::vector<SweepCamera> cameras;
};

/// Reads a sweep from TOML. All but the first two may be left out:
///
///   terrains       sources (files, looked for beside the scene, or generators) and tables with
///                  source, name, kind and the keys of a scene's [terrain]
///   methods        names
///   variants       of the methods (["conservative"])
///   tolerances_px  numbers ([1], unless there are tolerances_m)
///   tolerances_m   numbers, after those in pixels
///   sizes_px       numbers: what variants whose tolerance is a size (Method::size_variants) run in
///                  place of tolerances
///   cameras        presets, files (a camera or a path, beside the scene) and tables with a name
///                  and the keys of a camera file (["oblique"])
///   width, height  of the pictures of cameras that state none (1920 x 1080)
///   [parameters.METHOD]    parameters of a method, as it names them; [[parameters.METHOD]] several
///                          times: the method runs with each set
///   [only.METHOD]  variants, tolerances_px, tolerances_m, terrains: what this method runs in place
///                  of the lists above
///
/// A terrain is named after its file or generator where nothing else is said. Its kind is that of
/// the generator: smooth (plane, tilted-plane, paraboloid, sinusoid, dunes), alpine (alpine,
/// canyon), urban (urban, step, spike, checkerboard), caves; a file's is its name.
///
/// Throws InputError, one line with the file and the line in it, for anything else: an unknown key
/// is an error that names the known ones, and so is a method or a parameter that `table` does not
/// have. Variants and units that a method lacks are none: such runs are skipped.
SweepScene read_sweep_file(const std::string& path, const MethodTable& table);

/// The same from the text of such a file; `name` stands for it in messages, and files are looked
/// for in `folder` (where the command runs, if that is empty).
SweepScene parse_sweep(const std::string& text, const std::string& name, const MethodTable& table,
                       const std::string& folder = "");

}  // namespace plumb::audit::sweep
