// Reading and writing files as a whole; see the header.
#include "snip/whole_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <exception>
#include <fstream>
#include <system_error>

#include "snip/output_file.hpp"

namespace snip {
namespace {

namespace fs = std::filesystem;

std::string reason(int code) { return std::generic_category().message(code); }

}  // namespace

Result<std::string> read_whole_file(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) return Error{fmt::format("{}: no such file", path.string())};
  if (error) return Error{fmt::format("{}: cannot be read: {}", path.string(), error.message())};
  if (status.type() != fs::file_type::regular)
    return Error{fmt::format("{}: cannot be read: not a regular file", path.string())};
  const std::uintmax_t size = fs::file_size(path, error);
  std::ifstream file(path, std::ios::binary);
  if (error || !file) return Error{fmt::format("{}: cannot be read: {}", path.string(), reason(errno))};
  std::string bytes;
  try {
    bytes.resize(size);
  } catch (const std::exception&) {
    return Error{fmt::format("{}: cannot be read: not enough memory for {} bytes", path.string(), size)};
  }
  file.read(bytes.data(), static_cast<std::streamsize>(size));
  if (static_cast<std::uintmax_t>(file.gcount()) != size)
    return Error{
        fmt::format("{}: cannot be read: only {} of {} bytes came", path.string(), file.gcount(), size)};
  return bytes;
}

Result<> write_whole_file(const fs::path& path, std::string_view bytes) {
  Result<OutputFile> file = completed_file(path, bytes);
  if (!file) return file.error();
  return file->publish();
}

}  // namespace snip
