// Prints one line `name hash` for each case, in order of names.
#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <cstring>
#include <vector>

#include "hash.hpp"

namespace {

struct Entry {
  const char* name;
  std::uint64_t (*compute)();
};

// In a function, since the cases of other files may enter themselves before this file's globals are made.
std::vector<Entry>& entries() {
  static std::vector<Entry> all;
  return all;
}

}  // namespace

hashes::Case::Case(const char* name, std::uint64_t (*compute)()) { entries().push_back({name, compute}); }

int main() {
  std::ranges::sort(entries(),
                    [](const Entry& a, const Entry& b) { return std::strcmp(a.name, b.name) < 0; });
  for (const Entry& entry : entries()) std::printf("%s %016" PRIx64 "\n", entry.name, entry.compute());
}
