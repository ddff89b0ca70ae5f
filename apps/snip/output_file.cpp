// Files that appear whole or not at all; see the header. By POSIX calls rather than streams: only they tell
// that a disk is full when the file is closed.
#include "snip/output_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <string>
#include <system_error>
#include <utility>

namespace snip {
namespace {

namespace fs = std::filesystem;

Error not_written(const fs::path& path, std::string_view why) {
  return {fmt::format("{}: cannot be written: {}", path.string(), why)};
}

Error not_written(const fs::path& path, int code) {
  return not_written(path, std::generic_category().message(code));
}

fs::path folder_of(const fs::path& file) {
  return file.parent_path().empty() ? fs::path(".") : file.parent_path();
}

// The end of a chain of links, at which there need not be anything.
Result<fs::path> followed(const fs::path& path) {
  fs::path target = path;
  std::error_code error;
  constexpr int most_links = 40;  // as the system has it
  for (int i = 0; i < most_links; ++i) {
    if (!fs::is_symlink(target, error)) return target;
    const fs::path next = fs::read_symlink(target, error);
    if (error) return not_written(path, error.message());
    target = folder_of(target) / next;  // an absolute path replaces the folder
  }
  return not_written(path, ELOOP);
}

std::string path_of(int file) { return fmt::format("/proc/self/fd/{}", file); }

// A file in this folder that no name leads to: should the process be killed, nothing is left of it. -1 where
// the file system or the way to name it later, /proc, is missing.
int without_name(const fs::path& folder) {
  const int file = ::open(folder.c_str(), O_WRONLY | O_TMPFILE | O_CLOEXEC, 0666);
  if (file >= 0 && ::access(path_of(file).c_str(), F_OK) == 0) return file;
  if (file >= 0) ::close(file);
  return -1;
}

// Gives a file a name beside `target` that nothing has yet. @return 0, or the reason of the failure
template <class Make>
int under_free_name(const fs::path& target, fs::path& chosen, const Make& make) {
  const std::string name = target.filename().string();
  // The number of a process comes again, and with it a name that a process before left when it was killed.
  for (int attempt = 0; attempt < 1000; ++attempt) {
    constexpr std::size_t most_kept = 200;  // of 255 bytes that a name may have
    const fs::path path =
        folder_of(target) / fmt::format("{}.{}-{}.part", name.substr(0, most_kept), ::getpid(), attempt);
    if (make(path.c_str())) {
      chosen = path;
      return 0;
    }
    if (errno != EEXIST) return errno;
  }
  return EEXIST;
}

int write_all(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ::ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written >= 0)
      bytes.remove_prefix(static_cast<std::size_t>(written));
    else if (errno != EINTR)
      return errno;
  }
  return 0;
}

}  // namespace

Result<fs::path> output_target(const fs::path& path) {
  // First what the system sees: a link into /proc may name a pipe by a path that leads nowhere.
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (fs::is_directory(status)) return not_written(path, "it is a directory");
  const bool exists = fs::exists(status);
  if (exists && !fs::is_regular_file(status)) return not_written(path, "it is not a regular file");
  Result<fs::path> target = followed(path);
  if (!target) return target;
  if (!target->has_filename()) return not_written(path, "the name of a file is missing");
  if (exists && ::access(target->c_str(), W_OK) != 0) return not_written(path, errno);
  // With the dot, a file in the place of the folder is an error.
  if (::access((folder_of(*target) / ".").c_str(), W_OK | X_OK) != 0) return not_written(path, errno);
  return target;
}

bool same_target(const fs::path& a, const fs::path& b) {
  const Result<fs::path> target_a = followed(a);
  const Result<fs::path> target_b = followed(b);
  std::error_code error;
  return target_a && target_b && target_a->filename() == target_b->filename() &&
         fs::equivalent(folder_of(*target_a), folder_of(*target_b), error);
}

struct OutputFile::State {
  fs::path path;  // as it was given, for messages
  fs::path target;
  fs::path temporary;  // empty: the file has no name yet
  int file = -1;       // -1: closed
  bool published = false;
  int failure = 0;
  std::string buffer;

  State() = default;
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() {
    if (file >= 0) ::close(file);
    if (!published && !temporary.empty()) ::unlink(temporary.c_str());
  }
};

OutputFile::OutputFile(std::unique_ptr<State> state) : state_(std::move(state)) {}
OutputFile::OutputFile(OutputFile&&) noexcept = default;
OutputFile& OutputFile::operator=(OutputFile&&) noexcept = default;
OutputFile::~OutputFile() = default;

Result<OutputFile> OutputFile::create(const fs::path& path) {
  const Result<fs::path> target = output_target(path);
  if (!target) return target.error();
  auto state = std::make_unique<State>();
  state->path = path;
  state->target = *target;
  state->file = without_name(folder_of(*target));
  if (state->file < 0) {
    const int code = under_free_name(state->target, state->temporary, [&](const char* name) {
      state->file = ::open(name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      return state->file >= 0;
    });
    if (code != 0) return not_written(path, code);
  }
  struct stat replaced{};
  if (::stat(target->c_str(), &replaced) == 0) (void)::fchmod(state->file, replaced.st_mode & 0777);
  return OutputFile(std::move(state));
}

Result<> OutputFile::failed(int code) {
  state_->failure = code;
  return not_written(state_->path, code);
}

Result<> OutputFile::write_out() {
  if (state_->failure != 0) return failed(state_->failure);
  const int code = write_all(state_->file, state_->buffer);
  state_->buffer.clear();
  return code == 0 ? Result<>() : failed(code);
}

Result<> OutputFile::write(std::string_view bytes) {
  constexpr std::size_t most_kept = 1 << 16;
  if (state_->failure == 0 && state_->buffer.size() + bytes.size() <= most_kept) {
    state_->buffer += bytes;
    return {};
  }
  if (const Result<> written = write_out(); !written) return written;
  const int code = write_all(state_->file, bytes);
  return code == 0 ? Result<>() : failed(code);
}

Result<> OutputFile::complete() {
  if (const Result<> written = write_out(); !written || state_->file < 0) return written;
  const int sync = ::fsync(state_->file) == 0 ? 0 : errno;
  if (sync != 0) return failed(sync);
  if (state_->temporary.empty()) return {};  // closed, it would be gone
  const int close = ::close(std::exchange(state_->file, -1)) == 0 ? 0 : errno;
  return close == 0 ? Result<>() : failed(close);
}

Result<> OutputFile::publish() {
  if (const Result<> completed = complete(); !completed) return completed;
  if (state_->temporary.empty()) {
    const auto link_as = [from = path_of(state_->file)](const char* name) {
      return ::linkat(AT_FDCWD, from.c_str(), AT_FDCWD, name, AT_SYMLINK_FOLLOW) == 0;
    };
    state_->published = link_as(state_->target.c_str());
    if (state_->published) return {};
    // A link replaces nothing, a name does.
    const int code = errno != EEXIST ? errno : under_free_name(state_->target, state_->temporary, link_as);
    if (code != 0) return failed(code);
  }
  if (std::rename(state_->temporary.c_str(), state_->target.c_str()) != 0) return failed(errno);
  state_->published = true;
  return {};
}

Result<OutputFile> completed_file(const fs::path& path, std::string_view bytes) {
  Result<OutputFile> file = OutputFile::create(path);
  if (!file) return file;
  if (const Result<> written = file->write(bytes); !written) return written.error();
  if (const Result<> completed = file->complete(); !completed) return completed.error();
  return file;
}

}  // namespace snip
