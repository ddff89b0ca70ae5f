// Standard streams, see the header. By the functions of C: fmt::print throws when a stream cannot be written.
#include "snip/console.hpp"

#include <fcntl.h>
#include <fmt/format.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <system_error>

namespace snip {
namespace {

void print(std::string_view text, std::FILE* stream) {
  (void)std::fwrite(text.data(), 1, text.size(), stream);  // the stream remembers a failure
}

}  // namespace

void prepare_standard_streams() {
  (void)std::signal(SIGPIPE, SIG_IGN);
  // Opened the wrong way round, so that using the stream fails as it would if it were still closed. The
  // number is that of the stream, since it is the smallest one that is free.
  for (int stream = 0; stream < 3; ++stream)
    if (::fcntl(stream, F_GETFD) == -1 && ::open("/dev/null", stream == 0 ? O_WRONLY : O_RDONLY) != stream)
      return;
}

void print_out(std::string_view text) { print(text, stdout); }

void print_err(std::string_view text) { print(text, stderr); }

Result<> flush_stdout() {
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return {};
  const int reason = errno != 0 ? errno : EIO;
  return Error{fmt::format("stdout cannot be written: {}", std::generic_category().message(reason))};
}

}  // namespace snip
