// Files as tests of golden pictures read, write and change them.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace plumb::testing {

inline std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

inline void replace_in(const std::filesystem::path& path, const std::string& what,
                       const std::string& with) {
  std::string text = text_of(path);
  ASSERT_NE(text.find(what), std::string::npos);
  write(path, text.replace(text.find(what), what.size(), with));
}

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace plumb::testing
