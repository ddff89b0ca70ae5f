/// @file
/// `rc::check` with a number of cases of one's own, for properties whose hard cases are rare.
#pragma once
#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <sstream>
#include <string>

/// Fails the running test case, with the smallest counterexample found, when the property does not hold.
/// @param largest  size of the largest values, of vectors the number of elements
template <class Property>
void check_many(int cases, const std::string& name, Property&& property, int largest = 100) {
  rc::detail::TestParams params = rc::detail::configuration().testParams;  // the seed of RC_PARAMS
  params.maxSuccess = cases;
  params.maxSize = largest;
  rc::detail::TestMetadata metadata;
  metadata.id = name;
  const auto result = rc::detail::checkTestable(std::forward<Property>(property), metadata, params);
  if (result.template is<rc::detail::SuccessResult>()) return;
  std::ostringstream text;
  rc::detail::printResultMessage(result, text);
  FAIL(name << ": " << text.str());
}
