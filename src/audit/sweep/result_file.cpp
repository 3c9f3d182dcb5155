#include "audit/sweep/result_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>
#include <utility>

#include "audit/sweep/plan.h"
#include "audit/toml_document.h"
#include "core/atomic_file.h"
#include "core/check.h"

namespace plumb::audit::sweep {
namespace {

using Json = nlohmann::ordered_json;

std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string run_of(const Json& asked) {
  const Json& camera = asked.at("camera");
  const int frame = camera.at("frame").get<int>();
  const auto word = [](const Json& json) { return json.get<std::string>(); };
  return fmt::format("{}, {}, {}, {}{}, {}{}", word(asked.at("terrain").at("name")),
                     word(asked.at("method")), word(asked.at("variant")),
                     asked.at("tolerance").at("value").get<double>(),
                     word(asked.at("tolerance").at("unit")), word(camera.at("name")),
                     frame > 0 ? fmt::format(" frame {}", frame) : "");
}

ResultLine line_of(std::string_view text) {
  const Json json = Json::parse(text);
  ResultLine line;
  line.text = text;
  if (json.at("schema") != "plumb.sweep/1")
    input_error("its schema is {}, expected \"plumb.sweep/1\"", json.at("schema").dump());
  line.key = json.at("key").get<std::string>();
  line.index = json.at("index").get<std::int64_t>();
  line.status = json.at("status").get<std::string>();
  if (line.status != "done" && line.status != "failed" && line.status != "skipped")
    input_error("its status is '{}', expected done, failed or skipped", line.status);
  if (line.status != "done") line.error = json.at("error").get<std::string>();
  if (line.key != key_of(text_of(json.at("asked"))))
    input_error("its key {} is not that of what it asked: somebody has changed it", line.key);
  line.run = run_of(json.at("asked"));
  if (line.status == "done") {
    line.verdict = json.at("verdict").get<std::string>();
    line.shared_times = json.at("timing").at("shared").get<bool>();
  }
  return line;
}

[[noreturn]] void system_error(const char* what, const std::filesystem::path& path) {
  input_error("cannot {} '{}': {}", what, path.string(), std::strerror(errno));
}

bool is_same_file(int file, const std::filesystem::path& path) {
  struct stat opened {};
  struct stat named {};
  return ::fstat(file, &opened) == 0 && ::stat(path.c_str(), &named) == 0 &&
         opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

}  // namespace

ResultLines parse_results(std::string_view text, const std::string& name) {
  ResultLines result;
  for (std::size_t number = 1; result.whole_bytes < text.size(); ++number) {
    const std::size_t end = text.find('\n', result.whole_bytes);
    if (end == std::string_view::npos) break;  // torn
    try {
      result.lines.push_back(line_of(text.substr(result.whole_bytes, end - result.whole_bytes)));
    } catch (const Json::exception&) {
      input_error("{}, line {}: this is no result of a sweep", name, number);
    } catch (const InputError& error) {
      input_error("{}, line {}: {}", name, number, error.what());
    }
    result.whole_bytes = end + 1;
  }
  return result;
}

ResultLines read_results(const std::filesystem::path& path) {
  return parse_results(read_text_file(path.string(), "results"), path.string());
}

ResultLine with_index(const ResultLine& line, std::int64_t index) {
  if (line.index == index) return line;
  Json json = Json::parse(line.text);
  json["index"] = index;
  ResultLine moved = line;
  moved.index = index;
  moved.text = text_of(json);
  return moved;
}

std::string result_text(const ResultLine& line) {
  Json json = Json::parse(line.text);
  json.erase("index");
  json.erase("timing");
  return text_of(json);
}

std::string joined_text(const std::vector<ResultLine>& lines) {
  std::string text;
  for (const ResultLine& line : lines) text += line.text + "\n";
  return text;
}

ResultFile::ResultFile(std::filesystem::path path) : path_(std::move(path)) {
  open();
  try {
    ResultLines read = read_results(path_);
    if (::ftruncate(file_, static_cast<off_t>(read.whole_bytes)) != 0)
      system_error("take the torn line from", path_);
    lines_ = std::move(read.lines);
  } catch (...) {
    close();
    throw;
  }
}

ResultFile::~ResultFile() { close(); }

void ResultFile::open() {
  std::error_code none;
  const auto kind = std::filesystem::status(path_, none).type();
  if (kind != std::filesystem::file_type::regular && kind != std::filesystem::file_type::not_found)
    input_error("cannot write '{}': results need a plain file, to be read again", path_.string());
  // Who renames a file over this one between opening and locking leaves us with a lock on nothing.
  for (;;) {
    file_ = ::open(path_.c_str(), O_RDWR | O_APPEND | O_CREAT | O_CLOEXEC, 0666);
    if (file_ < 0) system_error("write", path_);
    if (::flock(file_, LOCK_EX | LOCK_NB) != 0) {
      const int cause = errno;
      close();
      errno = cause;
      if (cause == EWOULDBLOCK) input_error("'{}': another sweep is writing it", path_.string());
      system_error("lock", path_);
    }
    if (is_same_file(file_, path_)) return;
    close();
  }
}

void ResultFile::close() {
  if (file_ >= 0) ::close(file_);
  file_ = -1;
}

void ResultFile::append(const std::string& text) {
  ResultLine line = line_of(text);
  const std::string bytes = text + "\n";
  const off_t before = ::lseek(file_, 0, SEEK_END);
  errno = ENOSPC;  // what a short count means
  if (::write(file_, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size())) {
    const int cause = errno;
    if (before >= 0 && ::ftruncate(file_, before) != 0) errno = cause;
    errno = cause;
    system_error("write", path_);
  }
  lines_.push_back(std::move(line));
}

void ResultFile::replace(std::vector<ResultLine> lines) {
  write_file_atomically(path_, joined_text(lines));
  close();
  open();
  lines_ = std::move(lines);
}

}  // namespace plumb::audit::sweep
