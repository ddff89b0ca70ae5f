// 10,000 random cut sequences of up to 30 cuts each on nine kinds of cloth, shrunk by RapidCheck when one
// fails. tests/fuzz/fuzz_cut_sequence.cpp runs the same body.
#include "random_cuts.hpp"

#include <doctest/doctest.h>
#include <rapidcheck.h>

namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr int sequences = 500;
#elif defined(NDEBUG)
constexpr int sequences = 10000;
#else
constexpr int sequences = 2000;
#endif

TEST_CASE("nothing is violated after any cut of a random sequence") {
  rc::detail::TestParams params;
  params.maxSuccess = sequences;
  params.maxSize = 1200;  // bytes, 5 to 40 for each cut
  rc::detail::TestMetadata metadata;
  metadata.id = "random_cuts";
  std::string failure;
  const auto result = rc::detail::checkTestable(
      [&](const std::vector<std::uint8_t>& bytes) {
        failure = random_cuts::run(bytes.data(), bytes.size());
        RC_ASSERT(failure == "");
      },
      metadata, params);
  if (!result.template is<rc::detail::SuccessResult>()) {
    std::ostringstream text;
    rc::detail::printResultMessage(result, text);
    FAIL(failure << "\n" << text.str());
  }
}

}  // namespace
