/// @file
/// Files that appear whole or not at all: written without a name (O_TMPFILE), which they get when all bytes
/// are on the disk. Where the file system has no such files, they are written beside their target under
/// another name, which remains when the process is killed.
#pragma once
#include <filesystem>
#include <memory>
#include <string_view>

#include "snip/result.hpp"

namespace snip {

/// Where a file of this name is written: symbolic links are followed, even to a file that is not there yet.
/// The error names what stands in the way: something that is not a regular file, no folder, no permission.
Result<std::filesystem::path> output_target(const std::filesystem::path& path);

/// Whether both names lead to the same file, be it there already or not.
bool same_target(const std::filesystem::path& a, const std::filesystem::path& b);

/// A file on its way. Until `publish`, the target is what it was before; without it nothing is left behind.
class OutputFile {
 public:
  /// Makes the temporary file. It gets the permissions of the file that it will replace.
  static Result<OutputFile> create(const std::filesystem::path& path);
  OutputFile(OutputFile&&) noexcept;
  OutputFile& operator=(OutputFile&&) noexcept;
  ~OutputFile();

  /// Adds bytes. After an error all that follows is an error, too.
  Result<> write(std::string_view bytes);
  /// Nothing more will be written: brings all bytes to the disk, so that `publish` can hardly fail.
  Result<> complete();
  /// Puts the file in the place of the target, completing it first if need be.
  Result<> publish();

 private:
  struct State;
  explicit OutputFile(std::unique_ptr<State> state);
  Result<> write_out();
  Result<> failed(int code);
  std::unique_ptr<State> state_;
};

/// A file with all its bytes on the disk, but not under its name yet.
Result<OutputFile> completed_file(const std::filesystem::path& path, std::string_view bytes);

}  // namespace snip
