// The progress bar and the table of frames as text.
#include <doctest/doctest.h>

#include "snip/run/frame_table.hpp"
#include "snip/run/progress.hpp"

TEST_CASE("the bar grows from nothing to all") {
  CHECK(snip::progress_bar(0, 10) == "[--------------------]   0 %");
  CHECK(snip::progress_bar(5, 10) == "[##########----------]  50 %");
  CHECK(snip::progress_bar(99, 100) == "[###################-]  99 %");
  CHECK(snip::progress_bar(10, 10) == "[####################] 100 %");
  CHECK(snip::progress_bar(11, 10) == "[####################] 100 %");
  CHECK(snip::progress_bar(0, 0) == "[####################] 100 %");
}

TEST_CASE("a row has the columns of the header and reads back to the bit") {
  snip::Frame frame;
  frame.number = 7;
  frame.time = 0.1 + 0.2;
  frame.pieces = 2;
  frame.energy.kinetic = 1.0 / 3;
  frame.cut_ms = 0.25;
  CHECK(snip::frame_row(frame) ==
        "7,0.30000000000000004,2,0,0,0,0,0,0.3333333333333333,0,0,0.3333333333333333,0.2500,0.0000\n");
}
