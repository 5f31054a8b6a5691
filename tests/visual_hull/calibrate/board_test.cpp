// SPDX-License-Identifier: Apache-2.0
//
// Boards: what --board means, and that what is printed is what OpenCV draws, to scale.
#include "apps/visual_hull/calibrate/board.h"

#include <catch2/catch.hpp>
#include <opencv2/imgcodecs.hpp>
#include <regex>

#include "apps/visual_hull/calibrate/board_definition.h"
#include "apps/visual_hull/calibrate/board_sheet.h"
#include "nef/base/error.h"
#include "nef/io/file_bytes.h"
#include "tests/visual_hull/command/run_command.h"
#include "tests/visual_hull/scratch.h"

namespace nef::visual_hull {
namespace {

using Catch::Contains;
using testing::Outcome;
using testing::run;
using testing::Scratch;

TEST_CASE("Boards are read as they are written, in any unit") {
  const Board board = parse_board(kUsualBoard);
  CHECK(board.columns == 7);
  CHECK(board.rows == 5);
  CHECK(board.square == 30);
  CHECK(board.marker == 22);
  CHECK(board.markers() == 17);
  CHECK(board.text() == "charuco:7x5,30mm,22mm,DICT_5X5_50");
  for (const char* const text : {"charuco:7x5,3cm,2.2cm,DICT_5X5", "charuco:7x5,0.03m,0.022m,DICT_5X5_50",
                                 "charuco:7x5,30,22,DICT_5X5", "charuco:7x5,30mm,22mm,DICT_5X5_50"}) {
    CHECK(parse_board(text).text() == board.text());
  }
  CHECK(parse_board("charuco:4x3,1in,0.5in,DICT_4X4_250").square == 25.4);
  CHECK(parse_board("charuco:12x10,30mm,22mm,DICT_6X6").dictionary() == "DICT_6X6_100");
}

TEST_CASE("What is no board is refused with the reason") {
  const auto refused = [](const std::string& text, const std::string& why) {
    CHECK_THROWS_WITH(parse_board(text), Contains(why) && Contains("charuco:7x5,30mm,22mm,DICT_5X5"));
  };
  refused("chessboard:7x5,30mm", "only ChArUco boards");
  refused("charuco:7x5,30mm,22mm", "the dictionary are needed");
  refused("charuco:75,30mm,22mm,DICT_5X5", "COLUMNSxROWS");
  refused("charuco:2x5,30mm,22mm,DICT_5X5", "3 to 40");
  refused("charuco:7x5,30mm,30mm,DICT_5X5", "smaller than the squares");
  refused("charuco:7x5,-1mm,22mm,DICT_5X5", "positive");
  refused("charuco:7x5,nan,22mm,DICT_5X5", "positive");
  refused("charuco:7x5,30furlong,22mm,DICT_5X5", "positive");
  refused("charuco:7x5,30mm,22mm,DICT_9X9", "DICT_4X4");
  refused("charuco:7x5,30mm,22mm,DICT_5X6", "DICT_4X4");
  refused("charuco:7x5,30mm,22mm,DICT_5X5_60", "50, 100, 250 or 1000");
  refused("charuco:12x10,30mm,22mm,DICT_5X5_50", "it has 60 markers, its dictionary 50");
}

// What is black in a picture of a board that OpenCV draws, to the pixel.
TEST_CASE("A board is drawn as OpenCV draws it") {
  for (const char* const text : {"charuco:7x5,28mm,21mm,DICT_5X5", "charuco:4x6,32mm,24mm,DICT_4X4_100"}) {
    const Board board = parse_board(text);
    constexpr int kPixels = 4;
    const cv::Mat ours = board_picture(board, kPixels);
    cv::Mat theirs;
    const int border = static_cast<int>(board.square) * kPixels;
    const cv::Size size(static_cast<int>(board.width()) * kPixels + 2 * border,
                        static_cast<int>(board.height()) * kPixels + 2 * border);
    board_definition(board)->draw(size, theirs, border);
    REQUIRE(ours.size() == theirs.size());
    cv::Mat gray;
    cv::extractChannel(ours, gray, 0);
    CHECK(cv::countNonZero((gray > 127) != (theirs > 127)) == 0);
  }
}

TEST_CASE("Corners of a board are those of its chessboard, about its middle") {
  const Board board = parse_board("charuco:4x3,30mm,22mm,DICT_5X5");
  const std::vector<Eigen::Vector3d> corners = board_corners(board);
  REQUIRE(corners.size() == 6);
  CHECK((corners[0] - Eigen::Vector3d(-30, 15, 0)).norm() == 0);
  CHECK((corners[1] - Eigen::Vector3d(0, 15, 0)).norm() == 0);
  CHECK((corners[5] - Eigen::Vector3d(30, -15, 0)).norm() == 0);
}

TEST_CASE("Pages are to scale") {
  const Board board = parse_board(kUsualBoard);
  double black = 0;
  for (const BlackTile& tile : black_tiles(board)) black += tile.width * tile.height;
  const std::string svg = board_file(board, ".svg");
  CHECK_THAT(svg, Contains("width=\"297mm\" height=\"210mm\" viewBox=\"0 0 297 210\""));
  // The areas of the tiles and of the line to measure, from what the file says.
  const std::regex box(R"(M[\d.]+ [\d.]+h([\d.]+)v([\d.]+)h)");
  double drawn = 0;
  for (std::sregex_iterator i(svg.begin(), svg.end(), box); i != std::sregex_iterator(); ++i) {
    drawn += std::stod((*i)[1]) * std::stod((*i)[2]);
  }
  CHECK(drawn == Approx(black + 100 * 0.3 + 2 * 0.3 * 2.3).epsilon(1e-3));
  const std::string pdf = board_file(board, ".pdf");
  CHECK_THAT(pdf, Contains("/MediaBox [0 0 841.8898 595.2756]"));
  const std::regex re(R"([\d.]+ [\d.]+ ([\d.]+) ([\d.]+) re)");
  double printed = 0;
  for (std::sregex_iterator i(pdf.begin(), pdf.end(), re); i != std::sregex_iterator(); ++i) {
    printed += std::stod((*i)[1]) * std::stod((*i)[2]);
  }
  CHECK(printed * 25.4 * 25.4 / 72 / 72 == Approx(drawn).epsilon(1e-3));
  // Offsets of objects are where they begin.
  const std::size_t table = pdf.find("xref\n0 6\n");
  REQUIRE(table != std::string::npos);
  for (int i = 1; i <= 5; ++i) {
    const std::size_t at = std::stoul(pdf.substr(table + 9 + 20 * static_cast<std::size_t>(i), 10));
    CHECK(pdf.substr(at, 7) == std::to_string(i) + " 0 obj");
  }
  const PageSize upright = page_for(parse_board("charuco:6x9,30mm,22mm,DICT_5X5"));
  CHECK(upright.width == 210);
  CHECK(upright.height == 297);
  CHECK(page_for(parse_board("charuco:10x10,100mm,70mm,DICT_5X5")).width == 1024);
}

TEST_CASE("visual_hull board writes PDF, SVG and PNG to scale, and nothing else") {
  const Scratch s;
  const std::string to = s.folder().string() + "/board";
  for (const char* const extension : {".pdf", ".svg", ".png"}) {
    const Outcome made = run("board -o " + to + extension);
    CHECK(made.code == 0);
    CHECK_THAT(made.output, Contains("210 x 150 mm"));
  }
  const cv::Mat picture = cv::imread(to + ".png");
  CHECK(picture.cols == (7 + 2) * 30 * 20);
  CHECK(picture.rows == (5 + 2) * 30 * 20);
  // 20 pixels a millimetre: 20000 = 0x4e20 a metre.
  const std::string png = nef::read_file(to + ".png");
  CHECK(png.substr(33, 17) == std::string("\0\0\0\x09pHYs\0\0\x4e\x20\0\0\x4e\x20\x01", 17));
  const Outcome refused = run("board -o " + to + ".jpg");
  CHECK(refused.code == 2);
  CHECK_THAT(refused.output, Contains(".pdf, .svg or .png"));
  CHECK(run("board --board nonsense -o " + to + ".pdf").code == 2);
}

}  // namespace
}  // namespace nef::visual_hull
