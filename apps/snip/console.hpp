/// @file
/// What the program says on stdout and stderr. A stream that cannot be written never ends the program; that
/// stdout could not be written shows at the end.
#pragma once
#include <string_view>

#include "snip/result.hpp"

namespace snip {

/// Makes sure that the numbers of the standard streams are taken: where one was closed by whoever started the
/// program, the next file would get its number, and with it what is meant for the stream. A reader of a pipe
/// that goes away is an error of writing from now on, and no signal. Call this before any file is opened.
void prepare_standard_streams();

/// Writes to stdout. A failure shows in `flush_stdout`.
void print_out(std::string_view text);

/// Writes to stderr. A failure is ignored: there is no place left to tell it.
void print_err(std::string_view text);

/// Writes what stdout still holds. An error when that, or something printed before, could not be written.
Result<> flush_stdout();

}  // namespace snip
