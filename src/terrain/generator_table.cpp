// The table of generators: adding one is a row here and a formula in a file of its own.
#include "core/check.h"
#include "terrain/alpine.h"
#include "terrain/canyon.h"
#include "terrain/closed_forms.h"
#include "terrain/dunes.h"
#include "terrain/generator_parameters.h"
#include "terrain/urban.h"

namespace plumb::terrain {
namespace {

struct Generator {
  const char* name;
  const char* meaning;
  const char* size;
  const char* spacing;
  std::vector<GeneratorParameter> own;
  RowFiller (*filler)(const GeneratorValues&, const GridShape&);  // null: it makes stacks
};

GeneratorParameter height(const char* value) {
  return {"height", value, "of the lowest ground, metres"};
}
GeneratorParameter relief(const char* value) {
  return {"relief", value, "from the lowest to the highest ground, metres"};
}

const std::vector<Generator>& generators() {
  static const std::vector<Generator> table = {
      {"alpine",
       "a mountain range (ridged multifractal)",
       "2049",
       "30",
       {height("300"),
        relief("2500"),
        {"feature", "9000", "distance between main ridges, metres, > 0"},
        {"roughness", "0.42", "height of each octave against the one before, 0 to 0.9"},
        {"bend", "0.35", "how far ridges are bent, in features, 0 to 10"},
        {"octaves", "0", "0: down to two spacings; else 1 to 16"}},
       alpine},
      {"dunes",
       "wind-blown sand, with slip faces at its angle of repose",
       "2049",
       "2",
       {height("100"),
        {"relief", "15", "of the tallest crests, metres, 0 to a seventh of the wavelength"},
        {"wavelength", "110", "distance between crests, metres, >= 1"},
        {"wind_deg", "280", "where the wind comes from, clockwise from north, 0 to 360"},
        {"bend", "0.9", "how far crests are bent, 0 (straight) to 1"}},
       dunes},
      {"canyon",
       "a plateau cut by a meandering gorge with terraced walls",
       "2049",
       "10",
       {{"height", "700", "of the gorge's floor, metres"},
        {"relief", "900", "from the floor to the plateau, metres, >= 0"},
        {"width", "3500", "from rim to rim, metres, >= 1"},
        {"bend", "0.8", "how far the river swings, in widths, 0 to 4"},
        {"strata", "8", "layers of rock, 1 to 100"}},
       canyon},
      {"urban",
       "blocks of buildings with vertical walls, between streets",
       "1025",
       "1",
       {height("100"),
        {"relief", "120", "from the lowest ground to the highest roof, metres, >= 0"},
        {"ground", "15", "from the lowest to the highest ground, metres, 0 to the relief"},
        {"block", "75", "depth of a block and a street, metres, >= 1; it is 1.4 times as long"},
        {"street", "14", "width of a street, metres, 0 to 0.7 of a block"},
        {"turn_deg", "0", "angle of the streets against the grid, -90 to 90"}},
       urban},
      {"plane", "level ground", "257", "10", {height("100")}, plane},
      {"tilted-plane",
       "an even slope",
       "257",
       "10",
       {height("0"),
        {"slope_x", "0.2", "rise per metre eastwards"},
        {"slope_y", "0.1", "rise per metre northwards"},
        {"relief", "0",
         "0: as the slopes say; else they are scaled to this height difference, "
         "metres"}},
       tilted_plane},
      {"paraboloid",
       "a dome (a bowl for a negative relief)",
       "257",
       "10",
       {height("0"), relief("500")},
       paraboloid},
      {"step",
       "a cliff between two levels",
       "257",
       "10",
       {height("0"),
        relief("100"),
        {"position", "0.5", "of the cliff's foot, as a part of the width, 0 to 1"},
        {"axis", "x", "the ground rises eastwards (x) or northwards (y)"}},
       step},
      {"spike",
       "one sample out of level ground",
       "257",
       "10",
       {height("0"),
        relief("100"),
        {"column", "centre", "of the spike, from the west, or centre"},
        {"row", "centre", "of the spike, from the south, or centre"}},
       spike},
      {"sinusoid",
       "hills and hollows",
       "257",
       "10",
       {height("0"), relief("200"), {"wavelength", "1000", "L or LX,LY in metres, > 0"}},
       sinusoid},
      {"checkerboard",
       "level tiles of two heights, a cliff between any two",
       "257",
       "10",
       {height("0"), relief("50"), {"tile", "8", "samples along a tile's side, >= 1"}},
       checkerboard},
      {"caves",
       "mesas with arches, overhangs and caves: a terrain of stacks of material",
       "513",
       "1",
       {{"height", "0", "of the bottom, metres"},
        {"relief", "128", "from the bottom to above all ground, metres, > 0"},
        {"feature", "400", "distance between mesas, metres, > 0"},
        {"caves", "1", "width of caves: 0 for none, 1 for natural ones, to 3"},
        {"soil", "2", "thickness of soil on level ground, metres, >= 0"},
        {"surface", "stacks",
         "top: the heights of its top surface alone, as of any other terrain"}},
       nullptr},
  };
  return table;
}

GeneratorHelp help_for(const Generator& generator) {
  GeneratorHelp help{generator.name, generator.meaning, {}, generator.filler == nullptr};
  help.parameters = {{"size", generator.size, "N or WIDTHxHEIGHT in samples, >= 1"},
                     {"spacing", generator.spacing, "D or DX,DY in metres, > 0"},
                     {"seed", "1", "whole number >= 0; of what is random, voids too"},
                     {"voids", "0", "part of the samples that blobs of void cover, 0 to 1"},
                     {"utm", "0", "1: origin at 500000,4500000, as UTM coordinates are"},
                     {"origin", "0,0", "X,Y of the south-west sample, metres"}};
  help.parameters.insert(help.parameters.end(), generator.own.begin(), generator.own.end());
  return help;
}

}  // namespace

const std::vector<GeneratorHelp>& generator_help() {
  static const std::vector<GeneratorHelp> help = [] {
    std::vector<GeneratorHelp> all;
    for (const Generator& generator : generators()) all.push_back(help_for(generator));
    return all;
  }();
  return help;
}

RowFiller row_filler(const GeneratorValues& values, const GridShape& shape) {
  for (const Generator& generator : generators()) {
    if (generator.name == values.name() && generator.filler) return generator.filler(values, shape);
  }
  input_error("generate:{}: there is no such generator of heights", values.name());
}

}  // namespace plumb::terrain
