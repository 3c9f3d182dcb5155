// Terrains: every generator, odd sizes, voids, cells that are not square, origins far away.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "audit/soundness/draw_parts.h"
#include "terrain/generators.h"

namespace plumb::audit::soundness {
namespace {

// A generator's argument as it grows.
class Argument {
 public:
  explicit Argument(const std::string& generator) : text_("generate:" + generator) {}

  void add(const char* name, const std::string& value) {
    text_ += fmt::format("{}{}={}", is_first_ ? '?' : '&', name, value);
    is_first_ = false;
  }
  void add(const char* name, double value) { add(name, fmt::format("{}", rounded(value, 4))); }
  void add_pair(const char* name, double a, double b) {
    add(name, a == b ? fmt::format("{}", a) : fmt::format("{},{}", a, b));
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
  bool is_first_ = true;
};

// Length of one side, samples: single ones, powers of two and their neighbours, and all between.
int draw_side(RandomNumbers& random, int most) {
  switch (random.weighted({0.08, 0.32, 0.6})) {
    case 0:
      return random.integer(1, 3);
    case 1: {
      const int power = 1 << random.integer(1, 7);
      return std::clamp(power + random.integer(-1, 2), 1, most);
    }
    default:
      return std::clamp(static_cast<int>(random.log_uniform(3.0, most + 1.0)), 1, most);
  }
}

struct Ground {
  int columns = 1, rows = 1;
  double dx_m = 1.0, dy_m = 1.0;
  double length_m = 1.0;  // of the longer side
  double relief_m = 1.0;
};

double draw_relief(RandomNumbers& random, double length_m) {
  switch (random.weighted({0.76, 0.1, 0.1, 0.04})) {
    case 0:
      return length_m * random.log_uniform(3e-3, 2.0);
    case 1:
      return length_m * random.log_uniform(1e-7, 1e-3);
    case 2:
      return std::min(length_m * random.log_uniform(10.0, 1e3), 9e5);
    default:
      return 0.0;
  }
}

Ground draw_ground(RandomNumbers& random, bool of_stacks) {
  Ground ground;
  const int most = of_stacks ? 72 : 130;
  ground.columns = draw_side(random, most);
  ground.rows = random.chance(0.4) ? ground.columns : draw_side(random, most);
  if (of_stacks && random.chance(0.3)) {  // so large that coarse levels are drawn
    ground.columns = random.integer(48, most);
    ground.rows = random.integer(48, most);
  }
  const bool is_usual = random.chance(0.8);
  ground.dx_m =
      rounded(is_usual ? random.log_uniform(0.5, 100.0) : random.log_uniform(1e-3, 1e4), 3);
  ground.dy_m =
      random.chance(0.6) ? ground.dx_m : rounded(ground.dx_m * random.log_uniform(0.1, 10.0), 3);
  ground.length_m = std::max(ground.columns * ground.dx_m, ground.rows * ground.dy_m);
  ground.relief_m = draw_relief(random, ground.length_m);
  return ground;
}

void add_height(RandomNumbers& random, Argument& argument) {
  switch (random.weighted({0.35, 0.5, 0.1, 0.05})) {
    case 0:
      return;
    case 1:
      return argument.add("height", random.uniform(-500.0, 8000.0));
    case 2:
      return argument.add("height", random.uniform(-1.0, 1.0));
    default:
      return argument.add("height", random.sign() * random.log_uniform(1e4, 1e6));
  }
}

using Adder = void (*)(RandomNumbers&, const Ground&, Argument&);

void add_alpine(RandomNumbers& random, const Ground& g, Argument& to) {
  to.add("relief", g.relief_m);
  to.add("feature", std::max(1e-3, g.length_m * random.log_uniform(0.05, 3.0)));
  if (random.chance(0.5)) to.add("roughness", random.uniform(0.0, 0.9));
  if (random.chance(0.3)) to.add("bend", random.uniform(0.0, 10.0));
  if (random.chance(0.3)) to.add("octaves", std::to_string(random.integer(1, 16)));
}

void add_dunes(RandomNumbers& random, const Ground& g, Argument& to) {
  const double wavelength =
      rounded(std::clamp(g.length_m * random.log_uniform(0.02, 2.0), 1.0, 1e6), 4);
  to.add("wavelength", wavelength);
  to.add("relief", std::min(g.relief_m, 0.14 * wavelength));
  if (random.chance(0.5)) to.add("wind_deg", random.uniform(0.0, 360.0));
  if (random.chance(0.5)) to.add("bend", random.uniform(0.0, 1.0));
}

void add_canyon(RandomNumbers& random, const Ground& g, Argument& to) {
  to.add("relief", g.relief_m);
  to.add("width", std::max(1.0, g.length_m * random.log_uniform(0.05, 1.0)));
  if (random.chance(0.5)) to.add("bend", random.uniform(0.0, 4.0));
  if (random.chance(0.5)) to.add("strata", std::to_string(random.integer(1, 100)));
}

void add_urban(RandomNumbers& random, const Ground& g, Argument& to) {
  to.add("relief", g.relief_m);
  to.add("ground", 0.99 * g.relief_m * random.uniform(0.0, 1.0));
  const double block = rounded(std::clamp(g.length_m * random.log_uniform(0.03, 0.5), 1.0, 1e6), 4);
  to.add("block", block);
  to.add("street", 0.69 * block * random.uniform(0.0, 1.0));
  if (random.chance(0.5)) to.add("turn_deg", random.uniform(-90.0, 90.0));
}

void add_plane(RandomNumbers&, const Ground&, Argument&) {}

void add_tilted_plane(RandomNumbers& random, const Ground& g, Argument& to) {
  to.add("slope_x", random.uniform(-2.0, 2.0));
  to.add("slope_y", random.uniform(-2.0, 2.0));
  if (random.chance(0.6)) to.add("relief", g.relief_m);
}

void add_paraboloid(RandomNumbers& random, const Ground& g, Argument& to) {
  to.add("relief", random.sign() * g.relief_m);
}

void add_step(RandomNumbers& random, const Ground& g, Argument& to) {
  to.add("relief", random.sign() * g.relief_m);
  to.add("position", random.uniform(0.0, 1.0));
  if (random.chance(0.5)) to.add("axis", "y");
}

void add_spike(RandomNumbers& random, const Ground& g, Argument& to) {
  to.add("relief", random.sign() * g.relief_m);
  if (random.chance(0.7)) {
    to.add("column", std::to_string(random.integer(0, g.columns - 1)));
    to.add("row", std::to_string(random.integer(0, g.rows - 1)));
  }
}

void add_sinusoid(RandomNumbers& random, const Ground& g, Argument& to) {
  to.add("relief", g.relief_m);
  const auto wave = [&] {
    return rounded(std::max(1e-3, g.length_m * random.log_uniform(0.02, 3.0)), 4);
  };
  const double x = wave();
  to.add_pair("wavelength", x, random.chance(0.5) ? x : wave());
}

void add_checkerboard(RandomNumbers& random, const Ground& g, Argument& to) {
  to.add("relief", random.sign() * g.relief_m);
  to.add("tile", std::to_string(random.integer(1, 16)));
}

// Voxels are as high as the mean spacing; some 48 of them keep a case short.
void add_caves(RandomNumbers& random, const Ground& g, Argument& to) {
  const double voxel_m = 0.5 * (g.dx_m + g.dy_m);
  to.add("relief", std::max(1e-3, voxel_m * random.log_uniform(1.0, 48.0)));
  to.add("feature", std::max(1e-3, g.length_m * random.log_uniform(0.1, 3.0)));
  if (random.chance(0.7)) to.add("caves", random.uniform(0.0, 3.0));
  if (random.chance(0.5)) to.add("soil", voxel_m * random.uniform(0.0, 4.0));
}

const std::vector<std::pair<std::string, Adder>>& adders() {
  static const std::vector<std::pair<std::string, Adder>> table{{"alpine", add_alpine},
                                                                {"dunes", add_dunes},
                                                                {"canyon", add_canyon},
                                                                {"urban", add_urban},
                                                                {"plane", add_plane},
                                                                {"tilted-plane", add_tilted_plane},
                                                                {"paraboloid", add_paraboloid},
                                                                {"step", add_step},
                                                                {"spike", add_spike},
                                                                {"sinusoid", add_sinusoid},
                                                                {"checkerboard", add_checkerboard},
                                                                {"caves", add_caves}};
  return table;
}

void add_common(RandomNumbers& random, const Ground& ground, Argument& argument) {
  argument.add("size", fmt::format("{}x{}", ground.columns, ground.rows));
  argument.add_pair("spacing", ground.dx_m, ground.dy_m);
  argument.add("seed", std::to_string(random.integer(0, 9999)));
  if (random.chance(0.4))
    argument.add("voids", random.chance(0.03) ? 1.0 : random.log_uniform(0.002, 0.9));
  switch (random.weighted({0.5, 0.25, 0.25})) {
    case 0:
      return;
    case 1:
      return argument.add("utm", "1");
    default: {
      const double far = random.log_uniform(1.0, 1e7);
      return argument.add_pair("origin", rounded(random.uniform(-far, far), 9),
                               rounded(random.uniform(-far, far), 9));
    }
  }
}

void draw_reading(RandomNumbers& random, const Ground& ground, Scene& scene, Traits& traits) {
  if (random.chance(0.2)) {
    terrain::Window window;
    window.x = random.integer(0, ground.columns - 1);
    window.y = random.integer(0, ground.rows - 1);
    window.width = random.integer(1, ground.columns - window.x);
    window.height = random.integer(1, ground.rows - window.y);
    scene.read.window = window;
    traits.windowed = true;
  }
}

}  // namespace

void draw_terrain(RandomNumbers& random, bool of_stacks, Scene& scene, Traits& traits) {
  const Ground ground = draw_ground(random, of_stacks);
  const auto& table = adders();
  const std::size_t drawn =
      of_stacks ? table.size() - 1
                : static_cast<std::size_t>(random.integer(0, static_cast<int>(table.size()) - 1));
  const auto& [generator, add] = table[drawn];
  const bool of_caves = generator == "caves";
  traits.generator = of_caves && !of_stacks ? "caves (top)" : generator;
  Argument argument(generator);
  add_common(random, ground, argument);
  add_height(random, argument);
  add(random, ground, argument);
  if (of_caves && !of_stacks) argument.add("surface", "top");
  scene.terrain = argument.text();
  if (!of_stacks) draw_reading(random, ground, scene, traits);
}

}  // namespace plumb::audit::soundness
