// 10,000 random cut sequences of up to 30 cuts each on nine kinds of cloth, shrunk by RapidCheck when one
// fails. tests/fuzz/fuzz_cut_sequence.cpp runs the same body.
#include "random_cuts.hpp"

#include <doctest/doctest.h>
#include <rapidcheck.h>

namespace {

#ifndef __has_feature
#define __has_feature(x) 0
#endif
#if defined(__SANITIZE_ADDRESS__) || __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
constexpr int sequences = 500;
#elif defined(NDEBUG)
constexpr int sequences = 10000;
#else
constexpr int sequences = 2000;
#endif

TEST_CASE("nothing is violated after any cut of a random sequence") {
  rc::detail::TestParams params = rc::detail::configuration().testParams;  // the seed of RC_PARAMS
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
