// A terrain as files of ours write it down: where it is, and how it is to be read.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "audit/toml_document.h"
#include "core/check.h"
#include "terrain/read_options.h"

namespace plumb::audit {

struct TerrainTable {
  std::string source;         // a file or a generator, as it was written; empty: not yet
  terrain::ReadOptions read;  // how it is read
  std::string diagonal;       // of the full-detail surface; empty: the one that the method has
};

/// The keys that such a table may have: source, diagonal, and the command line's options with
/// underscores.
std::vector<std::string> terrain_keys();

/// Reads one entry of the table; false if its key is none of terrain_keys(). Throws InputError, one
/// line with the value's place, for a value that it cannot have.
bool read_terrain_entry(TerrainTable& table, const TomlEntry& entry);

/// Reading options that are not the usual ones: the table's key, and the value as the command line
/// has it.
std::vector<std::pair<std::string, std::string>> argument_texts(const terrain::ReadOptions& read);

/// A file's name is meant beside the file that names it, in `folder` (where the command runs, if
/// that is empty); generators, and what only GDAL can make sense of, stay.
std::string beside(const std::string& source, const std::string& folder);

/// What parse(text) makes of the value's text; its errors begin with the value's place.
template <class Parse>
auto parsed_argument(const TomlValue& value, const Parse& parse) {
  try {
    return parse(argument_in(value));
  } catch (const InputError& error) {
    const std::string what = error.what();
    if (what.starts_with(value.where)) throw;
    input_error("{}: {}", value.where, what);
  }
}

}  // namespace plumb::audit
