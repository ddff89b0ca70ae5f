/// @file
/// What commands check of their arguments before they run. A failure is bad usage.
#pragma once
#include <CLI/App.hpp>

namespace snip {

/// A number that is positive and finite.
CLI::Validator positive_number();

/// The name of a file or folder: anything but an empty text.
CLI::Validator a_name();

}  // namespace snip
