// What reading and writing of image files share. Not for users of the library.
#pragma once

#include <filesystem>
#include <string>

namespace plumb::image {

/// Names of our own metadata in files begin so.
inline constexpr const char* kMetadataPrefix = "plumb:";

/// Throws InputError: "cannot read 'FILE': cause", the cause in one line.
[[noreturn]] void cannot(const char* verb, const std::filesystem::path& path,
                         const std::string& cause);

}  // namespace plumb::image
