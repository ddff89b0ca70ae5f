/// @file
/// Files as a whole: read at once, and written at once.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>

#include "snip/result.hpp"

namespace snip {

/// The bytes of a regular file.
Result<std::string> read_whole_file(const std::filesystem::path& path);

/// Writes an `OutputFile` with these bytes. On an error the target is what it was before.
Result<> write_whole_file(const std::filesystem::path& path, std::string_view bytes);

}  // namespace snip
