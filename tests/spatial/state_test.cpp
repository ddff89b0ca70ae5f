// Random sequences of all operations of both containers against lists, everything checked after each.
#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <random>
#include <string>

#include "dictionary_operations.hpp"
#include "operations.hpp"

namespace {

std::vector<std::uint8_t> random_bytes(std::mt19937& random) {
  std::vector<std::uint8_t> bytes(50 + random() % 1500);
  for (auto& b : bytes) b = static_cast<std::uint8_t>(random());
  return bytes;
}

template <class T, std::size_t D>
std::size_t many_sequences(unsigned seed, std::size_t wanted) {
  std::mt19937 random(seed);
  std::size_t done = 0;
  while (done < wanted) {
    const auto bytes = random_bytes(random);
    operations::Run<T, D> run;
    const char* wrong = run.run(bytes.data(), bytes.size());
    if (wrong != nullptr) FAIL(std::string(wrong));
    done += run.operations;
  }
  return done;
}

template <class T, std::size_t D>
void property(const char* name) {
  CHECK(rc::check(name, [](const std::vector<std::uint8_t>& bytes) {
    operations::Run<T, D> run;
    const char* wrong = run.run(bytes.data(), bytes.size());
    if (wrong != nullptr) RC_FAIL(wrong);
  }));
}

}  // namespace

TEST_CASE("short sequences, shrunk when they fail") {
  property<float, 2>("float, 2 axes");
  property<double, 3>("double, 3 axes");
  property<std::int32_t, 2>("int32, 2 axes");
  CHECK(rc::check("dictionaries", [](const std::vector<std::uint8_t>& bytes) {
    std::size_t done = 0;
    const char* wrong = operations::run_dictionary(bytes.data(), bytes.size(), done);
    if (wrong != nullptr) RC_FAIL(wrong);
  }));
}

TEST_CASE("a million operations of the tree") {
  std::size_t done = 0;
  done += many_sequences<float, 2>(1, 170000);
  done += many_sequences<double, 3>(2, 170000);
  done += many_sequences<double, 2>(3, 170000);
  done += many_sequences<float, 3>(4, 170000);
  done += many_sequences<std::int32_t, 2>(5, 170000);
  done += many_sequences<std::uint8_t, 3>(6, 50000);
  done += many_sequences<std::int64_t, 1>(7, 50000);
  done += many_sequences<float, 1>(8, 50000);
  done += many_sequences<double, 6>(9, 20000);
  CHECK(done >= 1000000);
}

TEST_CASE("a million operations of the dictionary") {
  std::mt19937 random(10);
  std::size_t done = 0;
  while (done < 1000000) {
    const auto bytes = random_bytes(random);
    const char* wrong = operations::run_dictionary(bytes.data(), bytes.size(), done);
    if (wrong != nullptr) FAIL(std::string(wrong));
  }
  MESSAGE(done, " operations");
}
