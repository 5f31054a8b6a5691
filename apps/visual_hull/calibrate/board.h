// SPDX-License-Identifier: Apache-2.0
//
// ChArUco boards: a chessboard whose white squares hold markers, so that each of its corners has a number.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

namespace nef::visual_hull {

/// A board as `--board` describes it. Lengths are millimetres.
struct Board {
  int columns = 7, rows = 5;  ///< of squares
  double square = 30;         ///< side of a square
  double marker = 22;         ///< side of a marker, smaller than a square
  int bits = 5;               ///< cells along a side of a marker, without its frame: 4 to 7
  int family = 0;             ///< markers of its dictionary: 50, 100, 250 or 1000

  [[nodiscard]] double width() const { return columns * square; }
  [[nodiscard]] double height() const { return rows * square; }
  [[nodiscard]] int markers() const { return columns * rows / 2; }
  [[nodiscard]] std::string dictionary() const;  ///< "DICT_5X5_50"
  [[nodiscard]] std::string text() const;        ///< as parse_board reads it
};

/// The board that is used where none is named: 210 x 150 mm, so that it fits on A4.
inline constexpr const char* kUsualBoard = "charuco:7x5,30mm,22mm,DICT_5X5";

/// Parses "charuco:COLUMNSxROWS,SQUARE,MARKER,DICTIONARY": 3 to 40 squares a side, lengths in mm unless m, cm or in
/// follows, a dictionary DICT_nXn[_50|_100|_250|_1000] of n = 4 to 7 (without a count the smallest that has enough
/// markers). Throws InputError.
Board parse_board(const std::string& text);

/// A black rectangle of a board, in millimetres from its upper left corner, y down.
struct BlackTile {
  double x = 0, y = 0, width = 0, height = 0;
};

/// All that is black on a board.
std::vector<BlackTile> black_tiles(const Board& board);

/// The inner corners of the chessboard by their numbers, in the frame of the board: the origin is its middle, x to the
/// right, y up, z out of the sheet.
std::vector<Eigen::Vector3d> board_corners(const Board& board);

}  // namespace nef::visual_hull
