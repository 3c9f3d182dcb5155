// Stacks as a file: what is in it, and how bad ones are told.
#include "terrain/stacks/stack_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/check.h"
#include "core/hash.h"
#include "core/little_endian.h"
#include "support/run_command.h"
#include "terrain/stacks/stack_file_header.h"
#include "terrain/terrain_source.h"

namespace plumb::terrain {
namespace {

using testing::TemporaryFolder;

// Three stacks in a row: rock with a cave under soil, a hole, air.
StackField small_field() {
  StackField field;
  field.columns = 3;
  field.rows = 1;
  field.dx_m = 2.0;
  field.dy_m = 3.0;
  field.voxel_m = 0.5;
  field.origin_m = {600000.25, 4500000.125};
  field.low_m = -1.0F;
  field.voxels = 20;
  field.materials = {{"air", {0, 0, 0}}, {"rock", {0.4, 0.3, 0.2}}, {"soil", {0.1, 0.2, 0.3}}};
  field.provenance.source = "by hand";
  field.provenance.format = "stacks";
  field.provenance.crs = "EPSG:2056";
  field.provenance.is_local = true;
  field.provenance.file_columns = 30;
  field.provenance.file_rows = 10;
  field.provenance.window_x = 4;
  field.provenance.window_y = 5;
  field.provenance.height_scale = 0.1;
  field.provenance.height_offset_m = -3.0;
  field.provenance.voids_declared = 6;
  field.provenance.voids_not_finite = std::int64_t{1} << 40;
  field.provenance.largest_rounding_m = 1e-7;
  field.provenance.assumptions = {"heights are metres", "", "north is up"};
  StackWriter writer(field);
  const std::vector<Layer> cave{{-1.0F, 1.0F, 1}, {3.0F, 4.1F, 1}, {4.1F, 4.7F, 2}};
  writer.add(cave);
  writer.add_hole();
  writer.add({});
  return field;
}

// Of the same bits, the sign of zero and all: by value they might only be equal.
bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), 4 * a.size()) == 0;
}

void expect_same(const StackField& a, const StackField& b) {
  EXPECT_EQ(checksum(a), checksum(b));
  EXPECT_TRUE(same_bits(a.end_m, b.end_m));
  EXPECT_EQ(a.holes, b.holes);
  EXPECT_EQ(a.materials, b.materials);
}

std::string refusal(const Bytes& file) {
  try {
    stacks_of_bytes(file, "t.stacks");
  } catch (const InputError& error) {
    return error.what();
  }
  return "it was read";
}

Bytes with_header(const StackFileHeader& header, const Bytes& file) {
  StackFirstPart first;
  EXPECT_EQ(read_first_part(file, first), "");
  const Bytes head = header_bytes(header);
  Bytes bytes = first_part_of({static_cast<std::uint32_t>(head.size()),
                               Checksum().add_bytes(head.data(), head.size()).value()});
  bytes.insert(bytes.end(), head.begin(), head.end());
  bytes.insert(bytes.end(),
               file.begin() + static_cast<std::ptrdiff_t>(kStackFirstBytes + first.header_bytes),
               file.end());
  return bytes;
}

StackFileHeader header_of(const Bytes& file) {
  StackFirstPart first;
  EXPECT_EQ(read_first_part(file, first), "");
  StackFileHeader header;
  EXPECT_EQ(read_header(std::span(file).subspan(kStackFirstBytes, first.header_bytes), header), "");
  return header;
}

