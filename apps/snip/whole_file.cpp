// Reading and writing files as a whole; see the header.
#include "snip/whole_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <new>
#include <system_error>

namespace snip {
namespace {

namespace fs = std::filesystem;

std::string reason(int code) { return std::generic_category().message(code); }

// POSIX calls rather than streams: only they tell that a disk is full when the file is closed.
int write_all(const fs::path& path, std::string_view bytes) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (file < 0) return errno;
  int failure = 0;
  while (!bytes.empty() && failure == 0) {
    const ::ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written >= 0)
      bytes.remove_prefix(static_cast<std::size_t>(written));
    else if (errno != EINTR)
      failure = errno;
  }
  if (failure == 0 && ::fsync(file) != 0) failure = errno;
  if (::close(file) != 0 && failure == 0) failure = errno;
  return failure;
}

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
  const auto failed = [&](const std::string& why) {
    return Error{fmt::format("{}: cannot be written: {}", path.string(), why)};
  };
  std::error_code error;
  fs::path target = path;
  if (fs::is_symlink(path, error)) {
    target = fs::weakly_canonical(path, error);
    if (error) return failed(error.message());
  }
  // A target that is not there yet counts as an error; any real one shows when the file is opened.
  if (fs::is_directory(target, error)) return failed("it is a directory");

  fs::path temporary = target;
  temporary += fmt::format(".{}.part", ::getpid());
  if (const int failure = write_all(temporary, bytes)) {
    if (failure != EEXIST) fs::remove(temporary, error);
    return failed(reason(failure));
  }
  fs::rename(temporary, target, error);
  if (!error) return {};
  const std::string why = error.message();
  fs::remove(temporary, error);
  return failed(why);
}

}  // namespace snip
