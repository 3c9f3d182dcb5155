// Files of stacks of material. Byte by byte in docs/formats/plumb-stacks.md.
#pragma once

#include <filesystem>
#include <string>

#include "core/byte_stream.h"
#include "terrain/stacks/stack_field.h"

namespace plumb::terrain {

/// Rows of a block, which is coded and checked by itself.
inline constexpr int kStackBlockRows = 64;

/// The whole file.
///
///   (1) Heights, materials, holes, names, colours and provenance come back as they are, to the
///       bit.
///   (2) The same bytes on any number of threads.
/// Throws std::invalid_argument for a field that is not valid, for block_rows < 1, or where a part
/// takes 4 GiB or more.
Bytes stack_file_bytes(const StackField& field, int block_rows = kStackBlockRows);

/// Writes it whole or not at all. Throws InputError with path and cause, and as stack_file_bytes.
void write_stacks(const std::filesystem::path& path, const StackField& field);

/// Reads it again; the field is valid.
///
/// Throws InputError, one line with the file and what is wrong: not such a file, of a version that
/// is not known, cut off, damaged, of sizes beyond what it can hold or what fits into memory, or of
/// stacks that are none.
StackField read_stacks(const std::filesystem::path& path);
/// The same of a file in memory; `name` is what its errors call it.
StackField stacks_of_bytes(const Bytes& file, const std::string& name = "<memory>");

/// True if what stands there is a file that begins as these do, whatever its name.
bool is_stack_file(const std::filesystem::path& path);

}  // namespace plumb::terrain