TEST(StackFile, GivesBackEveryPart) {
  const StackField field = small_field(), back = stacks_of_bytes(stack_file_bytes(field));
  expect_same(back, field);
  EXPECT_EQ(back.first_layer, (std::vector<std::uint32_t>{0, 4, 4, 4}));
  EXPECT_EQ(back.end_m, (std::vector<float>{1.0F, 3.0F, 4.1F, 4.7F}));
  EXPECT_EQ(back.material, (std::vector<Material>{1, 0, 1, 2}));
  EXPECT_EQ(back.holes, (std::vector<std::uint8_t>{0, 1, 0}));
  EXPECT_EQ(back.origin_m, field.origin_m);
  EXPECT_EQ(back.dy_m, 3.0);
  EXPECT_EQ(back.voxels, 20);
  const Provenance &p = back.provenance, &q = field.provenance;
  EXPECT_EQ(p.source, q.source);
  EXPECT_EQ(p.format, q.format);
  EXPECT_EQ(p.crs, q.crs);
  EXPECT_EQ(p.is_local, q.is_local);
  EXPECT_EQ(p.file_columns, q.file_columns);
  EXPECT_EQ(p.file_rows, q.file_rows);
  EXPECT_EQ(p.window_x, q.window_x);
  EXPECT_EQ(p.window_y, q.window_y);
  EXPECT_EQ(p.height_scale, q.height_scale);
  EXPECT_EQ(p.height_offset_m, q.height_offset_m);
  EXPECT_EQ(p.voids_declared, q.voids_declared);
  EXPECT_EQ(p.voids_not_finite, q.voids_not_finite);
  EXPECT_EQ(p.largest_rounding_m, q.largest_rounding_m);
  EXPECT_EQ(p.assumptions, q.assumptions);
}

// An end of -0 lies at zero; so does one of +0.
TEST(StackFile, KeepsTheSignOfZero) {
  for (const float zero : {0.0F, -0.0F}) {
    StackField field = small_field();
    StackWriter writer(field);
    const Layer layer{-1.0F, zero, 1};
    for (int k = 0; k < 3; ++k) writer.add({&layer, 1});
    EXPECT_TRUE(same_bits(stacks_of_bytes(stack_file_bytes(field)).end_m, field.end_m));
  }
}

// Whole metres of a terrain of 257 x 257: less than a byte a stack, where its DEM has two and a
// stack of one layer in memory nine.
TEST(StackFile, IsSmall) {
  Heightfield heights = load_terrain("generate:alpine?size=257&seed=3", {});
  for (float& height : heights.heights_m.floats().values()) height = std::round(height);
  const StackField field = stacks_of(heights);
  const Bytes file = stack_file_bytes(field);
  expect_same(stacks_of_bytes(file), field);
  EXPECT_LT(file.size(), 257u * 257u);
  // A plain: every stack as the one before, a bit or two each at the least that the coder takes.
  for (float& height : heights.heights_m.floats().values()) height = 100.0F;
  EXPECT_LT(stack_file_bytes(stacks_of(heights)).size(), 257u * 257u / 20u);
}

TEST(StackFile, IsWrittenWholeAndKnownByItsFirstBytes) {
  const TemporaryFolder folder;
  const std::string path = folder.file("t.anything");
  write_stacks(path, small_field());
  EXPECT_TRUE(is_stack_file(path));
  expect_same(read_stacks(path), small_field());
  EXPECT_EQ(folder.names(), std::vector<std::string>{"t.anything"});
  std::ofstream(folder.file("other"), std::ios::binary) << "STACK\n\n\x1a and more of it";
  EXPECT_FALSE(is_stack_file(folder.file("other")));
  EXPECT_FALSE(is_stack_file(folder.file("missing")));
  EXPECT_FALSE(is_stack_file(folder.path()));
  for (const char* name : {"other", "missing", "."}) {
    try {
      read_stacks(folder.file(name));
      ADD_FAILURE() << name;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(folder.file(name)), std::string::npos);
    }
  }
  EXPECT_THROW(write_stacks(folder.file("no/t.stacks"), small_field()), InputError);
}

TEST(StackFile, TellsWhatIsWrongWithAFile) {
  const Bytes file = stack_file_bytes(small_field());
  EXPECT_EQ(refusal({}), "cannot read 't.stacks': it is no file of stacks");
  Bytes newer = file;
  newer[8] = 2;
  EXPECT_EQ(refusal(newer), "cannot read 't.stacks': it is of format version 2, known is 1");
  EXPECT_EQ(refusal(Bytes(file.begin(), file.begin() + 40)),
            "cannot read 't.stacks': it ends within its header");
  Bytes harmed = file;
  harmed[30] ^= 1;
  EXPECT_EQ(refusal(harmed), "cannot read 't.stacks': its header is damaged: the checksum differs");
  harmed = file;
  harmed.back() ^= 1;
  EXPECT_EQ(refusal(harmed),
            "cannot read 't.stacks': rows 0 to 0 are damaged: the checksum differs");
  harmed = file;
  harmed.push_back(0);
  EXPECT_NE(refusal(harmed).find("its table says"), std::string::npos);
}

