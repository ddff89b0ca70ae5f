/// @file
/// Files as a whole: read at once, and written so that a half-written one is never seen under its name.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>

#include "snip/result.hpp"

namespace snip {

/// The bytes of a regular file.
Result<std::string> read_whole_file(const std::filesystem::path& path);

/// Writes beside the target under another name, and renames when all bytes are on the disk. On an error the
/// target is what it was before, and nothing is left behind. A symbolic link is followed.
Result<> write_whole_file(const std::filesystem::path& path, std::string_view bytes);

}  // namespace snip
