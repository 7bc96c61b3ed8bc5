#include "frontal/parts/picture_answers.hpp"

#include <filesystem>

#include "catch.hpp"
#include "frontal/sent_post.hpp"
#include "proto/picture_rows.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

/// A picture in which each value is the number of its row.
Picture striped(std::uint32_t width, std::uint32_t height) {
  Picture picture;
  picture.width = width;
  picture.height = height;
  for (std::uint32_t row = 0; row < height; ++row) {
    picture.rgb.insert(picture.rgb.end(), std::size_t{width} * 3, static_cast<float>(row));
  }
  return picture;
}

}  // namespace

TEST_CASE(
    "of the rows that are asked for those come that are there and fit "
    "into a message") {
  const Picture picture = striped(256, 1000);
  const Answer few = picture_rows(picture, {7, 10, 20, 0});
  const auto rows = granted<control::Picture>(few);
  CHECK(rows.job == 7);
  CHECK(rows.first_row == 10);
  CHECK(rows.rows == 20);
  CHECK(rows.width == 256);
  CHECK(rows.height == 1000);
  const SharedBytes expected =
      encode_picture_rows(std::span(picture.rgb).subspan(10 * 768, 20 * 768));
  CHECK(std::ranges::equal(std::get<Reply>(few).payload.bytes(), expected.bytes()));
  CHECK(granted<control::Picture>(picture_rows(picture, {7, 0, 1000, 0})).rows ==
        kPictureChunkBytes / (256 * 3 * 4));
  CHECK(granted<control::Picture>(picture_rows(picture, {7, 990, 1000, 0})).rows == 10);
}

TEST_CASE("a row beyond a message's size comes by itself") {
  const Picture wide = striped(kPictureChunkBytes / 4, 2);
  CHECK(granted<control::Picture>(picture_rows(wide, {1, 0, 2, 0})).rows == 1);
}

TEST_CASE("rows beyond the picture, and planes that it hasn't, are refused") {
  const Picture picture = striped(4, 4);
  CHECK(refused(picture_rows(picture, {1, 4, 1, 0})) == FailureCode::kBadRequest);
  CHECK(refused(picture_rows(picture, {1, 0, 1, 2})) == FailureCode::kBadRequest);
}

TEST_CASE("files are written, and their cost is told; a failure names the option") {
  double used_s = 0;
  const auto clock = [&used_s] { return used_s += 2; };
  const Picture picture = striped(4, 4);
  const std::string file =
      (std::filesystem::temp_directory_path() / "graycube_picture_answers_test.png").string();
  const auto written = granted<control::Written>(write_picture(picture, {3, "", file}, {}, clock));
  CHECK(written.job == 3);
  CHECK(written.cpu_s == 2);
  CHECK(std::filesystem::remove(file));
  const Answer failed = write_picture(picture, {3, "", "/nowhere/at/all.png"}, {}, clock);
  CHECK(refused(failed) == FailureCode::kFailed);
  CHECK(std::get<Refusal>(failed).where == "--png");
}

TEST_CASE("a picture that would take too long to write has to be fetched") {
  Picture large;
  large.width = 1 << 12;
  large.height = (1 << 10) + 1;
  CHECK(refused(write_picture(large, {1, "/nowhere", ""}, {}, [] { return 0.0; })) ==
        FailureCode::kTooLarge);
}