// What a checksum does not see: headers and stacks that agree with themselves, and are none.
TEST(StackFile, RefusesSizesAndStacksThatAreNone) {
  const Bytes file = stack_file_bytes(small_field());
  const StackFileHeader whole = header_of(file);
  const auto refused = [&](const auto& change, const std::string& words) {
    StackFileHeader header = whole;
    change(header);
    const std::string line = refusal(with_header(header, file));
    EXPECT_NE(line.find(words), std::string::npos) << line;
  };
  EXPECT_EQ(with_header(whole, file), file);
  refused([](StackFileHeader& h) { h.field.columns = 0; }, "are none");
  refused([](StackFileHeader& h) { h.field.rows = -1; }, "are none");
  refused([](StackFileHeader& h) { h.field.voxels = 0; }, "are none");
  refused([](StackFileHeader& h) { h.block_rows = 0; }, "are none");
  refused([](StackFileHeader& h) { h.field.rows = 65; }, "its table has 8 bytes");
  refused([](StackFileHeader& h) { h.field.dx_m = NAN; }, "none that it can be");
  refused([](StackFileHeader& h) { h.field.voxel_m = -1.0; }, "none that it can be");
  refused([](StackFileHeader& h) { h.field.low_m = INFINITY; }, "none that it can be");
  refused([](StackFileHeader& h) { h.field.materials.clear(); }, "materials");
  refused([](StackFileHeader& h) { h.field.materials.resize(257); }, "materials");
  refused([](StackFileHeader& h) { h.field.materials[1].colour.y = NAN; }, "colour");
  // Two thousand million columns in some twenty bytes.
  refused([](StackFileHeader& h) { h.field.columns = 2000000000; }, "hold no 2000000000 stacks");
  refused([](StackFileHeader& h) { h.field.columns = 4; }, "not coded as stacks are");
  // 20 voxels of 0.5 m up from -1 m are 9 m; of 0.25 m they are 4 m, and a stack reaches 4.7 m.
  refused([](StackFileHeader& h) { h.field.voxel_m = 0.25; }, "within the field");
  refused([](StackFileHeader& h) { h.field.materials.pop_back(); }, "of another material");
  refused([](StackFileHeader& h) { h.blocks[0].checksum ^= 1; }, "checksum");
  refused([](StackFileHeader& h) { h.blocks[0].size += 1; }, "its table says");
}

// A byte too many, or one too few, with a checksum that says so.
TEST(StackFile, RefusesABlockThatIsNotReadToItsLastByte) {
  const Bytes file = stack_file_bytes(small_field());
  for (const bool longer : {true, false}) {
    Bytes harmed = file;
    longer ? harmed.push_back(0) : harmed.pop_back();
    StackFileHeader header = header_of(file);
    StackBlockEntry& block = header.blocks[0];
    const std::size_t at = file.size() - block.size;
    block.size = static_cast<std::uint32_t>(harmed.size() - at);
    block.checksum =
        static_cast<std::uint32_t>(Checksum().add_bytes(&harmed[at], block.size).value());
    EXPECT_EQ(refusal(with_header(header, harmed)),
              "cannot read 't.stacks': rows 0 to 0 are not coded as stacks are");
  }
}

// Files that were written are read for ever: this is format version 1.
TEST(StackFile, KeepsItsFormat) {
  StackField field = small_field();
  EXPECT_EQ(Checksum().add(std::span<const std::uint8_t>(stack_file_bytes(field))).text(),
            "bc4b5703bd18e5d5");
  field = stacks_of(load_terrain("generate:canyon?size=65&seed=5&voids=0.2", {}));
  field.provenance = {};
  EXPECT_EQ(Checksum().add(std::span<const std::uint8_t>(stack_file_bytes(field))).text(),
            "75e1ac1926c2c9ee");
}

TEST(StackFile, RefusesToWriteWhatIsNoField) {
  StackField field = small_field();
  EXPECT_THROW(stack_file_bytes(field, 0), std::invalid_argument);
  field.materials[2].colour.z = NAN;
  EXPECT_THROW(stack_file_bytes(field), std::invalid_argument);
  field = small_field();
  field.end_m[2] = 2.0F;
  EXPECT_THROW(stack_file_bytes(field), std::invalid_argument);
}

}  // namespace
}  // namespace plumb::terrain
